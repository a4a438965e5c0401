// The brick grid: how densities are held for rendering. kernel/lookup.inl has the layout and the look-up.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

namespace brume {

// Bits a voxel. The error of a value is at most half a step of its brick, and the rounding of the float sum
// offset + scale q; none for f32. Offset and scale are rounded to 16-bit floats, so that a step is at most
// 1.01 (range + |smallest value| / 128) / levels, with 255 levels for u8 and 65535 for u16. A brick whose smallest
// value is 0 holds its zeros exactly. Voxels of a brick beyond the array's end are 0 and count in its range.
enum class Storage { u8 = 8, u16 = 16, f32 = 32 };

constexpr int brick_edge = 8;
constexpr int brick_voxels = brick_edge * brick_edge * brick_edge;

constexpr std::size_t max_brick_words = std::size_t{1} << 31;  // of all bricks
constexpr std::size_t max_table_words = std::size_t{1} << 27;  // 3250^3 voxels; all are gone through, empty or not

// A brick in the table: its first word, and how its levels become values (kernel/lookup.inl).
struct BrickEntry {
  std::uint32_t first_word = 0;  // 0: the empty brick
  std::uint32_t steps = 0;

  float offset() const { return std::bit_cast<float>(steps & 0xffff0000u); }
  float scale() const { return std::bit_cast<float>(steps << 16); }
};

constexpr std::uint32_t gap_steps = 0x8000;  // of an empty brick whose neighbours on the upper sides are empty

struct BrickGrid {
  std::array<int, 3> voxels{};  // nx, ny, nz
  std::array<int, 3> bricks{};  // ceil(voxels / 8)
  Storage storage = Storage::u16;
  bool bordered = false;             // volume/brick_borders.h
  std::vector<std::uint32_t> table;  // (bricks + 2) along each axis, x fastest: the two words of a BrickEntry each
  std::vector<std::uint32_t> words;  // the bricks, the shared empty one first
  std::vector<std::uint32_t> constant_bricks;  // the first words of those of one value, which are shared, in order

  // Of the values given: over all voxels of the array.
  float min_value = 0, max_value = 0;
  double mean_value = 0;
  std::int64_t nonzero_voxels = 0;

  BrickEntry entry(std::size_t i) const { return {table[2 * i], table[2 * i + 1]}; }
  std::size_t bytes() const { return (table.size() + words.size()) * sizeof(std::uint32_t); }
};

// Collects a grid brick by brick, in any order, quantising as it goes, so that the whole is never held as floats.
class BrickGridBuilder {
 public:
  // An array of nx x ny x nz voxels, at least 1 along each axis, all 0. This and set_brick throw std::length_error
  // where the grid would need more than max_brick_words or max_table_words.
  BrickGridBuilder(std::array<int, 3> voxels, Storage storage);

  // Sets the brick that begins at voxel 8 (bx, by, bz) to 512 values, x fastest. Each brick at most once. Values beyond
  // the array's end are ignored. Values must be finite. Bricks of one constant value share their words.
  void set_brick(std::array<int, 3> brick, std::span<const float, brick_voxels> values);

  // The same for a brick that lies within the array and has one value.
  void set_constant_brick(std::array<int, 3> brick, float value);

  BrickGrid finish();

 private:
  void count(std::span<const float> values);
  void set_entry(std::array<int, 3> brick, BrickEntry entry);
  BrickEntry constant_brick(float value);
  BrickEntry append(std::span<const float, brick_voxels> values, float lo, float hi);

  BrickGrid grid_;
  float min_ = std::numeric_limits<float>::infinity(), max_ = -std::numeric_limits<float>::infinity();
  double sum_ = 0;
  std::int64_t voxels_set_ = 0;
  std::unordered_map<std::uint32_t, BrickEntry> constant_bricks_;  // by the value's bits
};

// From a dense array, x fastest, of nx ny nz values.
BrickGrid make_brick_grid(std::array<int, 3> voxels, std::span<const float> values, Storage storage);

}  // namespace brume

// The brick grid: how densities are held for rendering. kernel/lookup.inl has the layout and the look-up.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

namespace brume {

// Bits a voxel. The error of a value is at most half a step of its brick's range, range / 510 for u8 and range / 131070
// for u16, and the rounding of the float sum offset + scale q; none for f32. A brick whose smallest value is 0 holds
// its zeros exactly. Voxels of a brick beyond the array's end are 0 and count in its range.
enum class Storage { u8 = 8, u16 = 16, f32 = 32 };

constexpr int brick_edge = 8;
constexpr int brick_voxels = brick_edge * brick_edge * brick_edge;

struct BrickGrid {
  std::array<int, 3> voxels{};  // nx, ny, nz
  std::array<int, 3> bricks{};  // ceil(voxels / 8)
  Storage storage = Storage::u16;
  std::vector<std::uint32_t> table;  // (bricks + 2) along each axis, x fastest: first word of the brick in `words`
  std::vector<std::uint32_t> words;  // the bricks, the shared empty one first

  // Of the values given: over all voxels of the array.
  float min_value = 0, max_value = 0;
  double mean_value = 0;
  std::int64_t nonzero_voxels = 0;

  std::size_t bytes() const { return (table.size() + words.size()) * sizeof(std::uint32_t); }
};

// Collects a grid brick by brick, in any order, quantising as it goes, so that the whole is never held as floats.
class BrickGridBuilder {
 public:
  // An array of nx x ny x nz voxels, at least 1 along each axis, all 0. This and set_brick throw std::length_error
  // where the grid would need more than 2^31 words.
  BrickGridBuilder(std::array<int, 3> voxels, Storage storage);

  // Sets the brick that begins at voxel 8 (bx, by, bz) to 512 values, x fastest. Each brick at most once. Values beyond
  // the array's end are ignored. Values must be finite. Bricks of one constant value share their words.
  void set_brick(std::array<int, 3> brick, std::span<const float, brick_voxels> values);

  // The same for a brick that lies within the array and has one value.
  void set_constant_brick(std::array<int, 3> brick, float value);

  BrickGrid finish();

 private:
  void count(std::span<const float> values);
  std::uint32_t constant_brick(float value);
  std::uint32_t append(std::span<const float, brick_voxels> values, float lo, float hi);

  BrickGrid grid_;
  float min_ = std::numeric_limits<float>::infinity(), max_ = -std::numeric_limits<float>::infinity();
  double sum_ = 0;
  std::int64_t voxels_set_ = 0;
  std::unordered_map<std::uint32_t, std::uint32_t> constant_bricks_;  // the value's bits to the brick's first word
};

// From a dense array, x fastest, of nx ny nz values.
BrickGrid make_brick_grid(std::array<int, 3> voxels, std::span<const float> values, Storage storage);

}  // namespace brume

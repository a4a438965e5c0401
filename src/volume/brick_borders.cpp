#include "volume/brick_borders.h"

#include <algorithm>
#include <map>

#include "base/parallel.h"
#include "volume/brick_levels.h"

namespace brume {

namespace {

constexpr int bordered_edge = brick_edge + 1;
constexpr int bordered_values = bordered_edge * bordered_edge * bordered_edge;

// A brick and its neighbours on the upper sides: number 1 is the next along x, 2 along y, 4 along z, and so on.
using Neighbours = std::array<BrickEntry, 8>;

// The entries of a table, x fastest; the last along each axis, which are empty, have no neighbours.
class Table {
 public:
  explicit Table(const BrickGrid& grid) : grid_(grid) {
    std::size_t stride = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      size_[axis] = static_cast<std::size_t>(grid.bricks[axis]) + 2;
      stride_[axis] = stride;
      stride *= size_[axis];
    }
  }

  Neighbours neighbours(std::size_t entry) const {
    Neighbours all;
    for (std::size_t i = 0; i < 8; ++i)
      all[i] = grid_.entry(entry + (i & 1) + (i >> 1 & 1) * stride_[1] + (i >> 2) * stride_[2]);
    return all;
  }

  template <class PerEntry>
  void for_each_with_neighbours(PerEntry&& f) const {
    for (std::size_t z = 0; z + 1 < size_[2]; ++z)
      for (std::size_t y = 0; y + 1 < size_[1]; ++y)
        for (std::size_t x = 0; x + 1 < size_[0]; ++x) f(x + y * stride_[1] + z * stride_[2]);
  }

 private:
  const BrickGrid& grid_;
  std::array<std::size_t, 3> size_{}, stride_{};
};

// Copies what the bordered brick takes from neighbour number `from`.
void copy_part(const BrickGrid& grid, BrickEntry entry, int from, std::span<float, bordered_values> values) {
  const int x_end = from & 1 ? 1 : brick_edge, y_end = from & 2 ? 1 : brick_edge, z_end = from & 4 ? 1 : brick_edge;
  const int corner = (from & 1 ? 8 : 0) + bordered_edge * ((from & 2 ? 8 : 0) + bordered_edge * (from & 4 ? 8 : 0));
  for (int z = 0; z < z_end; ++z)
    for (int y = 0; y < y_end; ++y)
      for (int x = 0; x < x_end; ++x)
        values[static_cast<std::size_t>(corner + x + bordered_edge * (y + bordered_edge * z))] =
            packed_value(grid, entry, static_cast<std::uint32_t>(x + 8 * y + 64 * z));
}

// Packs a bordered brick; returns its steps.
std::uint32_t pack_bordered(const BrickGrid& grid, const Neighbours& bricks, std::span<std::uint32_t> words) {
  std::array<float, bordered_values> values{};
  for (int i = 0; i < 8; ++i)
    if (const BrickEntry entry = bricks[static_cast<std::size_t>(i)]; entry.first_word != 0)
      copy_part(grid, entry, i, values);
  const auto [lo, hi] = std::ranges::minmax(values);
  BrickEntry entry = bricks[0];
  if (entry.first_word == 0 || !levels_reach(entry, lo, hi, grid.storage))
    entry.steps = level_steps(lo, hi, grid.storage);
  pack_levels(values, entry, grid.storage, words);
  return entry.steps;
}

}  // namespace

BrickGrid add_borders(BrickGrid grid, int threads) {
  const Table table(grid);
  const std::size_t words_each = packed_words(bordered_values, grid.storage);
  std::vector<std::uint32_t> entries(grid.table.size());
  std::vector<std::size_t> to_pack;
  std::map<std::uint32_t, std::size_t> alike;  // constant bricks among their likes, which share words, by first word
  std::size_t word_count = words_each;         // of the empty brick
  for (std::size_t i = 1; i < entries.size(); i += 2) entries[i] = gap_steps;
  table.for_each_with_neighbours([&](std::size_t entry) {
    const Neighbours bricks = table.neighbours(entry);
    const std::uint32_t first_word = bricks[0].first_word;
    const bool all_same = std::ranges::all_of(bricks, [&](BrickEntry b) { return b.first_word == first_word; });
    if (all_same && first_word == 0) return;
    bool is_new = true;
    std::size_t place = word_count;
    if (all_same) {
      const auto [known, added] = alike.try_emplace(first_word, word_count);
      place = known->second;
      is_new = added;
    }
    entries[2 * entry] = static_cast<std::uint32_t>(place);
    entries[2 * entry + 1] = bricks[0].steps;
    if (!is_new) return;
    word_count += words_each;
    to_pack.push_back(entry);
  });
  if (word_count > max_brick_words) return grid;

  std::vector<std::uint32_t> words(word_count);
  parallel_for(static_cast<int>(to_pack.size()), threads, [&](int i, int) {
    const std::size_t entry = to_pack[static_cast<std::size_t>(i)];
    entries[2 * entry + 1] =
        pack_bordered(grid, table.neighbours(entry), std::span(words).subspan(entries[2 * entry], words_each));
  });
  grid.table = std::move(entries);
  grid.words = std::move(words);
  grid.bordered = true;
  return grid;
}

}  // namespace brume

#include "volume/brick_grid.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

#include "volume/brick_levels.h"

namespace brume {
namespace {

// The entry in the table that holds brick (x, y, z), border included.
std::size_t table_index(const BrickGrid& grid, std::array<int, 3> brick) {
  const auto at = [](int i) { return static_cast<std::size_t>(i) + 1; };
  const auto row = [&](int axis) { return static_cast<std::size_t>(grid.bricks[static_cast<std::size_t>(axis)]) + 2; };
  return (at(brick[2]) * row(1) + at(brick[1])) * row(0) + at(brick[0]);
}

// Marks the empty bricks, the border's too, whose neighbours on the upper sides are empty. In one pass, since tables
// can be large: a brick that is not empty takes the mark from its neighbours on the lower sides, which come before it.
void mark_gaps(BrickGrid& grid) {
  const std::size_t row = static_cast<std::size_t>(grid.bricks[0]) + 2,
                    layer = row * (static_cast<std::size_t>(grid.bricks[1]) + 2);
  std::vector<std::uint32_t>& table = grid.table;
  for (std::size_t i = 0; 2 * i < table.size(); ++i) {
    if (table[2 * i] == 0) {
      table[2 * i + 1] = gap_steps;
      continue;
    }
    for (const std::size_t back : {std::size_t{1}, row, row + 1, layer, layer + 1, layer + row, layer + row + 1})
      if (table[2 * (i - back)] == 0) table[2 * (i - back) + 1] = 0;
  }
}

}  // namespace

BrickGridBuilder::BrickGridBuilder(std::array<int, 3> voxels, Storage storage) {
  grid_.voxels = voxels;
  grid_.storage = storage;
  std::size_t table_words = sizeof(BrickEntry) / sizeof(std::uint32_t);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (voxels[axis] < 1) throw std::length_error("a grid must have at least one voxel along each axis");
    grid_.bricks[axis] = (voxels[axis] - 1) / brick_edge + 1;
    const std::size_t row = static_cast<std::size_t>(grid_.bricks[axis]) + 2;
    if (row > max_table_words / table_words) throw std::length_error("the grid's table of bricks is too large");
    table_words *= row;
  }
  grid_.table.assign(table_words, 0);
  grid_.words.assign(packed_words(brick_voxels, storage), 0);
}

void BrickGridBuilder::set_brick(std::array<int, 3> brick, std::span<const float, brick_voxels> values) {
  std::array<int, 3> end{};  // of the part of the brick that is in the array
  for (std::size_t axis = 0; axis < 3; ++axis) {
    end[axis] = std::min(brick_edge, grid_.voxels[axis] - brick[axis] * brick_edge);
  }
  std::array<float, brick_voxels> inside{};
  for (int z = 0; z < end[2]; ++z) {
    for (int y = 0; y < end[1]; ++y) {
      const auto row = static_cast<std::size_t>(z * 64 + y * 8);
      const auto length = static_cast<std::size_t>(end[0]);
      std::ranges::copy(values.subspan(row, length), inside.begin() + row);
      count(values.subspan(row, length));
    }
  }

  const auto [lo, hi] = std::ranges::minmax(inside);
  set_entry(brick, lo < hi ? append(inside, lo, hi) : constant_brick(lo));
}

void BrickGridBuilder::set_constant_brick(std::array<int, 3> brick, float value) {
  set_entry(brick, constant_brick(value));
  sum_ += brick_voxels * static_cast<double>(value);
  grid_.nonzero_voxels += value != 0 ? brick_voxels : 0;
  min_ = std::min(min_, value);
  max_ = std::max(max_, value);
  voxels_set_ += brick_voxels;
}

void BrickGridBuilder::set_entry(std::array<int, 3> brick, BrickEntry entry) {
  const std::size_t at = 2 * table_index(grid_, brick);
  grid_.table[at] = entry.first_word;
  grid_.table[at + 1] = entry.steps;
}

BrickEntry BrickGridBuilder::constant_brick(float value) {
  if (value == 0) return {};
  const auto [known, is_new] = constant_bricks_.try_emplace(std::bit_cast<std::uint32_t>(value));
  if (is_new) {
    std::array<float, brick_voxels> values;
    values.fill(value);
    known->second = append(values, value, value);
  }
  return known->second;
}

void BrickGridBuilder::count(std::span<const float> values) {
  double sum = 0;
  for (const float v : values) {
    sum += static_cast<double>(v);
    grid_.nonzero_voxels += v != 0;
    min_ = std::min(min_, v);
    max_ = std::max(max_, v);
  }
  sum_ += sum;
  voxels_set_ += static_cast<std::int64_t>(values.size());
}

BrickEntry BrickGridBuilder::append(std::span<const float, brick_voxels> values, float lo, float hi) {
  std::vector<std::uint32_t>& words = grid_.words;
  const std::size_t first = words.size(), count = packed_words(brick_voxels, grid_.storage);
  if (first + count > max_brick_words) throw std::length_error("the grid's bricks are too large");
  const BrickEntry entry{static_cast<std::uint32_t>(first), level_steps(lo, hi, grid_.storage)};
  words.resize(first + count);
  pack_levels(values, entry, grid_.storage, std::span(words).last(count));
  return entry;
}

BrickGrid BrickGridBuilder::finish() {
  const std::int64_t voxels = std::int64_t{grid_.voxels[0]} * grid_.voxels[1] * grid_.voxels[2];
  const bool some_unset = voxels_set_ < voxels;  // and therefore 0
  grid_.min_value = some_unset ? std::min(0.0f, min_) : min_;
  grid_.max_value = some_unset ? std::max(0.0f, max_) : max_;
  grid_.mean_value = sum_ / static_cast<double>(voxels);
  grid_.words.shrink_to_fit();
  for (const auto& [value, entry] : constant_bricks_) grid_.constant_bricks.push_back(entry.first_word);
  std::ranges::sort(grid_.constant_bricks);
  mark_gaps(grid_);
  return std::move(grid_);
}

BrickGrid make_brick_grid(std::array<int, 3> voxels, std::span<const float> values, Storage storage) {
  BrickGridBuilder builder(voxels, storage);
  const std::size_t row = static_cast<std::size_t>(voxels[0]), layer = row * static_cast<std::size_t>(voxels[1]);
  if (values.size() != layer * static_cast<std::size_t>(voxels[2])) {
    throw std::length_error("the number of values is not the number of voxels");
  }
  std::array<float, brick_voxels> brick;
  const auto gather = [&](int bx, int by, int bz) {
    for (int i = 0; i < brick_voxels; ++i) {
      const int x = bx * 8 + (i & 7), y = by * 8 + ((i >> 3) & 7), z = bz * 8 + (i >> 6);
      const bool in_array = x < voxels[0] && y < voxels[1] && z < voxels[2];
      const auto at =
          static_cast<std::size_t>(z) * layer + static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x);
      brick[static_cast<std::size_t>(i)] = in_array ? values[at] : 0;
    }
  };
  for (int bz = 0; bz * 8 < voxels[2]; ++bz) {
    for (int by = 0; by * 8 < voxels[1]; ++by) {
      for (int bx = 0; bx * 8 < voxels[0]; ++bx) {
        gather(bx, by, bz);
        builder.set_brick({bx, by, bz}, brick);
      }
    }
  }
  return builder.finish();
}

}  // namespace brume

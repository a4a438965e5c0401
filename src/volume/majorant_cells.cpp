#include "volume/majorant_cells.h"

#include <algorithm>
#include <bit>

#include "base/parallel.h"

namespace brume {

namespace {

// The range [first, last] of voxels along one axis.
struct Range {
  int first, last;
};

// The largest value of the voxels in a part of one brick; x, y and z are within the brick.
float brick_max(const BrickGrid& grid, BrickEntry brick, Range x, Range y, Range z) {
  const std::uint32_t* words = grid.words.data() + brick.first_word;
  const bool is_float = grid.storage == Storage::f32, is_u16 = grid.storage == Storage::u16;
  float largest = 0;
  std::uint32_t largest_level = 0;
  for (int k = z.first; k <= z.last; ++k)
    for (int j = y.first; j <= y.last; ++j)
      for (int i = x.first; i <= x.last; ++i) {
        const auto voxel = static_cast<std::uint32_t>(i + 8 * j + 64 * k);
        if (is_float)
          largest = std::max(largest, std::bit_cast<float>(words[voxel]));
        else if (is_u16)
          largest_level = std::max(largest_level, words[voxel >> 1] >> ((voxel & 1) * 16) & 0xffff);
        else
          largest_level = std::max(largest_level, words[voxel >> 2] >> ((voxel & 3) * 8) & 0xff);
      }
  return is_float ? largest : brick.offset() + brick.scale() * static_cast<float>(largest_level);
}

// The largest value in a box of voxels, 0 outside the array.
float box_max(const BrickGrid& grid, Range x, Range y, Range z) {
  const auto clip = [](Range r, int n) { return Range{std::max(r.first, 0), std::min(r.last, n - 1)}; };
  x = clip(x, grid.voxels[0]), y = clip(y, grid.voxels[1]), z = clip(z, grid.voxels[2]);
  const int row = grid.bricks[0] + 2, layer = row * (grid.bricks[1] + 2);
  const auto in_brick = [](Range r, int brick) {
    return Range{std::max(r.first - 8 * brick, 0), std::min(r.last - 8 * brick, 7)};
  };
  float largest = 0;
  for (int k = z.first / 8; 8 * k <= z.last; ++k)
    for (int j = y.first / 8; 8 * j <= y.last; ++j)
      for (int i = x.first / 8; 8 * i <= x.last; ++i) {
        const BrickEntry brick = grid.entry(static_cast<std::size_t>((k + 1) * layer + (j + 1) * row + i + 1));
        if (brick.first_word != 0)
          largest = std::max(largest, brick_max(grid, brick, in_brick(x, i), in_brick(y, j), in_brick(z, k)));
      }
  return largest;
}

}  // namespace

MajorantCells make_majorants(const BrickGrid& grid, int min_edge, std::size_t max_bytes, int threads) {
  MajorantCells m;
  const auto bytes = [&] {
    std::size_t count = sizeof(std::uint32_t);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      m.size[axis] = (grid.voxels[axis] - 1) / m.edge + 3;
      count *= static_cast<std::size_t>(m.size[axis]);
    }
    return count;
  };
  for (m.edge = min_edge; bytes() > max_bytes; ++m.edge) {
  }
  m.cells.resize(bytes() / sizeof(std::uint32_t));
  // A hair above, for the rounding of look-ups.
  constexpr float margin = 1.000001f;
  const auto reach = [&](int cell) { return Range{(cell - 1) * m.edge - 1, cell * m.edge}; };
  parallel_for(m.size[2], threads, [&](int z, int) {
    std::size_t at = static_cast<std::size_t>(z) * static_cast<std::size_t>(m.size[1] * m.size[0]);
    for (int y = 0; y < m.size[1]; ++y)
      for (int x = 0; x < m.size[0]; ++x)
        m.cells[at++] = std::bit_cast<std::uint32_t>(margin * box_max(grid, reach(x), reach(y), reach(z)));
  });
  return m;
}

}  // namespace brume

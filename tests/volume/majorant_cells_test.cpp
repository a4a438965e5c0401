// Majorant cells bound every value that a look-up in them can return: the interpolant, the nearest voxel and every tap,
// in grids of all sizes and storages. The fault this catches: bounds of a cell's own voxels alone.
#include "volume/majorant_cells.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "volume/kernel_view.h"

namespace brume {
namespace {

struct RandomGrid {
  BrickGrid grid;
  MajorantCells majorants;
  // Of the cell that a ray at index coordinates p is in.
  float bound(kernel::vec3 p) const {
    const auto cell = [&](float x) { return static_cast<int>(std::floor(x / static_cast<float>(majorants.edge))) + 1; };
    return std::bit_cast<float>(majorants.cells[static_cast<std::size_t>(
        (cell(p.z) * majorants.size[1] + cell(p.y)) * majorants.size[0] + cell(p.x))]);
  }
};

// Mostly 0, with peaks of single voxels.
RandomGrid random_grid(std::mt19937& random, Storage storage, std::size_t max_bytes) {
  const auto pick = [&](int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random); };
  const std::array voxels{pick(1, 40), pick(1, 40), pick(1, 40)};
  std::vector<float> values(static_cast<std::size_t>(voxels[0] * voxels[1] * voxels[2]));
  for (float& v : values) v = pick(0, 9) == 0 ? static_cast<float>(pick(1, 1000)) * 0.01f : 0;
  RandomGrid g{make_brick_grid(voxels, values, storage), {}};
  g.majorants = make_majorants(g.grid, pick(1, 9), max_bytes, 2);
  return g;
}

// How many of the values at random places of the grid's bounds are above their bounds.
int violations(const RandomGrid& g, std::mt19937& random, int places) {
  std::uniform_real_distribution<float> uniform(0, 1);
  const kernel::BrickGrid view = kernel_view(g.grid);
  int count = 0;
  for (int i = 0; i < places; ++i) {
    const auto along = [&](std::size_t axis) {
      const auto n = static_cast<float>(g.grid.voxels[axis]);
      const float x = -0.5f + (n + 1) * uniform(random);
      // Often at the planes between cells.
      return random() % 3 == 0 ? std::clamp(std::round(x), 0.0f, n) : x;
    };
    const kernel::vec3 p(along(0), along(1), along(2));
    const float bound = g.bound(p);
    const auto a = static_cast<std::uint32_t>(random()), b = static_cast<std::uint32_t>(random());
    count += kernel::grid_linear(view, p) > bound;
    count += kernel::grid_nearest(view, p) > bound;
    count += kernel::grid_stochastic(view, p, a, b) > bound;
    count += kernel::grid_stochastic(view, p, 0, 0) > bound;
    count += kernel::grid_stochastic(view, p, 0xffffffffu, 0xffffffffu) > bound;
  }
  return count;
}

TEST(MajorantCells, BoundEveryLookUp) {
  std::mt19937 random(5);
  for (int i = 0; i < 60; ++i) {
    const Storage storage = std::array{Storage::u8, Storage::u16, Storage::f32}[static_cast<std::size_t>(i % 3)];
    const RandomGrid g = random_grid(random, storage, i % 2 == 0 ? 1 << 20 : 4000);
    ASSERT_LE(g.majorants.cells.size() * sizeof(std::uint32_t), i % 2 == 0 ? 1u << 20 : 4000u);
    ASSERT_EQ(violations(g, random, 3000), 0) << "grid " << i;
  }
}

// Twins: a bound without what lies one voxel beyond the cell, as the cells of a grid that is moved by a voxel have it.
TEST(MajorantCellsTwin, BoundsWithoutDilationAreRejected) {
  std::mt19937 random(6);
  RandomGrid g = random_grid(random, Storage::u16, 1 << 20);
  const kernel::BrickGrid view = kernel_view(g.grid);
  const std::array<int, 3> size = g.majorants.size;
  for (int z = 0; z < size[2]; ++z)
    for (int y = 0; y < size[1]; ++y)
      for (int x = 0; x < size[0]; ++x) {
        const int edge = g.majorants.edge;
        float largest = 0;
        for (int k = (z - 1) * edge; k < z * edge; ++k)
          for (int j = (y - 1) * edge; j < y * edge; ++j)
            for (int i = (x - 1) * edge; i < x * edge; ++i)
              if (i >= 0 && j >= 0 && k >= 0 && i < g.grid.voxels[0] && j < g.grid.voxels[1] && k < g.grid.voxels[2])
                largest = std::max(largest, kernel::grid_voxel(view, i, j, k));
        g.majorants.cells[static_cast<std::size_t>((z * size[1] + y) * size[0] + x)] =
            std::bit_cast<std::uint32_t>(largest * 1.000001f);
      }
  EXPECT_GT(violations(g, random, 3000), 100);
}

// Bounds are of use only where they are not much too high: no more than the largest value that the cell's look-ups
// reach.
TEST(MajorantCells, AreTight) {
  std::vector<float> values(32 * 32 * 32, 0);
  values[16 + 32 * (16 + 32 * 16)] = 5;
  const BrickGrid grid = make_brick_grid({32, 32, 32}, values, Storage::f32);
  const MajorantCells m = make_majorants(grid, 4, 1 << 20, 1);
  ASSERT_EQ(m.edge, 4);
  int above = 0;
  for (const std::uint32_t word : m.cells) above += std::bit_cast<float>(word) > 0;
  EXPECT_EQ(above, 8);  // voxel 16 is the first of its cell, and within reach of the cell before on each axis
  // Coarser where finer ones do not fit.
  EXPECT_GT(make_majorants(grid, 4, 1000, 1).edge, 4);
}

TEST(MajorantCells, AnyNumberOfThreadsGivesTheSame) {
  std::mt19937 random(8);
  const BrickGrid grid = random_grid(random, Storage::u16, 1 << 20).grid;
  EXPECT_EQ(make_majorants(grid, 3, 1 << 20, 1).cells, make_majorants(grid, 3, 1 << 20, 5).cells);
}

}  // namespace
}  // namespace brume

// Look-ups through the kernel agree with a dense reference in double precision, border and fade included.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "volume/brick_borders.h"
#include "volume/kernel_view.h"
#include "volume/volume_grid.h"

namespace brume {
namespace {

constexpr std::array<int, 3> voxels{11, 17, 6};  // no two alike, so that an exchange of axes shows

float voxel_value(int x, int y, int z) {
  if (x < 0 || y < 0 || z < 0 || x >= voxels[0] || y >= voxels[1] || z >= voxels[2]) return 0;
  return 1 + 0.25f * static_cast<float>((7 * x + 13 * y + 29 * z) % 16) + static_cast<float>(x + 2 * y + 3 * z);
}

BrickGrid test_grid() {
  std::vector<float> values;
  for (int z = 0; z < voxels[2]; ++z) {
    for (int y = 0; y < voxels[1]; ++y) {
      for (int x = 0; x < voxels[0]; ++x) values.push_back(voxel_value(x, y, z));
    }
  }
  return make_brick_grid(voxels, values, Storage::f32);
}

std::vector<BrickGrid> test_grids() { return {test_grid(), add_borders(test_grid(), 1)}; }

double nearest_reference(Vector3 p) {
  return double{voxel_value(static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)),
                            static_cast<int>(std::floor(p.z)))};
}

double linear_reference(Vector3 p) {
  double sum = 0;
  const int x = static_cast<int>(std::floor(p.x - 0.5)), y = static_cast<int>(std::floor(p.y - 0.5)),
            z = static_cast<int>(std::floor(p.z - 0.5));
  for (int i = 0; i < 8; ++i) {
    const int cx = x + (i & 1), cy = y + ((i >> 1) & 1), cz = z + (i >> 2);
    const double weight =
        (1 - std::fabs(p.x - 0.5 - cx)) * (1 - std::fabs(p.y - 0.5 - cy)) * (1 - std::fabs(p.z - 0.5 - cz));
    sum += weight * double{voxel_value(cx, cy, cz)};
  }
  return sum;
}

// Positions on a lattice of 1/64, so that float and double agree on the voxel; a voxel beyond the array on every side.
std::vector<Vector3> positions(int count) {
  std::mt19937 random(3);
  std::vector<Vector3> result;
  for (int i = 0; i < count; ++i) {
    Vector3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const int extent = voxels[static_cast<std::size_t>(axis)];
      p[axis] = std::uniform_int_distribution<int>(-64 * 2, 64 * (extent + 2))(random) / 64.0;
    }
    result.push_back(p);
  }
  return result;
}

kernel::vec3 to_kernel(Vector3 p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

TEST(LookUp, NearestIsTheVoxelsValue) {
  for (const BrickGrid& grid : test_grids())
    for (const Vector3 p : positions(20000))
      ASSERT_EQ(double{kernel::grid_nearest(kernel_view(grid), to_kernel(p))}, nearest_reference(p))
          << p.x << " " << p.y << " " << p.z;
}

TEST(LookUp, LinearIsTheInterpolant) {
  for (const BrickGrid& grid : test_grids())
    for (const Vector3 p : positions(20000))
      ASSERT_NEAR(double{kernel::grid_linear(kernel_view(grid), to_kernel(p))}, linear_reference(p), 1e-4)
          << grid.bordered << " " << p.x << " " << p.y << " " << p.z;
}

// The twin: the same grid read with x and z exchanged is told apart.
TEST(LookUp, AnExchangeOfAxesShows) {
  const BrickGrid grid = test_grid();
  int different = 0;
  for (const Vector3 p : positions(1000)) {
    const Vector3 exchanged{p.z, p.y, p.x};
    different +=
        std::fabs(double{kernel::grid_linear(kernel_view(grid), to_kernel(p))} - linear_reference(exchanged)) > 1e-4;
  }
  EXPECT_GT(different, 500);
}

TEST(LookUp, TheDensityIsZeroOutsideItsSupport) {
  VolumeGrid grid;
  grid.bricks = test_grid();
  const Box3 linear = support_index(grid, true), nearest = support_index(grid, false);
  EXPECT_EQ(linear.lo, (Vector3{-0.5, -0.5, -0.5}));
  EXPECT_EQ(linear.hi, (Vector3{11.5, 17.5, 6.5}));
  EXPECT_EQ(nearest.hi, (Vector3{11, 17, 6}));
  const kernel::BrickGrid view = kernel_view(grid.bricks);
  EXPECT_GT(kernel::grid_linear(view, {-0.49f, 8.5f, 3.5f}), 0);
  EXPECT_EQ(kernel::grid_linear(view, {-0.5f, 8.5f, 3.5f}), 0);
  EXPECT_GT(kernel::grid_linear(view, {5.5f, 17.49f, 3.5f}), 0);
  EXPECT_EQ(kernel::grid_linear(view, {5.5f, 17.5f, 3.5f}), 0);
  grid.support = Support::cut;
  EXPECT_EQ(support_index(grid, true).hi, nearest.hi);
}

TEST(VolumeGrid, VoxelSizeIsTheEdgesLength) {
  VolumeGrid grid;
  grid.medium_from_index = rotate(30, {1, 2, 3}) * scale({0.5, 2, 3});
  const Vector3 size = voxel_size(grid);
  EXPECT_NEAR(size.x, 0.5, 1e-12);
  EXPECT_NEAR(size.y, 2, 1e-12);
  EXPECT_NEAR(size.z, 3, 1e-12);
}

}  // namespace
}  // namespace brume

// Compares a volume as Brume reads it, in float storage, with the dense grid that its own library reads.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "volume/kernel_view.h"
#include "volume/volume_grid.h"
#include "volume/write_files.h"

namespace brume {

// The number of voxels that differ, within the array and one voxel around it.
inline int differing_voxels(const VolumeGrid& grid, const DenseGrid& expected) {
  const kernel::BrickGrid view = kernel_view(grid.bricks);
  std::array<int, 3> size{};
  for (std::size_t axis = 0; axis < 3; ++axis) size[axis] = expected.hi[axis] - expected.lo[axis] + 1;
  const auto expected_at = [&](int x, int y, int z) {
    if (x < 0 || y < 0 || z < 0 || x >= size[0] || y >= size[1] || z >= size[2]) return 0.0f;
    return expected.values[static_cast<std::size_t>((z * size[1] + y) * size[0] + x)];
  };
  int differing = 0;
  for (int z = -1; z <= size[2]; ++z) {
    for (int y = -1; y <= size[1]; ++y) {
      for (int x = -1; x <= size[0]; ++x) {
        const float found =
            kernel::grid_voxel(view, grid.first_voxel[0] + x, grid.first_voxel[1] + y, grid.first_voxel[2] + z);
        differing += found != expected_at(x, y, z);
      }
    }
  }
  return differing;
}

inline void expect_same(const VolumeGrid& grid, const DenseGrid& expected) {
  EXPECT_EQ(differing_voxels(grid, expected), 0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(grid.bricks.voxels[axis] - grid.first_voxel[axis], expected.hi[axis] - expected.lo[axis] + 1);
    EXPECT_LT(grid.first_voxel[axis], 8);
  }
  // The value at the file's integer coordinate is the one in the middle of our voxel.
  const auto first = [&](int axis) { return grid.first_voxel[static_cast<std::size_t>(axis)]; };
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 step{corner & 1 ? 5.0 : 0, corner & 2 ? 3.0 : 0, corner & 4 ? 9.0 : 0};
    const Vector3 ours = grid.medium_from_index.point(step + Vector3{first(0) + 0.5, first(1) + 0.5, first(2) + 0.5});
    const Vector3 theirs = expected.world_from_lattice.point(
        step + Vector3{double(expected.lo[0]), double(expected.lo[1]), double(expected.lo[2])});
    EXPECT_NEAR(length(ours - theirs), 0, 1e-9);
  }
}

}  // namespace brume

#include "volume/procedural.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "volume/grid_views.h"
#include "volume/resample.h"

namespace brume {
namespace {

TEST(ProceduralCloud, IsTheSameForAnyNumberOfThreads) {
  const VolumeGrid one = procedural_cloud({40, 3, Storage::u16}, 1);
  for (const int threads : {2, 3, 8}) {
    const VolumeGrid many = procedural_cloud({40, 3, Storage::u16}, threads);
    EXPECT_EQ(one.bricks.table, many.bricks.table);
    EXPECT_EQ(one.bricks.words, many.bricks.words);
  }
}

TEST(ProceduralCloud, ChangesWithItsSeed) {
  EXPECT_NE(procedural_cloud({40, 1, Storage::u16}, 2).bricks.words,
            procedural_cloud({40, 2, Storage::u16}, 2).bricks.words);
}

TEST(ProceduralCloud, FillsAMiddlingPartOfItsBoxWithDensitiesUpToOne) {
  for (const std::uint32_t seed : {0u, 1u, 2u}) {
    const VolumeGrid cloud = procedural_cloud({48, seed, Storage::f32}, 2);
    EXPECT_EQ(cloud.bricks.voxels, (std::array<int, 3>{48, 29, 48}));
    EXPECT_GE(cloud.bricks.min_value, 0);
    EXPECT_LE(cloud.bricks.max_value, 1);
    EXPECT_GT(cloud.bricks.max_value, 0.9f);
    EXPECT_GT(cloud.bricks.mean_value, 0.03);
    EXPECT_LT(cloud.bricks.mean_value, 0.3);
  }
}

// Voxels in use in the layer at height y of the medium's space.
int used_at(const VolumeGrid& cloud, double height) {
  const int n = cloud.bricks.voxels[0], y = static_cast<int>((height + 0.6) / 1.2 * cloud.bricks.voxels[1]);
  int used = 0;
  for (int z = 0; z < n; ++z) {
    for (int x = 0; x < n; ++x) used += kernel::grid_voxel(kernel_view(cloud.bricks), x, y, z) > 0.1f;
  }
  return used;
}

TEST(ProceduralCloud, IsFlatBelowAndNarrowsUpwards) {
  const VolumeGrid cloud = procedural_cloud({64, 0, Storage::u16}, 2);
  EXPECT_EQ(used_at(cloud, -0.5), 0);
  EXPECT_GT(used_at(cloud, -0.34), 600);  // a wide base a little above
  EXPECT_GT(used_at(cloud, -0.25), 2 * used_at(cloud, 0.15));
  EXPECT_GT(used_at(cloud, 0.15), 30);
}

// The cloud is not cut by its box.
TEST(ProceduralCloud, EndsWithinItsBox) {
  const VolumeGrid cloud = procedural_cloud({64, 0, Storage::u16}, 2);
  const auto [nx, ny, nz] = cloud.bricks.voxels;
  const kernel::BrickGrid view = kernel_view(cloud.bricks);
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        const bool outermost = x == 0 || y == 0 || z == 0 || x == nx - 1 || y == ny - 1 || z == nz - 1;
        if (outermost) {
          ASSERT_EQ(kernel::grid_voxel(view, x, y, z), 0);
        }
      }
    }
  }
  const Box3 box = bounds(cloud.medium_from_index, support_index(cloud, false));
  EXPECT_NEAR(box.lo.x, -1, 1e-12);
  EXPECT_NEAR(box.hi.z, 1, 1e-12);
  EXPECT_NEAR(box.hi.y, 0.6, 0.5 * 2.0 / 64);
}

TEST(ProceduralCloud, AnySizeWorksWithinItsLimits) {
  for (const int size : {1, 2, 7, 9}) EXPECT_EQ(procedural_cloud({size, 0, Storage::u8}, 2).bricks.voxels[0], size);
  EXPECT_THROW(procedural_cloud({0, 0, Storage::u8}, 1), std::invalid_argument);
  EXPECT_THROW(procedural_cloud({max_cloud_size + 1, 0, Storage::u8}, 1), std::invalid_argument);
}

TEST(Resample, KeepsValuesAndPlace) {
  const VolumeGrid cloud = procedural_cloud({40, 3, Storage::f32}, 2);
  const VolumeGrid same = resample(cloud, cloud.bricks.voxels, Storage::f32, 2);
  EXPECT_EQ(same.bricks.table, cloud.bricks.table);
  EXPECT_EQ(same.bricks.words, cloud.bricks.words);
  const VolumeGrid twice = resample(cloud, {80, 48, 80}, Storage::f32, 2);
  EXPECT_NEAR(twice.bricks.mean_value, cloud.bricks.mean_value, 1e-6);
  const Vector3 there = twice.medium_from_index.point({40, 24, 40}), here = cloud.medium_from_index.point({20, 12, 20});
  EXPECT_NEAR(length(there - here), 0, 1e-12);
}

TEST(ScatteredPuffs, OccupyATenthOfTheBricks) {
  const VolumeGrid puffs = scattered_puffs(512, Storage::u8);
  int occupied = 0;
  for (std::size_t i = 0; i < puffs.bricks.table.size() / 2; ++i) occupied += puffs.bricks.entry(i).first_word != 0;
  EXPECT_NEAR(static_cast<double>(occupied) / (64 * 64 * 64), 0.1, 0.03);
  EXPECT_GT(puffs.bricks.max_value, 0.9f);
  EXPECT_EQ(puffs.bricks.min_value, 0);
  for (const int size : {8, 9, 100}) EXPECT_GT(scattered_puffs(size, Storage::u16).bricks.max_value, 0) << size;
}

}  // namespace
}  // namespace brume

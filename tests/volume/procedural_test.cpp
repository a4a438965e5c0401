#include "volume/procedural.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "volume/kernel_view.h"
#include "volume/resample.h"

namespace brume {
namespace {

VolumeGrid cloud_of(int size, std::uint32_t seed, Storage storage) {
  return procedural_density(usual_procedural(ProceduralName::cloud, size, seed), storage, 2);
}

// Each kind by its number.
class ProceduralKinds : public testing::TestWithParam<int> {
 protected:
  static Procedural usual(int size, std::uint32_t seed) {
    return usual_procedural(static_cast<ProceduralName>(GetParam()), size, seed);
  }
};
INSTANTIATE_TEST_SUITE_P(All, ProceduralKinds, testing::Range(0, static_cast<int>(procedural_kinds.size())),
                         [](const auto& kind) {
                           return std::string(procedural_kinds[static_cast<std::size_t>(kind.param)].name);
                         });

TEST_P(ProceduralKinds, AreTheSameForAnyNumberOfThreads) {
  const std::vector<VolumeGrid> one = procedural_grids(usual(40, 3), Storage::u16, 1);
  for (const int threads : {2, 3, 8}) {
    const std::vector<VolumeGrid> many = procedural_grids(usual(40, 3), Storage::u16, threads);
    ASSERT_EQ(one.size(), many.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].bricks.table, many[i].bricks.table);
      EXPECT_EQ(one[i].bricks.words, many[i].bricks.words);
    }
  }
}

TEST_P(ProceduralKinds, ChangeWithTheirSeedAndWithEachParameter) {
  const auto words = [](const Procedural& p) {
    std::vector<std::uint32_t> all;
    for (const VolumeGrid& grid : procedural_grids(p, Storage::u16, 2))
      all.insert(all.end(), grid.bricks.words.begin(), grid.bricks.words.end());
    return all;
  };
  const std::vector<std::uint32_t> usual_words = words(usual(32, 1));
  EXPECT_NE(words(usual(32, 2)), usual_words);
  for (std::size_t i = 0; i < max_procedural_parameters; ++i) {
    const ProceduralParameter& parameter = usual(32, 1).table().parameters[i];
    if (parameter.name.empty()) break;
    Procedural changed = usual(32, 1);
    changed.values[i] = static_cast<float>(0.75 * parameter.lo + 0.25 * parameter.hi);
    EXPECT_NE(words(changed), usual_words) << parameter.name;
  }
}

// At the ends of the parameters' ranges too.
TEST_P(ProceduralKinds, HaveDensitiesFromZeroToOne) {
  for (const int end : {0, 1, 2}) {
    Procedural procedural = usual(48, static_cast<std::uint32_t>(end));
    for (std::size_t i = 0; i < max_procedural_parameters; ++i) {
      const ProceduralParameter& parameter = procedural.table().parameters[i];
      if (end > 0) procedural.values[i] = static_cast<float>(end == 1 ? parameter.lo : parameter.hi);
    }
    const VolumeGrid grid = procedural_density(procedural, Storage::f32, 2);
    EXPECT_EQ(grid.name, "density");
    EXPECT_GE(grid.bricks.min_value, 0);
    EXPECT_LE(grid.bricks.max_value, 1);
    EXPECT_GT(grid.bricks.max_value, 0.5f);
    EXPECT_GT(grid.bricks.mean_value, 0.005);
  }
}

// None is cut by its box; fog stands on the ground, the others not even there.
TEST_P(ProceduralKinds, EndWithinTheirBox) {
  for (const std::uint32_t seed : {0u, 1u, 2u}) {
    const VolumeGrid grid = procedural_density(usual(64, seed), Storage::u16, 2);
    const bool stands = usual(64, seed).kind == ProceduralName::fog;
    const auto [nx, ny, nz] = grid.bricks.voxels;
    const kernel::BrickGrid view = kernel_view(grid.bricks);
    for (int z = 0; z < nz; ++z) {
      for (int y = 0; y < ny; ++y) {
        for (int x = 0; x < nx; ++x) {
          const bool outermost = x == 0 || z == 0 || x == nx - 1 || y == ny - 1 || z == nz - 1 || (y == 0 && !stands);
          if (outermost) {
            ASSERT_LE(kernel::grid_voxel(view, x, y, z), 0.003f) << x << " " << y << " " << z;
          }
        }
      }
    }
  }
}

TEST_P(ProceduralKinds, AnySizeWorksWithinTheLimits) {
  for (const int size : {1, 2, 7, 9}) {
    const auto voxels = procedural_density(usual(size, 0), Storage::u8, 2).bricks.voxels;
    EXPECT_EQ(*std::max_element(voxels.begin(), voxels.end()), size);
  }
  EXPECT_THROW(procedural_density(usual(0, 0), Storage::u8, 1), std::invalid_argument);
  EXPECT_THROW(procedural_density(usual(max_procedural_size + 1, 0), Storage::u8, 1), std::invalid_argument);
}

// pbrt's cloud: full at the bottom, nothing at the top, billows between; its voxels fill the box to the corners.
TEST(NoiseCloud, IsFullBelowAndGoneAbove) {
  NoiseCloud cloud;
  cloud.p0 = {-1, 0, 0};
  cloud.p1 = {1, 1, 0.5};
  cloud.size = 40;
  const VolumeGrid grid = make_noise_cloud(cloud, Storage::f32, 2);
  EXPECT_EQ(grid.bricks.voxels, (std::array<int, 3>{40, 20, 10}));
  EXPECT_EQ(grid.medium_from_index.point({0, 0, 0}), cloud.p0);
  EXPECT_EQ(grid.medium_from_index.point({40, 20, 10}), cloud.p1);
  EXPECT_EQ(grid.support, Support::cut);
  const kernel::BrickGrid view = kernel_view(grid.bricks);
  std::array<double, 20> layers{};
  for (int y = 0; y < 20; ++y)
    for (int z = 0; z < 10; ++z)
      for (int x = 0; x < 40; ++x)
        layers[static_cast<std::size_t>(y)] += static_cast<double>(kernel::grid_voxel(view, x, y, z)) / 400;
  EXPECT_NEAR(layers[0], 0.95, 0.04);  // 2 (1/2 - y) of it, at least
  EXPECT_LT(layers[19], 0.1);
  for (std::size_t y = 1; y < 20; ++y) EXPECT_LT(layers[y], layers[y - 1] + 0.1) << y;
  EXPECT_GT(grid.bricks.max_value, 0.9f);
  const VolumeGrid again = make_noise_cloud(cloud, Storage::f32, 1);
  EXPECT_EQ(again.bricks.words, grid.bricks.words);
  cloud.wispiness = 0;
  EXPECT_NE(make_noise_cloud(cloud, Storage::f32, 1).bricks.words, grid.bricks.words);
}

TEST(ProceduralFire, IsHotWhereItBurns) {
  Procedural fire = usual_procedural(ProceduralName::fire, 48);
  fire.values[1] = 1500;
  const std::vector<VolumeGrid> grids = procedural_grids(fire, Storage::f32, 2);
  ASSERT_EQ(grids.size(), 2u);
  EXPECT_EQ(grids[1].name, "temperature");
  EXPECT_LE(grids[1].bricks.max_value, 1500);
  EXPECT_GT(grids[1].bricks.max_value, 1400);
  EXPECT_EQ(grids[1].bricks.nonzero_voxels, grids[0].bricks.nonzero_voxels);
}

TEST(ProceduralFog, ThinsUpwards) {
  const VolumeGrid fog = procedural_density(usual_procedural(ProceduralName::fog, 64), Storage::u16, 2);
  const kernel::BrickGrid view = kernel_view(fog.bricks);
  double low = 0, high = 0;
  for (int z = 16; z < 48; ++z) {
    for (int x = 16; x < 48; ++x) {
      low += static_cast<double>(kernel::grid_voxel(view, x, 1, z));
      high += static_cast<double>(kernel::grid_voxel(view, x, 8, z));
    }
  }
  EXPECT_GT(low, 2 * high);
  EXPECT_GT(high, 0);
}

TEST(ProceduralCloud, FillsAMiddlingPartOfItsBoxWithDensitiesUpToOne) {
  for (const std::uint32_t seed : {0u, 1u, 2u}) {
    const VolumeGrid cloud = cloud_of(48, seed, Storage::f32);
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
  const VolumeGrid cloud = cloud_of(64, 0, Storage::u16);
  EXPECT_EQ(used_at(cloud, -0.5), 0);
  EXPECT_GT(used_at(cloud, -0.34), 600);  // a wide base a little above
  EXPECT_GT(used_at(cloud, -0.25), 2 * used_at(cloud, 0.15));
  EXPECT_GT(used_at(cloud, 0.15), 30);
}

TEST(ProceduralCloud, FillsItsBox) {
  const VolumeGrid cloud = cloud_of(64, 0, Storage::u16);
  const Box3 box = bounds(cloud.medium_from_index, support_index(cloud, false));
  EXPECT_NEAR(box.lo.x, -1, 1e-12);
  EXPECT_NEAR(box.hi.z, 1, 1e-12);
  EXPECT_NEAR(box.hi.y, 0.6, 0.5 * 2.0 / 64);
}

TEST(Resample, KeepsValuesAndPlace) {
  const VolumeGrid cloud = cloud_of(40, 3, Storage::f32);
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

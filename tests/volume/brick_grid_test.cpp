// Brick grids give back the values they were made of, within the stated bound of each storage.
#include "volume/brick_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "volume/kernel_view.h"

namespace brume {
namespace {

constexpr std::array<int, 3> voxels{13, 22, 9};

// Zeros, a ramp that differs along each axis, noise over several decades, a constant brick.
std::vector<float> test_values() {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<float> values;
  for (int z = 0; z < voxels[2]; ++z) {
    for (int y = 0; y < voxels[1]; ++y) {
      for (int x = 0; x < voxels[0]; ++x) {
        float v = 0;
        if (y >= 16) v = static_cast<float>(x + 20 * y + 300 * z);
        if (y < 8 && x < 8) v = std::exp2(20 * uniform(random) - 10) * static_cast<float>((x + y + z) % 3);
        if (y >= 8 && y < 16 && x < 8) v = 2.5f;
        values.push_back(v);
      }
    }
  }
  return values;
}

float value_at(const std::vector<float>& values, int x, int y, int z) {
  if (x < 0 || y < 0 || z < 0 || x >= voxels[0] || y >= voxels[1] || z >= voxels[2]) return 0;
  return values[static_cast<std::size_t>((z * voxels[1] + y) * voxels[0] + x)];
}

struct Range {
  float lo, hi;
};

// Of the brick that holds the voxel; beyond the array's end are zeros.
Range brick_range(const std::vector<float>& values, int x, int y, int z) {
  Range range{value_at(values, x, y, z), value_at(values, x, y, z)};
  for (int i = 0; i < brick_voxels; ++i) {
    const float v = value_at(values, (x & ~7) + (i & 7), (y & ~7) + ((i >> 3) & 7), (z & ~7) + (i >> 6));
    range = {std::min(range.lo, v), std::max(range.hi, v)};
  }
  return range;
}

// The number of voxels whose error exceeds half a step of their brick, or that are 0 and did not stay 0.
int violations(const BrickGrid& grid, const std::vector<float>& values) {
  const kernel::BrickGrid view = kernel_view(grid);
  const double levels = grid.storage == Storage::u8 ? 255 : 65535;
  int count = 0;
  for (int z = 0; z < voxels[2]; ++z) {
    for (int y = 0; y < voxels[1]; ++y) {
      for (int x = 0; x < voxels[0]; ++x) {
        const float expected = value_at(values, x, y, z), found = kernel::grid_voxel(view, x, y, z);
        const Range range = brick_range(values, x, y, z);
        const double half_step =
            grid.storage == Storage::f32
                ? 0
                : 0.5 * 1.01 * (double{range.hi} - double{range.lo} + std::fabs(double{range.lo}) / 128) / levels;
        const double rounding = grid.storage == Storage::f32 ? 0 : 2 * double{range.hi} * 0x1p-24;
        const bool zero_lost = expected == 0 && range.lo == 0 && found != 0;
        count += std::fabs(double{found} - double{expected}) > half_step + rounding || zero_lost;
      }
    }
  }
  return count;
}

class BrickGridStorage : public testing::TestWithParam<Storage> {};
INSTANTIATE_TEST_SUITE_P(All, BrickGridStorage, testing::Values(Storage::u8, Storage::u16, Storage::f32));

TEST_P(BrickGridStorage, RoundTripStaysWithinItsBound) {
  const std::vector<float> values = test_values();
  EXPECT_EQ(violations(make_brick_grid(voxels, values, GetParam()), values), 0);
}

// The twin: a grid that is one step wrong in one voxel, and one whose scale is 1 % wrong, must be told apart.
TEST_P(BrickGridStorage, RoundTripTestSeesAWrongStep) {
  const std::vector<float> values = test_values();
  const BrickGrid good = make_brick_grid(voxels, values, GetParam());
  const std::size_t entry = (std::size_t{1} * 5 + 3) * 4 + 1;  // brick (0, 2, 0), a ramp
  BrickGrid bad = good;
  bad.words[good.entry(entry).first_word] += GetParam() == Storage::f32 ? 1 : 2;  // one voxel, by two steps or one ulp
  EXPECT_GT(violations(bad, values), 0);
  if (GetParam() == Storage::f32) return;
  bad = good;
  bad.table[2 * entry + 1] += 2;  // of the scale's 8 bits after the point
  EXPECT_GT(violations(bad, values), 0);
}

TEST_P(BrickGridStorage, StatisticsAreOfTheValuesGiven) {
  const std::vector<float> values = test_values();
  const BrickGrid grid = make_brick_grid(voxels, values, GetParam());
  double sum = 0;
  for (const float v : values) sum += double{v};
  EXPECT_EQ(grid.max_value, *std::ranges::max_element(values));
  EXPECT_EQ(grid.min_value, 0);
  EXPECT_EQ(grid.nonzero_voxels, std::ranges::count_if(values, [](float v) { return v != 0; }));
  EXPECT_NEAR(grid.mean_value, sum / static_cast<double>(values.size()), 1e-9 * sum);
  EXPECT_EQ(grid.bricks, (std::array<int, 3>{2, 3, 2}));
}

TEST_P(BrickGridStorage, TheSmallestValueIsOfVoxelsNotOfPadding) {
  const std::vector<float> values(3 * 5 * 7, 4.0f);
  const BrickGrid grid = make_brick_grid({3, 5, 7}, values, GetParam());
  EXPECT_EQ(grid.min_value, 4);
  EXPECT_EQ(grid.mean_value, 4);
  EXPECT_NEAR(kernel::grid_voxel(kernel_view(grid), 2, 4, 6), 4, GetParam() == Storage::f32 ? 0 : 0.5 * 4.04 / 255);
  EXPECT_EQ(kernel::grid_voxel(kernel_view(grid), 3, 4, 6), 0);
}

TEST(BrickGrid, EmptyAndConstantBricksShareWords) {
  std::vector<float> values(32 * 8 * 8, 0.0f);
  const std::size_t empty_words = make_brick_grid({32, 8, 8}, values, Storage::u16).words.size();
  EXPECT_EQ(empty_words, 256u);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = i % 32 >= 8 ? 3.0f : 0.0f;  // three bricks of 3
  const BrickGrid grid = make_brick_grid({32, 8, 8}, values, Storage::u16);
  EXPECT_EQ(grid.words.size(), 2 * empty_words);
  EXPECT_EQ(kernel::grid_voxel(kernel_view(grid), 31, 7, 7), 3);
  EXPECT_EQ(kernel::grid_voxel(kernel_view(grid), 7, 7, 7), 0);
}

TEST(BrickGrid, SizesThatCannotBeAreRefused) {
  EXPECT_THROW(BrickGridBuilder({0, 1, 1}, Storage::u16), std::length_error);
  EXPECT_THROW(BrickGridBuilder({1 << 20, 1 << 20, 1 << 20}, Storage::u16), std::length_error);
  const std::vector<float> values(7);
  EXPECT_THROW(make_brick_grid({2, 2, 2}, values, Storage::u16), std::length_error);
}

}  // namespace
}  // namespace brume

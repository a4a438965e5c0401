// Bordered bricks hold what plain ones hold, and at their borders what the neighbours hold.
#include "volume/brick_borders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "volume/kernel_view.h"

namespace brume {
namespace {

constexpr std::array<int, 3> voxels{19, 26, 13};

// Noise between zeros, brighter from brick to brick, so that neighbours have other levels.
BrickGrid noise_grid(Storage storage) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<float> values;
  for (int z = 0; z < voxels[2]; ++z)
    for (int y = 0; y < voxels[1]; ++y)
      for (int x = 0; x < voxels[0]; ++x)
        values.push_back(y < 8 && x > 3 ? 0 : uniform(random) * static_cast<float>(1 + 3 * (x / 8) + 2 * (z / 8)));
  return make_brick_grid(voxels, values, storage);
}

constexpr float largest = 1 + 3 * 2 + 2;

// By how much the corners of the grid's cells, those at its rim included, differ from the voxels of a plain grid.
float worst_corner(const BrickGrid& grid, const BrickGrid& plain) {
  const kernel::BrickGrid view = kernel_view(grid), from = kernel_view(plain);
  float worst = 0;
  for (int z = -1; z < voxels[2]; ++z)
    for (int y = -1; y < voxels[1]; ++y)
      for (int x = -1; x < voxels[0]; ++x) {
        const kernel::Cell c = kernel::grid_cell(view, x, y, z);
        const float corners[] = {c.v000, c.v100, c.v010, c.v110, c.v001, c.v101, c.v011, c.v111};
        for (int i = 0; i < 8; ++i)
          worst = std::max(
              worst, std::abs(corners[i] - kernel::grid_voxel(from, x + (i & 1), y + (i >> 1 & 1), z + (i >> 2))));
      }
  return worst;
}

class BrickBorders : public testing::TestWithParam<Storage> {
 protected:
  // Half a step of the plain grid is within; here the rest: values are rounded to the levels of the bordered brick.
  float bound() const {
    if (GetParam() == Storage::f32) return 0;
    return 0.5f * 1.01f * largest / (GetParam() == Storage::u8 ? 255 : 65535) + 1e-6f;
  }
};
INSTANTIATE_TEST_SUITE_P(All, BrickBorders, testing::Values(Storage::u8, Storage::u16, Storage::f32));

TEST_P(BrickBorders, CornersOfCellsAreTheVoxelsAround) {
  const BrickGrid plain = noise_grid(GetParam()), bordered = add_borders(plain, 2);
  EXPECT_TRUE(bordered.bordered);
  EXPECT_LE(worst_corner(bordered, plain), bound());
  EXPECT_EQ(add_borders(plain, 1).words, bordered.words);
}

// The twin: one value of a border that was taken from elsewhere.
TEST_P(BrickBorders, AWrongBorderShows) {
  const BrickGrid plain = noise_grid(GetParam());
  BrickGrid bordered = add_borders(plain, 1);
  const std::size_t row = 3 + 2, rows = 4 + 2, entry = (1 * rows + 2) * row + 1;  // brick (0, 1, 0)
  // Voxel (8, 1, 1) of the brick.
  const std::size_t number = 8 + 9 * 1 + 81 * 1, per_word = 32 / static_cast<std::size_t>(GetParam());
  bordered.words[bordered.entry(entry).first_word + number / per_word] ^= 0x40u
                                                                          << (number % per_word * (32 / per_word));
  EXPECT_GT(worst_corner(bordered, plain), bound());
}

TEST_P(BrickBorders, AlikeBricksShareWords) {
  const BrickGrid grid =
      add_borders(make_brick_grid({64, 64, 64}, std::vector<float>(64 * 64 * 64, 3.0f), GetParam()), 1);
  // Those whose upper neighbours are of 3 too are one; the rest are at a face: 9^3 - 8^3 of them on the lower sides,
  // and on the upper 8^3 - 7^3.
  const std::size_t each = (729 * static_cast<std::size_t>(GetParam()) + 31) / 32;
  EXPECT_EQ(grid.words.size(), each * (1 + 1 + (729 - 512) + (512 - 343)));
  EXPECT_EQ(kernel::grid_linear(kernel_view(grid), {20, 30, 40}), 3);
  EXPECT_NEAR(kernel::grid_linear(kernel_view(grid), {0, 30, 64}), 0.75f, bound());
}

}  // namespace
}  // namespace brume

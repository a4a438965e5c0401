// .vol files of Mitsuba.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "base/diagnostics.h"
#include "volume/kernel_view.h"
#include "volume/make_vol.h"
#include "volume/read_volume.h"
#include "volume/write_files.h"

namespace brume {
namespace {

using testing::HasSubstr;

std::string written(const std::string& bytes) {
  const std::string path = temporary_file("grid.vol");
  write_bytes(path, bytes);
  return path;
}

std::string error_of(const std::string& bytes) {
  try {
    read_volume(written(bytes), "", Storage::u16);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// `bytes` with others from `at` on.
template <class T>
std::string with(std::string bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
  return bytes;
}

// Sizes that differ, more than a brick along z: a reader that takes axes for one another or steps over rows wrongly has
// other values here.
TEST(Vol, ValuesAreInTheirCells) {
  for (const int encoding : {1, 2, 3}) {
    const VolumeGrid grid = read_volume(written(make_vol(encoding, {5, 3, 11}, 1)), "", Storage::f32);
    ASSERT_EQ(grid.bricks.voxels, (std::array<int, 3>{5, 3, 11}));
    const kernel::BrickGrid view = kernel_view(grid.bricks);
    for (int z = 0; z < 11; ++z)
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) {
          const auto value = static_cast<float>(vol_value(x, y, z));
          ASSERT_EQ(kernel::grid_voxel(view, x, y, z), encoding == 1   ? value
                                                       : encoding == 2 ? 1024 + value
                                                                       : value / 255);
        }
    EXPECT_EQ(kernel::grid_voxel(view, 5, 0, 0), 0);
  }
}

TEST(Vol, CellsFillTheFilesBoxAndEndThere) {
  const VolumeGrid grid = read_volume(written(make_vol(1, {5, 3, 11}, 1)), "density", Storage::u16);
  EXPECT_EQ(grid.support, Support::cut);
  const Box3 box = bounds(grid.medium_from_index, support_index(grid, true));
  EXPECT_NEAR(length(box.lo - Vector3{-1, 0, 2}), 0, 1e-12);
  EXPECT_NEAR(length(box.hi - Vector3{1, 3, 4}), 0, 1e-12);
}

TEST(Vol, IsListed) {
  const std::vector<GridInfo> grids = list_grids(written(make_vol(2, {5, 3, 11}, 1)));
  ASSERT_EQ(grids.size(), 1u);
  EXPECT_EQ(grids[0].name, "density");
  EXPECT_EQ(grids[0].type, "half");
  EXPECT_EQ(grids[0].voxels, (std::array<int, 3>{5, 3, 11}));
  EXPECT_EQ(grids[0].active_voxels, 165);
  EXPECT_TRUE(grids[0].renderable);
  EXPECT_NEAR(grids[0].voxel_size.x, 0.4, 1e-12);
  EXPECT_NEAR(grids[0].bounds.hi.z, 4, 1e-12);
}

TEST(Vol, GridsThatAreNoDensityAreRefusedWithAReason) {
  const std::string three = make_vol(1, {2, 2, 2}, 3), good = make_vol(1, {2, 2, 2}, 1);
  EXPECT_THAT(error_of(three), HasSubstr("it has 3 values a voxel, where a density has one"));
  EXPECT_EQ(list_grids(written(three))[0].type, "float x 3");
  EXPECT_THAT(error_of(with(make_vol(3, {2, 2, 2}, 1), 4, 4)), HasSubstr("directions"));
  EXPECT_THAT(error_of(with(good, 48 + 4 * 5, -2.5f)), HasSubstr("1 of its values are negative or not finite"));
  EXPECT_THAT(error_of(with(good, 48 + 4 * 5, -2.5f)), HasSubstr("the first -2.5 at voxel (1, 0, 1)"));
  EXPECT_THAT(error_of(with(good, 48, std::numeric_limits<float>::quiet_NaN())), HasSubstr("not finite"));
}

TEST(Vol, SanitizedValuesAreZero) {
  const std::string good = make_vol(1, {2, 2, 2}, 1);
  const VolumeGrid grid =
      read_volume(written(with(good, 48 + 4 * 5, -2.5f)), "", {Storage::f32, BadValues::taken_as_0});
  const VolumeGrid expected = read_volume(written(with(good, 48 + 4 * 5, 0.0f)), "", Storage::f32);
  EXPECT_EQ(grid.bricks.words, expected.bricks.words);
  EXPECT_THAT(grid.warning, HasSubstr("the first -2.5 at voxel (1, 0, 1); they are taken as 0"));
}

TEST(Vol, FilesThatAreNoneAreRefusedWithAReason) {
  const std::string good = make_vol(1, {2, 2, 2}, 1);
  EXPECT_THAT(error_of(""), HasSubstr("does not begin with VOL"));
  EXPECT_THAT(error_of("this is not a volume"), HasSubstr("does not begin with VOL"));
  EXPECT_THAT(error_of(with(good, 3, '\x02')), HasSubstr("version 2 of the format; only version 3"));
  EXPECT_THAT(error_of(with(good, 4, 7)), HasSubstr("unknown encoding 7"));
  EXPECT_THAT(error_of(with(good, 8, 0)), HasSubstr("0 x 2 x 2 voxels"));
  EXPECT_THAT(error_of(with(good, 8, 3)),
              HasSubstr("3 x 2 x 2 voxels of type float are 48 bytes, but the file has 32"));
  EXPECT_THAT(error_of(good + "more"), HasSubstr("are 32 bytes, but the file has 36"));
  EXPECT_THAT(error_of(with(good, 24, 5.0f)), HasSubstr("its box goes from 5 to 1 along x"));
  EXPECT_THAT(error_of(good.substr(0, 30)), HasSubstr("the file ends at byte 30"));
}

}  // namespace
}  // namespace brume

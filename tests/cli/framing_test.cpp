// A volume on its own: ellipsoid.vdb, grid "density" of 23 x 15 x 11 voxels of edge 0.25 about the origin, densest in
// the middle and fading to nothing at its surface (made for this test).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cli/run_program.h"
#include "image/image.h"
#include "image/temporary_folder.h"
#include "session/frame_volume.h"
#include "session/grid_extent.h"
#include "volume/make_vol.h"

namespace brume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string volume = BRUME_TEST_FOLDER "/ellipsoid.vdb";

Vector3 pixel(const Image& image, int x, int y) {
  const auto at = [&](int c) {
    return static_cast<double>(image.pixels[static_cast<std::size_t>(3 * (y * image.width + x) + c)]);
  };
  return {at(0), at(1), at(2)};
}

TEST(Framing, ShowsTheWholeVolumeInFrontOfTheSky) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder.path(), {volume, "--spp", "1", "-o", "a.pfm", "--resolution", "60x40"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.error, HasSubstr("ellipsoid.vdb: grid density, 23 x 15 x 11 voxels"));
  EXPECT_THAT(outcome.error, HasSubstr("optical depth of 16"));
  const Image image = read_image(folder.file("a.pfm"));
  const Vector3 sky = pixel(image, 0, 0);
  for (int x = 0; x < image.width; ++x)
    for (const int y : {0, image.height - 1}) EXPECT_EQ(pixel(image, x, y), sky);
  for (int y = 0; y < image.height; ++y)
    for (const int x : {0, image.width - 1}) EXPECT_EQ(pixel(image, x, y), sky);
  EXPECT_GT(length(pixel(image, 30, 20) - sky), 0.05);
}

TEST(Framing, AWrittenSceneGivesTheSameBits) {
  const TemporaryFolder folder;
  run(folder.path(), {volume, "--spp", "2", "--resolution", "30x20", "--write-scene", "a.pbrt", "-o", "a.pfm"});
  const Outcome outcome = run(folder.path(), {"a.pbrt", "-o", "b.pfm"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(bytes_of(folder.file("a.pfm")), bytes_of(folder.file("b.pfm")));
}

TEST(Framing, GoesToThePictureOfTheVolumesName) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder.path(), {volume, "--grid", "density", "--spp", "1", "--resolution", "9x6"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(folder.names(), ElementsAre("ellipsoid.png"));
}

TEST(Framing, BadValuesAreAnErrorUnlessSanitized) {
  const TemporaryFolder folder;
  std::string vol = make_vol(1, {8, 8, 8}, 1);
  const float bad = -1;
  vol.replace(48 + 4 * 100, 4, reinterpret_cast<const char*>(&bad), 4);
  write_bytes_to(folder.file("a.vol"), vol);
  const std::vector<std::string> render = {"a.vol", "--spp", "1", "--resolution", "9x6", "-o", "a.pfm"};
  Outcome outcome = run(folder.path(), render);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.error, HasSubstr("the first -1 at voxel (4, 4, 1)"));
  EXPECT_THAT(outcome.error, HasSubstr("--sanitize"));
  outcome = run(folder.path(), {"info", "a.vol"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("8 x 8 x 8 voxels"));
  EXPECT_THAT(outcome.error, HasSubstr("a.vol: error: grid \"density\" cannot be rendered: 1 of its values"));
  std::vector<std::string> sanitized = render;
  for (const char* argument : {"--sanitize", "--write-scene", "a.pbrt"}) sanitized.emplace_back(argument);
  outcome = run(folder.path(), sanitized);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.error, HasSubstr("they are taken as 0"));
  outcome = run(folder.path(), {"a.pbrt", "-o", "b.pfm"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(bytes_of(folder.file("a.pfm")), bytes_of(folder.file("b.pfm")));
}

TEST(Framing, InfoAndAMissingGrid) {
  const TemporaryFolder folder;
  const Outcome info = run(folder.path(), {"info", volume});
  EXPECT_THAT(info.out, HasSubstr("1 grid\n  density: half, fog volume\n    23 x 15 x 11 voxels"));
  // A density of 1 in four units across the middle.
  for (const char* part :
       {"index (9, 13, 15) to (31, 27, 25)", "bounds (-2.875, -1.875, -1.375) to (2.875, 1.875, 1.375)",
        "each 0.25 x 0.25 x 0.25", "densities from 0 to 1, mean 0.2542; 62.1 % of the voxels",
        "mean free path 1 at the greatest density", "optical depth 4 along", "\"scale\" 2.5 would"})
    EXPECT_THAT(info.out, HasSubstr(part));
  const Outcome missing = run(folder.path(), {volume, "--grid", "temperature"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.error, HasSubstr("density"));
}

// Written as a scene, the volume keeps its type.
TEST(Framing, TakesAVolOfMitsuba) {
  const TemporaryFolder folder;
  write_bytes_to(folder.file("a.vol"), make_vol(3, {4, 5, 6}, 1));
  write_bytes_to(folder.file("rgb.vol"), make_vol(1, {2, 2, 2}, 3));
  const Outcome info = run(folder.path(), {"info", "a.vol"});
  EXPECT_THAT(info.out, HasSubstr("density: uint8, dense grid\n    4 x 5 x 6 voxels"));
  const Outcome outcome =
      run(folder.path(), {"a.vol", "--spp", "1", "--resolution", "9x6", "-o", "a.pfm", "--write-scene", "a.pbrt"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(bytes_of(folder.file("a.pbrt")), HasSubstr("\"string type\" \"vol\""));
  EXPECT_EQ(run(folder.path(), {"a.pbrt", "-o", "b.pfm"}).exit_code, 0);
  EXPECT_EQ(bytes_of(folder.file("a.pfm")), bytes_of(folder.file("b.pfm")));
  const Outcome three = run(folder.path(), {"rgb.vol"});
  EXPECT_EQ(three.exit_code, 1);
  EXPECT_THAT(three.error, HasSubstr("it has 3 values a voxel"));
  EXPECT_THAT(run(folder.path(), {"info", "rgb.vol"}).out, HasSubstr("3 values a voxel"));
}

TEST(Framing, FitsEveryShapeOfPicture) {
  const Framing framing{0.3, 0.2};
  for (const int width : {10, 100, 150, 1000}) {
    constexpr int height = 100;
    const double half_shorter = std::tan(0.5 * fov_for(framing, width, height) * 3.14159265358979 / 180);
    const double half_width = half_shorter * std::max(1.0, width / 100.0),
                 half_height = half_shorter * std::max(1.0, 100.0 / width);
    EXPECT_GE(half_width, framing.half_width - 1e-9);
    EXPECT_GE(half_height, framing.half_height - 1e-9);
    EXPECT_TRUE(half_width < framing.half_width + 1e-9 || half_height < framing.half_height + 1e-9);
  }
}

// Values of 2 throughout, but for one of 1 and, in the twin, one of 0: in an array that begins before them.
TEST(GridExtent, SmallestDensity) {
  for (const float smallest : {1.0f, 0.0f}) {
    std::vector<float> values(20 * 12 * 9);
    for (int z = 1; z < 9; ++z)
      for (int y = 2; y < 12; ++y)
        for (int x = 3; x < 20; ++x) values[static_cast<std::size_t>((z * 12 + y) * 20 + x)] = 2;
    values[(5 * 12 + 7) * 20 + 11] = smallest;
    VolumeGrid grid;
    grid.bricks = make_brick_grid({20, 12, 9}, values, Storage::f32);
    grid.first_voxel = {3, 2, 1};
    EXPECT_EQ(smallest_density(grid), smallest);
  }
}

// 20 x 12 x 9 voxels, empty but for three: the densest row is another one along each axis.
VolumeGrid sparse_grid() {
  std::vector<float> values(20 * 12 * 9);
  const auto set = [&](int x, int y, int z, float v) { values[static_cast<std::size_t>((z * 12 + y) * 20 + x)] = v; };
  set(3, 5, 2, 1);
  set(17, 5, 2, 2);
  set(17, 11, 2, 4);
  VolumeGrid grid;
  grid.bricks = make_brick_grid({20, 12, 9}, values, Storage::f32);
  return grid;
}

TEST(GridExtent, DensestRows) {
  const VolumeGrid grid = sparse_grid();
  EXPECT_DOUBLE_EQ(densest_row(grid, 0), 4);
  EXPECT_DOUBLE_EQ(densest_row(grid, 1), 6);
  EXPECT_DOUBLE_EQ(densest_row(grid, 2), 4);
}

TEST(GridExtent, OccupiedBoxes) {
  Box3 all;
  const std::vector<Box3> boxes = occupied_boxes(sparse_grid());
  EXPECT_EQ(boxes.size(), 3u);
  for (const Box3& box : boxes) {
    all.include(box.lo);
    all.include(box.hi);
  }
  EXPECT_EQ(all.lo, (Vector3{3, 5, 2}));
  EXPECT_EQ(all.hi, (Vector3{18, 12, 3}));
}

}  // namespace
}  // namespace brume

// .vdb files as OpenVDB writes them, read back and compared with what OpenVDB reads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/diagnostics.h"
#include "volume/expect_same.h"
#include "volume/half.h"
#include "volume/read_volume.h"
#include "volume/write_files.h"

namespace brume {
namespace {

using testing::HasSubstr;

void expect_round_trip(const VdbOptions& options) {
  const std::string path = temporary_file("round_trip.vdb");
  write_vdb(path, options);
  const DenseGrid expected = read_back_vdb(path);
  const VolumeGrid grid = read_volume(path, "", Storage::f32);
  expect_same(grid, expected);
  EXPECT_EQ(grid.name, "density");
  EXPECT_EQ(grid.support, Support::fade);
  const std::vector<GridInfo> infos = list_grids(path);
  ASSERT_EQ(infos.size(), 1u);
  EXPECT_EQ(infos[0].active_voxels, expected.active_voxels);
  EXPECT_EQ(infos[0].type, options.half ? "half" : "float");
  EXPECT_EQ(infos[0].grid_class, "fog volume");
  EXPECT_TRUE(infos[0].renderable);
  const Box3 box = bounds(grid.medium_from_index, support_index(grid, false));
  EXPECT_NEAR(length(infos[0].bounds.lo - box.lo) + length(infos[0].bounds.hi - box.hi), 0, 1e-9);
}

std::string error_of(const std::string& path, const std::string& name = "") {
  try {
    read_volume(path, name, Storage::u16);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Vdb, EveryPackingReadsBack) {
  for (const VdbPacking packing : {VdbPacking::none, VdbPacking::zip, VdbPacking::blosc}) {
    for (const bool active_mask : {false, true}) {
      for (const bool half : {false, true}) {
        SCOPED_TRACE(testing::Message() << static_cast<int>(packing) << active_mask << half);
        VdbOptions options;
        options.packing = packing;
        options.active_mask = active_mask;
        options.half = half;
        expect_round_trip(options);
      }
    }
  }
}

TEST(Vdb, EveryAffinePlacementReadsBack) {
  for (const VdbPlacement placement :
       {VdbPlacement::uniform, VdbPlacement::scale, VdbPlacement::translate, VdbPlacement::affine}) {
    SCOPED_TRACE(static_cast<int>(placement));
    VdbOptions options;
    options.placement = placement;
    expect_round_trip(options);
  }
}

TEST(Vdb, BoundsAreFoundWhereTheFileDoesNotTell) {
  VdbOptions options;
  options.statistics = false;
  expect_round_trip(options);
}

// The twin of the comparison: a file with one other value is told apart.
TEST(Vdb, TheComparisonSeesOneWrongVoxel) {
  const std::string path = temporary_file("one_wrong.vdb");
  VdbOptions options;
  options.change = [](int x, int y, int z, float value) {
    return x == 7 && y == 9 && z == -22 ? value + 1e-5f : value;
  };
  write_vdb(path, options);
  const VolumeGrid grid = read_volume(path, "", Storage::f32);
  write_vdb(path, {});
  EXPECT_EQ(differing_voxels(grid, read_back_vdb(path)), 1);
}

TEST(Vdb, ValuesThatAreNoDensityAreCounted) {
  const std::string path = temporary_file("bad_values.vdb");
  VdbOptions options;
  options.change = [](int x, int y, int z, float value) {
    if (x == 8 && y == 4 && (z == 1 || z == 2)) return -2.0f;
    if (x == 9 && y == 4 && z == 4) return std::numeric_limits<float>::quiet_NaN();
    return value;
  };
  write_vdb(path, options);
  EXPECT_THAT(error_of(path), HasSubstr("3 of its values are negative or not finite, the first -2 at voxel (8, 4, 1)"));
}

// The twin reads them as they are.
TEST(Vdb, SanitizedValuesAreZeroAndTheOthersAsTheyWere) {
  const std::string path = temporary_file("sanitized.vdb"), expected = temporary_file("zeros.vdb");
  const auto is_bad = [](int x, int y, int z) { return x == 8 && y == 4 && (z == 1 || z == 2); };
  VdbOptions bad, zeros;
  bad.change = [&](int x, int y, int z, float value) {
    return is_bad(x, y, z) ? (z == 1 ? -2.0f : std::numeric_limits<float>::infinity()) : value;
  };
  zeros.change = [&](int x, int y, int z, float value) { return is_bad(x, y, z) ? 0 : value; };
  write_vdb(path, bad);
  write_vdb(expected, zeros);
  const VolumeGrid grid = read_volume(path, "", {Storage::f32, BadValues::taken_as_0});
  expect_same(grid, read_back_vdb(expected));
  EXPECT_EQ(grid.warning, "grid \"density\" of " + path +
                              ": 2 of its values are negative or not finite, the first -2 at voxel (8, 4, 1); they are "
                              "taken as 0");
  EXPECT_EQ(differing_voxels(grid, read_back_vdb(path)), 2);
  EXPECT_EQ(read_volume(expected, "", {Storage::f32, BadValues::taken_as_0}).warning, "");
}

TEST(Vdb, TheGridIsChosenByTheRule) {
  const std::string path = temporary_file("choice.vdb");
  write_vdb_names(path, {"heat", "density"});
  EXPECT_EQ(read_volume(path, "", Storage::u16).name, "density");
  EXPECT_EQ(read_volume(path, "heat", Storage::u16).bricks.max_value, 1);
  EXPECT_THAT(error_of(path, "smoke"), HasSubstr("has no grid \"smoke\"; it has"));
  EXPECT_THAT(error_of(path, "densty"), HasSubstr("has no grid \"densty\"; did you mean \"density\"? it has"));
  write_vdb_names(path, {"soot"});
  EXPECT_EQ(read_volume(path, "", Storage::u16).name, "soot");
  write_vdb_names(path, {"soot", "heat"});
  EXPECT_THAT(error_of(path), HasSubstr("several grids that could be the density: name one; it has"));
}

TEST(Vdb, OfSeveralGridsOfOneNameTheFirstIsTaken) {
  const std::string path = temporary_file("repeated.vdb");
  write_vdb_names(path, {"density", "density", "density"});
  const std::vector<GridInfo> infos = list_grids(path);
  ASSERT_EQ(infos.size(), 3u);
  EXPECT_EQ(infos[0].note, "");
  EXPECT_THAT(infos[1].note, HasSubstr("\"density\" stands for the first"));
  EXPECT_EQ(read_volume(path, "", Storage::u16).bricks.max_value, 1);
  EXPECT_EQ(read_volume(path, infos[2].name, Storage::u16).bricks.max_value, 3);
}

TEST(Vdb, ASharedTreeIsReadForEachOfItsGrids) {
  const std::string path = temporary_file("shared.vdb");
  write_vdb_names(path, {"density", "heat"}, true);
  const VolumeGrid density = read_volume(path, "density", Storage::u16), heat = read_volume(path, "heat", Storage::u16);
  EXPECT_EQ(density.bricks.words, heat.bricks.words);
  EXPECT_NEAR(voxel_size(heat).x, 2, 1e-12);
}

TEST(Vdb, OtherGridsAreListedAndRefusedWithAReason) {
  const std::string path = temporary_file("mixed.vdb");
  write_vdb_mixed(path, false);
  EXPECT_EQ(read_volume(path, "", Storage::u16).name, "heat");
  EXPECT_THAT(error_of(path, "flags"), HasSubstr("its values are of type int32"));
  EXPECT_THAT(error_of(path, "v"), HasSubstr("its values are of type vec3s"));
  for (const GridInfo& info : list_grids(path)) {
    EXPECT_EQ(info.renderable, info.name == "heat");
    EXPECT_EQ(info.grid_class == "staggered", info.name == "v");
  }
  write_vdb_mixed(path, true);
  EXPECT_THAT(error_of(path), HasSubstr("a level set; convert it to a fog volume first"));
}

TEST(Vdb, WhatCannotBeRenderedIsRefusedWithAReason) {
  const std::string path = temporary_file("refused.vdb");
  VdbOptions options;
  options.placement = VdbPlacement::frustum;
  write_vdb(path, options);
  EXPECT_THAT(error_of(path), HasSubstr("its transform is a NonlinearFrustumMap"));
  write_vdb_background(path);
  EXPECT_THAT(error_of(path), HasSubstr("background is 0.5"));
  write_vdb_empty(path);
  EXPECT_THAT(error_of(path), HasSubstr("no active voxels"));
  write_vdb_far_apart(path);
  EXPECT_THAT(error_of(path), HasSubstr("too many for a file of"));
}

TEST(Vdb, FilesThatAreNoneAreRefusedWithAReason) {
  const std::string path = temporary_file("none.vdb");
  write_bytes(path, "this is not a volume");
  EXPECT_THAT(error_of(path), HasSubstr("not an OpenVDB file"));
  write_bytes(path, "");
  EXPECT_THAT(error_of(path), HasSubstr("not an OpenVDB file"));
  write_vdb(path, {});
  std::string bytes = read_bytes(path);
  bytes[8] = static_cast<char>(200);
  write_bytes(path, bytes);
  EXPECT_THAT(error_of(path), HasSubstr("file version 200; versions 222 to 224 can be read"));
  EXPECT_THAT(error_of(temporary_file("missing.vdb")), HasSubstr("missing.vdb"));
  EXPECT_THAT(error_of("cloud.exr"), HasSubstr("volume files end in .vdb, .nvdb or .vol, not in \".exr\""));
}

// A directory that would have the same bytes read over and over.
TEST(Vdb, DirectoriesThatClaimTooMuchAreRefused) {
  const std::string path = temporary_file("claims.vdb"), type = "Tree_float_5_4_3";
  write_vdb(path, {});
  const std::string good = read_bytes(path);
  const std::size_t at_type = good.find(type), at_name = good.find("density");
  ASSERT_NE(at_type, std::string::npos);
  ASSERT_LT(at_name, at_type);
  const auto error_with = [&](std::size_t at, std::string_view patch) {
    std::string bytes = good;
    bytes.replace(at, patch.size(), patch);
    write_bytes(path, bytes);
    return error_of(path);
  };
  constexpr std::string_view many("\xe9\x03\0\0", 4), nowhere("\0\0\0\0\0\0\0\0", 8);
  // Before the name stand the number of grids and its own length; after the type, the length of an empty name.
  EXPECT_THAT(error_with(at_name - 8, many), HasSubstr("said to hold 1001 grids; at most 1000 are read"));
  EXPECT_THAT(error_with(at_type + type.size() + 4, nowhere), HasSubstr("does not follow its description"));
}

TEST(Vdb, HalvesBecomeTheirFloats) {
  EXPECT_EQ(half_to_float(0x0000), 0.0f);
  EXPECT_EQ(half_to_float(0x0001), 0x1p-24f);
  EXPECT_EQ(half_to_float(0x03ff), 1023 * 0x1p-24f);
  EXPECT_EQ(half_to_float(0x0400), 0x1p-14f);
  EXPECT_EQ(half_to_float(0x3c00), 1.0f);
  EXPECT_EQ(half_to_float(0xc500), -5.0f);
  EXPECT_EQ(half_to_float(0x7bff), 65504.0f);
  EXPECT_EQ(half_to_float(0xfc00), -std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(half_to_float(0x7e00)));
}

}  // namespace
}  // namespace brume

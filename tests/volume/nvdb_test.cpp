// .nvdb files as NanoVDB writes them, read back and compared with what NanoVDB reads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/diagnostics.h"
#include "volume/expect_same.h"
#include "volume/read_volume.h"
#include "volume/write_files.h"

namespace brume {
namespace {

using testing::HasSubstr;

std::string error_of(const std::string& path, const std::string& name = "") {
  try {
    read_volume(path, name, Storage::u16);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

void expect_round_trip(VdbPacking packing, NvdbValues values) {
  SCOPED_TRACE(testing::Message() << static_cast<int>(packing) << static_cast<int>(values));
  const std::string path = temporary_file("round_trip.nvdb");
  VdbOptions options;
  options.packing = packing;
  write_nvdb(path, options, values);
  const DenseGrid expected = read_back_nvdb(path, values);
  const VolumeGrid grid = read_volume(path, "", Storage::f32);
  expect_same(grid, expected);
  const std::vector<GridInfo> infos = list_grids(path);
  ASSERT_EQ(infos.size(), 1u);
  EXPECT_EQ(infos[0].name, "density");
  EXPECT_EQ(infos[0].grid_class, "fog volume");
  EXPECT_EQ(infos[0].active_voxels, expected.active_voxels);
  const Box3 box = bounds(grid.medium_from_index, support_index(grid, false));
  EXPECT_NEAR(length(infos[0].bounds.lo - box.lo) + length(infos[0].bounds.hi - box.hi), 0, 1e-9);
}

TEST(Nvdb, EveryCodecReadsBack) {
  for (const VdbPacking packing : {VdbPacking::none, VdbPacking::zip, VdbPacking::blosc}) {
    expect_round_trip(packing, NvdbValues::float32);
  }
}

TEST(Nvdb, EveryQuantisationReadsBack) {
  for (const NvdbValues values : {NvdbValues::fp4, NvdbValues::fp8, NvdbValues::fp16, NvdbValues::fpn}) {
    expect_round_trip(VdbPacking::none, values);
  }
}

// The same grid through both formats is the same.
TEST(Nvdb, AgreesWithVdb) {
  const std::string vdb = temporary_file("both.vdb"), nvdb = temporary_file("both.nvdb");
  write_vdb(vdb, {});
  write_nvdb(nvdb, {}, NvdbValues::float32);
  const VolumeGrid a = read_volume(vdb, "", Storage::u8), b = read_volume(nvdb, "", Storage::u8);
  EXPECT_EQ(differing_voxels(read_volume(nvdb, "", Storage::f32), read_back_vdb(vdb)), 0);
  EXPECT_EQ(a.bricks.voxels, b.bricks.voxels);
  EXPECT_EQ(a.bricks.nonzero_voxels, b.bricks.nonzero_voxels);
  EXPECT_EQ(a.bricks.mean_value, b.bricks.mean_value);
}

TEST(Nvdb, OtherGridsAreListedAndRefusedWithAReason) {
  const std::string path = temporary_file("mixed.nvdb");
  write_nvdb_mixed(path);
  ASSERT_EQ(list_grids(path).size(), 3u);
  EXPECT_EQ(read_volume(path, "", Storage::u16).name, "heat");
  EXPECT_THAT(error_of(path, "flags"), HasSubstr("its values are of type int32"));
  EXPECT_THAT(error_of(path, "v"), HasSubstr("its values are of type Vec3f"));
}

TEST(Nvdb, OtherVersionsAreRefusedWithTheVersionsThatCanBeRead) {
  const std::string path = temporary_file("version.nvdb");
  write_nvdb(path, {}, NvdbValues::float32);
  const std::string good = read_bytes(path);
  const auto with_version = [&](std::uint32_t major, std::uint32_t minor) {
    const std::uint32_t version = major << 21 | minor << 10 | 1;
    std::string bytes = good;
    bytes.replace(8, 4, reinterpret_cast<const char*>(&version), 4);
    write_bytes(path, bytes);
    return error_of(path);
  };
  EXPECT_THAT(with_version(32, 2), HasSubstr("NanoVDB version 32.2.1; versions 32.3 to 32.* can be read"));
  EXPECT_THAT(with_version(33, 0), HasSubstr("NanoVDB version 33.0.1; versions 32.3 to 32.* can be read"));
  EXPECT_EQ(with_version(32, 3), "no error");
}

// Files and buffers of version 32.6 on have other marks and the same layout.
TEST(Nvdb, MarksOfLaterVersionsAreKnown) {
  const std::string path = temporary_file("later.nvdb");
  VdbOptions options;
  options.packing = VdbPacking::none;
  write_nvdb(path, options, NvdbValues::float32);
  std::string bytes = read_bytes(path);
  const std::size_t buffer = bytes.find("NanoVDB0", 1);
  ASSERT_NE(buffer, std::string::npos);
  bytes[7] = '2';
  bytes[buffer + 7] = '1';
  write_bytes(path, bytes);
  EXPECT_EQ(error_of(path), "no error");
  bytes[7] = '7';
  write_bytes(path, bytes);
  EXPECT_THAT(error_of(path), HasSubstr("not a NanoVDB file"));
}

}  // namespace
}  // namespace brume

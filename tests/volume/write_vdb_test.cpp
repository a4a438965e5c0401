// .vdb files as Brume writes them, against what OpenVDB and Brume read.
#include "volume/write_vdb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "volume/expect_same.h"
#include "volume/half.h"
#include "volume/procedural.h"
#include "volume/read_volume.h"
#include "volume/write_files.h"

namespace brume {
namespace {

std::string written(const std::vector<VolumeGrid>& grids, bool half) {
  const std::string path = temporary_file("written.vdb");
  write_bytes(path, encode_vdb(grids, half, "test"));
  return path;
}

// The greatest difference between what was written and what is in the file by OpenVDB, within the box of the active
// voxels; outside of it what was written must be 0.
float greatest_error(const VolumeGrid& grid, const DenseGrid& found) {
  const kernel::BrickGrid view = kernel_view(grid.bricks);
  const auto& n = grid.bricks.voxels;
  float greatest = 0;
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x) {
        const std::array<int, 3> at{x, y, z};
        std::size_t index = 0;
        bool inside = true;
        for (const std::size_t axis : {2u, 1u, 0u}) {
          inside = inside && at[axis] >= found.lo[axis] && at[axis] <= found.hi[axis];
          const int size = found.hi[axis] - found.lo[axis] + 1;
          index = index * static_cast<std::size_t>(size) + static_cast<std::size_t>(at[axis] - found.lo[axis]);
        }
        const float expected = kernel::grid_voxel(view, x, y, z);
        greatest = std::max(greatest, std::fabs(expected - (inside ? found.values[index] : 0)));
      }
  return greatest;
}

TEST(WriteVdb, BothReadersGetWhatWasWritten) {
  for (const ProceduralName kind : {ProceduralName::smoke, ProceduralName::fog, ProceduralName::fire}) {
    const std::vector<VolumeGrid> grids = procedural_grids(usual_procedural(kind, 45, 2), Storage::f32, 2);
    const std::string path = written(grids, false);
    EXPECT_EQ(list_grids(path).size(), grids.size());
    for (const VolumeGrid& grid : grids) {
      const DenseGrid by_library = read_back_vdb(path, grid.name);
      EXPECT_EQ(greatest_error(grid, by_library), 0);
      EXPECT_EQ(by_library.active_voxels, grid.bricks.nonzero_voxels);
      EXPECT_EQ(vdb_kind(path, grid.name), "fog volume float");
      const VolumeGrid by_us = read_volume(path, grid.name, Storage::f32);
      expect_same(by_us, by_library);
      // The same voxel is at the same place.
      const Vector3 middle{0.5 + by_library.lo[0], 0.5 + by_library.lo[1], 0.5 + by_library.lo[2]};
      const Vector3 first{0.5 + by_us.first_voxel[0], 0.5 + by_us.first_voxel[1], 0.5 + by_us.first_voxel[2]};
      EXPECT_NEAR(length(grid.medium_from_index.point(middle) - by_us.medium_from_index.point(first)), 0, 1e-12);
    }
  }
}

TEST(WriteVdb, HalvesAreRoundedToTheNearest) {
  const std::vector<VolumeGrid> grids =
      procedural_grids(usual_procedural(ProceduralName::fire, 40, 1), Storage::f32, 2);
  const std::string path = written(grids, true);
  EXPECT_EQ(vdb_kind(path, "temperature"), "fog volume half");
  EXPECT_LE(greatest_error(grids[0], read_back_vdb(path, "density")), 0x1p-12f);
  EXPECT_LE(greatest_error(grids[1], read_back_vdb(path, "temperature")), 0.5f);  // below 2048 K
  expect_same(read_volume(path, "density", Storage::f32), read_back_vdb(path, "density"));
  EXPECT_EQ(list_grids(path)[1].type, "half");
}

// More than one node of each level of the tree, and voxels that touch none of its corners.
TEST(WriteVdb, LargeGridsHaveTheirNodesInOrder) {
  BrickGridBuilder builder({4200, 150, 30}, Storage::f32);
  std::array<float, brick_voxels> values{};
  const std::array<int, 3> places[] = {{0, 0, 0},    {1, 17, 2},   {15, 15, 3}, {16, 0, 1},
                                       {511, 18, 0}, {512, 16, 2}, {524, 0, 3}};
  for (const std::array<int, 3>& brick : places) {
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<float>((i * 7 + static_cast<std::size_t>(brick[0])) % 5);
    builder.set_brick(brick, values);
  }
  VolumeGrid grid;
  grid.name = "density";
  grid.bricks = builder.finish();
  grid.medium_from_index = rotate(30, {1, 2, 3}) * translate({1, 2, 3}) * scale({0.5, 0.25, 2});
  std::vector<VolumeGrid> grids;
  grids.push_back(std::move(grid));
  const std::string path = written(grids, false);
  const DenseGrid by_library = read_back_vdb(path);
  EXPECT_EQ(greatest_error(grids[0], by_library), 0);
  expect_same(read_volume(path, "", Storage::f32), by_library);
}

TEST(WriteVdb, TheSameGridsGiveTheSameBytes) {
  const Procedural smoke = usual_procedural(ProceduralName::smoke, 32, 4);
  const std::string bytes = encode_vdb(procedural_grids(smoke, Storage::f32, 1), true, "test");
  EXPECT_EQ(bytes, encode_vdb(procedural_grids(smoke, Storage::f32, 3), true, "test"));
  EXPECT_NE(bytes, encode_vdb(procedural_grids(smoke, Storage::f32, 3), true, "other"));
}

TEST(WriteVdb, OnlyFloatsAreWritten) {
  const std::vector<VolumeGrid> grids = procedural_grids(usual_procedural(ProceduralName::fog, 16), Storage::u16, 1);
  EXPECT_THROW(encode_vdb(grids, false, "test"), std::invalid_argument);
}

TEST(Half, EveryHalfIsItself) {
  for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    if ((bits & 0x7fff) > 0x7c00) continue;  // NaN
    ASSERT_EQ(float_to_half(half_to_float(half)), half);
  }
}

TEST(Half, FloatsGoToTheNearestAndFromTheMiddleToEven) {
  for (std::uint32_t bits = 0; bits < 0x7bff; ++bits) {
    const float lower = half_to_float(static_cast<std::uint16_t>(bits)),
                upper = half_to_float(static_cast<std::uint16_t>(bits + 1));
    const float middle = 0.5f * (lower + upper);
    ASSERT_EQ(float_to_half(std::nextafter(middle, 0.0f)), bits) << bits;
    ASSERT_EQ(float_to_half(std::nextafter(middle, 1e6f)), bits + 1) << bits;
    ASSERT_EQ(float_to_half(middle), bits % 2 == 0 ? bits : bits + 1) << bits;
    ASSERT_EQ(float_to_half(-middle), 0x8000u | (bits % 2 == 0 ? bits : bits + 1)) << bits;
  }
  EXPECT_EQ(float_to_half(65519.0f), 0x7bff);
  EXPECT_EQ(float_to_half(65520.0f), 0x7c00);
  EXPECT_EQ(float_to_half(1e30f), 0x7c00);
}

}  // namespace
}  // namespace brume

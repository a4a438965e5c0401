#include "volume/write_files.h"

#include <gtest/gtest.h>
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <openvdb/openvdb.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>

namespace brume {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;

// Never zero, different along each axis.
float test_value(int x, int y, int z) {
  return 0.5f + 0.125f * static_cast<float>((5 * x + 11 * y + 3 * z) & 15) + 0.01f * static_cast<float>(x + 40);
}

openvdb::math::Transform::Ptr make_placement(VdbPlacement placement) {
  using openvdb::Vec3d;
  using openvdb::math::Transform;
  switch (placement) {
    case VdbPlacement::uniform:
      return Transform::createLinearTransform(0.25);
    case VdbPlacement::scale: {
      auto t = Transform::createLinearTransform();
      t->preScale(Vec3d(0.5, 0.25, 2));
      return t;
    }
    case VdbPlacement::translate: {
      auto t = Transform::createLinearTransform(0.25);
      t->postTranslate(Vec3d(3, -4, 5));
      return t;
    }
    case VdbPlacement::affine: {
      auto t = Transform::createLinearTransform(0.5);
      t->postRotate(0.4, openvdb::math::Y_AXIS);
      t->postScale(Vec3d(1, 2, 3));
      t->postTranslate(Vec3d(-1, 7, 2));
      return t;
    }
    case VdbPlacement::frustum:
      return Transform::createFrustumTransform(openvdb::BBoxd(Vec3d(0, 0, 0), Vec3d(50, 50, 50)), 0.5, 10);
  }
  return nullptr;
}

FloatGrid::Ptr make_grid(const VdbOptions& options) {
  auto grid = FloatGrid::create(0);
  grid->setName("density");
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setTransform(make_placement(options.placement));
  auto values = grid->getAccessor();
  for (int x = -5; x < 21; ++x) {
    for (int y = 3; y < 14; ++y) {
      for (int z = -30; z < 10; ++z) {
        const float value = test_value(x, y, z);
        if ((x + y + z) % 5 != 0) values.setValue({x, y, z}, options.change ? options.change(x, y, z, value) : value);
      }
    }
  }
  values.setValueOff({4, 5, 6}, 0.75f);  // stored though not active
  for (int i = 0; i < 8; ++i) values.setValueOff({20, 13, 8 + i}, 0.25f);
  if (options.tiles) grid->tree().addTile(1, {32, 8, -16}, 2.5f, true);
  if (options.tiles) grid->tree().addTile(1, {40, 8, -16}, 1.5f, false);
  for (int i = 0; i < 8; ++i) values.setValueOff({-16, 8, -16 + i}, 0);  // a leaf with no active voxel
  grid->setSaveFloatAsHalf(options.half);
  return grid;
}

void write_grids(const std::string& path, const openvdb::GridPtrVec& grids, const VdbOptions& options = {}) {
  openvdb::io::File file(path);
  std::uint32_t compression = options.active_mask ? openvdb::io::COMPRESS_ACTIVE_MASK : openvdb::io::COMPRESS_NONE;
  if (options.packing == VdbPacking::zip) compression |= openvdb::io::COMPRESS_ZIP;
  if (options.packing == VdbPacking::blosc) compression |= openvdb::io::COMPRESS_BLOSC;
  file.setCompression(compression);
  file.setGridStatsMetadataEnabled(options.statistics);
  file.write(grids);
  file.close();
}

// On one thread: ThreadSanitizer does not see through the library's, which are oneTBB's.
void initialize() {
  static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  static const bool done = (openvdb::initialize(), true);
  static_cast<void>(done);
}

Transform to_transform(const openvdb::math::Transform& from) {
  Transform t;
  const openvdb::Vec3d origin = from.indexToWorld(openvdb::Vec3d(0, 0, 0));
  for (int axis = 0; axis < 3; ++axis) {
    openvdb::Vec3d unit(0, 0, 0);
    unit[axis] = 1;
    const openvdb::Vec3d image = from.indexToWorld(unit) - origin;
    for (int row = 0; row < 3; ++row) {
      t.m[static_cast<std::size_t>(row)][static_cast<std::size_t>(axis)] = image[row];
      t.m[static_cast<std::size_t>(row)][3] = origin[row];
    }
  }
  return t;
}

template <class ValueAt>
std::vector<float> dense_values(const DenseGrid& grid, const ValueAt& value_at) {
  std::vector<float> values;
  for (int z = grid.lo[2]; z <= grid.hi[2]; ++z) {
    for (int y = grid.lo[1]; y <= grid.hi[1]; ++y) {
      for (int x = grid.lo[0]; x <= grid.hi[0]; ++x) values.push_back(value_at(x, y, z));
    }
  }
  return values;
}

template <class BuildT>
nanovdb::GridHandle<nanovdb::HostBuffer> to_nanovdb(const FloatGrid& grid) {
  return nanovdb::openToNanoVDB<nanovdb::HostBuffer, openvdb::FloatTree, BuildT>(grid);
}

template <class BuildT>
DenseGrid dense_of(const std::string& path) {
  const auto handle = nanovdb::io::readGrid(path);
  const auto* grid = handle.template grid<BuildT>();
  if (grid == nullptr) throw std::runtime_error("the grid has another type than expected");
  DenseGrid dense;
  const auto box = grid->indexBBox();
  for (int axis = 0; axis < 3; ++axis) {
    dense.lo[static_cast<std::size_t>(axis)] = box.min()[axis];
    dense.hi[static_cast<std::size_t>(axis)] = box.max()[axis];
  }
  dense.active_voxels = static_cast<std::int64_t>(grid->activeVoxelCount());
  dense.values =
      dense_values(dense, [&](int x, int y, int z) { return grid->tree().getValue(nanovdb::Coord(x, y, z)); });
  return dense;
}

nanovdb::io::Codec codec(VdbPacking packing) {
  return packing == VdbPacking::none  ? nanovdb::io::Codec::NONE
         : packing == VdbPacking::zip ? nanovdb::io::Codec::ZIP
                                      : nanovdb::io::Codec::BLOSC;
}

openvdb::GridPtrVec mixed_grids(bool with_density_level_set) {
  openvdb::GridPtrVec grids;
  if (with_density_level_set) {
    auto sphere = FloatGrid::create(1.5f);
    sphere->tree().setValue(Coord(0, 0, 0), -1);
    sphere->setGridClass(openvdb::GRID_LEVEL_SET);
    sphere->setName("density");
    grids.push_back(sphere);
  }
  auto flags = openvdb::Int32Grid::create(0);
  flags->setName("flags");
  flags->tree().setValue(Coord(1, 2, 3), 4);
  auto velocity = openvdb::Vec3SGrid::create();
  velocity->setName("v");
  velocity->setGridClass(openvdb::GRID_STAGGERED);
  velocity->tree().setValue(Coord(0, 0, 0), openvdb::Vec3s(1, 2, 3));
  auto heat = FloatGrid::create(0);
  heat->setName("heat");
  heat->setGridClass(openvdb::GRID_FOG_VOLUME);
  heat->tree().setValue(Coord(7, 7, 7), 6);
  grids.insert(grids.end(), {flags, velocity, heat});
  return grids;
}

}  // namespace

std::string temporary_file(const std::string& name) {
  struct Removed {
    std::set<std::string> paths;
    ~Removed() {
      for (const std::string& path : paths) std::remove(path.c_str());
    }
  };
  static Removed removed;
  return *removed.paths.insert(testing::TempDir() + "brume_volume_" + std::to_string(getpid()) + "_" + name).first;
}

std::string read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void write_vdb(const std::string& path, const VdbOptions& options) {
  initialize();
  write_grids(path, {make_grid(options)}, options);
}

void write_vdb_names(const std::string& path, const std::vector<std::string>& names, bool share_trees) {
  initialize();
  openvdb::GridPtrVec grids;
  for (const std::string& name : names) {
    auto grid = FloatGrid::create(0);
    grid->setName(name);
    const float value = static_cast<float>(grids.size() + 1);
    if (share_trees && !grids.empty()) {
      grid = openvdb::gridPtrCast<FloatGrid>(grids[0])->copy();  // the tree is shared, not copied
      grid->setName(name);
      grid->setTransform(openvdb::math::Transform::createLinearTransform(static_cast<double>(value)));
    } else {
      grid->tree().fill(openvdb::CoordBBox(Coord(0, 0, 0), Coord(9, 3, 2)), value);
      grid->tree().voxelizeActiveTiles();
    }
    grids.push_back(grid);
  }
  write_grids(path, grids);
}

void write_vdb_mixed(const std::string& path, bool with_density_level_set) {
  initialize();
  write_grids(path, mixed_grids(with_density_level_set));
}

void write_vdb_background(const std::string& path) {
  initialize();
  auto grid = FloatGrid::create(0.5f);
  grid->setName("density");
  grid->tree().setValue(Coord(1, 2, 3), 4);
  write_grids(path, {grid});
}

void write_vdb_empty(const std::string& path) {
  initialize();
  auto grid = FloatGrid::create(0);
  grid->setName("density");
  write_grids(path, {grid});
}

void write_vdb_far_apart(const std::string& path) {
  initialize();
  auto grid = FloatGrid::create(0);
  grid->setName("density");
  grid->tree().setValue(Coord(-1000000, -1000000, -1000000), 1);
  grid->tree().setValue(Coord(1000000, 1000000, 1000000), 1);
  write_grids(path, {grid});
}

std::string vdb_kind(const std::string& path, const std::string& name) {
  initialize();
  openvdb::io::File file(path);
  file.open(false);
  const openvdb::GridBase::Ptr grid = file.readGrid(name);
  return openvdb::GridBase::gridClassToString(grid->getGridClass()) + (grid->saveFloatAsHalf() ? " half" : " float");
}

DenseGrid read_back_vdb(const std::string& path, const std::string& name) {
  initialize();
  openvdb::io::File file(path);
  file.open(false);
  const auto grid = openvdb::gridPtrCast<FloatGrid>(file.readGrid(name));
  const openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
  DenseGrid dense;
  for (int axis = 0; axis < 3; ++axis) {
    dense.lo[static_cast<std::size_t>(axis)] = box.min()[axis];
    dense.hi[static_cast<std::size_t>(axis)] = box.max()[axis];
  }
  dense.active_voxels = static_cast<std::int64_t>(grid->activeVoxelCount());
  dense.world_from_lattice = to_transform(grid->transform());
  dense.values = dense_values(dense, [&](int x, int y, int z) { return grid->tree().getValue(Coord(x, y, z)); });
  return dense;
}

void write_nvdb(const std::string& path, const VdbOptions& options, NvdbValues values) {
  initialize();
  const FloatGrid::Ptr grid = make_grid(options);
  const auto write = [&](const auto& handle) { nanovdb::io::writeGrid(path, handle, codec(options.packing)); };
  switch (values) {
    case NvdbValues::float32:
      return write(to_nanovdb<float>(*grid));
    case NvdbValues::fp4:
      return write(to_nanovdb<nanovdb::Fp4>(*grid));
    case NvdbValues::fp8:
      return write(to_nanovdb<nanovdb::Fp8>(*grid));
    case NvdbValues::fp16:
      return write(to_nanovdb<nanovdb::Fp16>(*grid));
    case NvdbValues::fpn:
      return write(to_nanovdb<nanovdb::FpN>(*grid));
  }
}

void write_nvdb_mixed(const std::string& path) {
  initialize();
  const openvdb::GridPtrVec grids = mixed_grids(false);
  std::vector<nanovdb::GridHandle<nanovdb::HostBuffer>> handles;
  handles.push_back(nanovdb::openToNanoVDB(*openvdb::gridPtrCast<openvdb::Int32Grid>(grids[0])));
  handles.push_back(nanovdb::openToNanoVDB(*openvdb::gridPtrCast<openvdb::Vec3SGrid>(grids[1])));
  handles.push_back(nanovdb::openToNanoVDB(*openvdb::gridPtrCast<FloatGrid>(grids[2])));
  nanovdb::io::writeGrids<nanovdb::HostBuffer, std::vector>(path, handles, nanovdb::io::Codec::ZIP);
}

DenseGrid read_back_nvdb(const std::string& path, NvdbValues values) {
  DenseGrid dense = values == NvdbValues::float32 ? dense_of<float>(path)
                    : values == NvdbValues::fp4   ? dense_of<nanovdb::Fp4>(path)
                    : values == NvdbValues::fp8   ? dense_of<nanovdb::Fp8>(path)
                    : values == NvdbValues::fp16  ? dense_of<nanovdb::Fp16>(path)
                                                  : dense_of<nanovdb::FpN>(path);
  VdbOptions options;
  dense.world_from_lattice = to_transform(*make_placement(options.placement));
  return dense;
}

}  // namespace brume

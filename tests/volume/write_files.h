// Volume files for the tests, written by the OpenVDB and NanoVDB libraries, and what those libraries read back from
// them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/geometry.h"

namespace brume {

enum class VdbPacking { none, zip, blosc };
enum class VdbPlacement { uniform, scale, translate, affine, frustum };
enum class NvdbValues { float32, fp4, fp8, fp16, fpn };

// What the tests' grids hold: values that differ along each axis, in leaves and tiles, placed by an affine map.
struct VdbOptions {
  VdbPacking packing = VdbPacking::blosc;
  bool active_mask = true;  // leave inactive values out of the file
  bool half = false;
  bool statistics = true;  // bounds and counts in the metadata
  VdbPlacement placement = VdbPlacement::affine;
  bool tiles = true;
  // Changes a value: of the voxel (x, y, z) of the lattice.
  std::function<float(int x, int y, int z, float value)> change;
};

// A grid as its own library reads it: the box of its active voxels, values in it with x fastest, and some places.
struct DenseGrid {
  std::array<int, 3> lo{}, hi{};
  std::vector<float> values;
  Transform world_from_lattice;
  std::int64_t active_voxels = 0;
};

// A name in the folder for temporary files; what is there is removed when the program ends.
std::string temporary_file(const std::string& name);
std::string read_bytes(const std::string& path);
void write_bytes(const std::string& path, const std::string& bytes);

void write_vdb(const std::string& path, const VdbOptions& options);
// Grids named by `names`, all float, told apart by their values: i + 1 throughout grid i.
void write_vdb_names(const std::string& path, const std::vector<std::string>& names, bool share_trees = false);
// "density", a level set; "flags", integers; "v", vectors; "heat", a fog volume.
void write_vdb_mixed(const std::string& path, bool with_density_level_set);
void write_vdb_background(const std::string& path);
void write_vdb_empty(const std::string& path);
void write_vdb_far_apart(const std::string& path);
DenseGrid read_back_vdb(const std::string& path, const std::string& name = "density");
// "fog volume float", "fog volume half": class and type of a grid, as OpenVDB has them.
std::string vdb_kind(const std::string& path, const std::string& name);

void write_nvdb(const std::string& path, const VdbOptions& options, NvdbValues values);
void write_nvdb_mixed(const std::string& path);
DenseGrid read_back_nvdb(const std::string& path, NvdbValues values);

}  // namespace brume

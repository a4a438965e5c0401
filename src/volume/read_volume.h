// Volume files: .vdb (OpenVDB), .nvdb (NanoVDB) and .vol (Mitsuba).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "volume/volume_grid.h"

namespace brume {

// One grid of a file as its header tells of it, without its voxels.
struct GridInfo {
  std::string name;
  std::string type;             // "float", "half", "vec3s", ...: the format's own word
  std::string grid_class;       // "fog volume", "level set", "staggered", "dense grid", "unknown"
  std::array<int, 3> voxels{};  // active bounding box
  std::array<std::int64_t, 3> first_voxel{};
  std::int64_t active_voxels = 0;
  Vector3 voxel_size;
  Box3 bounds;              // in the file's world space
  bool renderable = false;  // a grid of one value a voxel that can be a density
  std::string note;         // why it is not renderable, or what else to know, or ""
};

// The suffixes that list_grids and read_volume know, ready to be shown.
constexpr const char* volume_suffixes = ".vdb, .nvdb or .vol";

// There is no such grid in the file, or it cannot be rendered: the file itself is as it should be.
class GridError : public InputError {
 public:
  using InputError::InputError;
};

// Whether the file's suffix is one of them.
bool is_volume_file(const std::string& path);

// The grids of a file. Throws InputError that names the file and what is wrong with it.
std::vector<GridInfo> list_grids(const std::string& path);

// Reads one grid. `name` empty chooses by this rule: "density"; else the only renderable grid there is; else a
// GridError that lists the grids. Level sets, vector grids and others that are no density are refused with a hint, by a
// GridError too; densities that are not finite or negative are refused, or taken as 0 with a warning in the result,
// with their count and the place of the first. The density is the
// value stored for a voxel, marked active or not, as OpenVDB's and NanoVDB's own samplers take it, and 0 outside the
// box of the active voxels (of all voxels in a .vol). Throws InputError.
VolumeGrid read_volume(const std::string& path, const std::string& name, GridReading reading);
// The grid that list_grids has at `index`.
VolumeGrid read_volume(const std::string& path, std::size_t index, GridReading reading);

// The grid of that name, if there is one that can be rendered.
std::optional<VolumeGrid> find_volume(const std::string& path, const std::string& name, GridReading reading);

}  // namespace brume

// A scalar grid placed in its medium's space, as every reader and procedural returns it.
#pragma once

#include <string>

#include "base/geometry.h"
#include "volume/brick_grid.h"

namespace brume {

// What a point outside the array sees as the value fades (see media.md's "Support of a grid" in docs/architecture.md).
enum class Support {
  cut,   // ends at the array's box: uniformgrid and .vol
  fade,  // linear interpolation fades to 0 over half a voxel beyond the outermost values' voxels: .vdb and .nvdb
};

// What becomes of values that no density can have: negative ones and those that are not finite.
enum class BadValues { rejected, taken_as_0 };

// How the values of a file's grid are read.
struct GridReading {
  GridReading(Storage kept_as, BadValues bad = BadValues::rejected) : storage(kept_as), bad_values(bad) {}
  Storage storage;
  BadValues bad_values;
};

struct VolumeGrid {
  std::string name;
  std::string warning;  // about values that were taken as 0, or ""
  BrickGrid bricks;
  // Index coordinates (voxel (i, j, k) is the cube from (i, j, k) to (i+1, j+1, k+1), its value at the centre) to the
  // space of the medium.
  Transform medium_from_index;
  Support support = Support::fade;
  // The first voxel of the data's box, which ends with the array: files are read with the array's origin moved down to
  // a multiple of 8 so that their leaves are our bricks, and the voxels before this one are that alignment's zeros.
  std::array<int, 3> first_voxel{};
};

// The box in index coordinates outside of which the density is 0: the data's box, and for linear interpolation with
// fading support half a voxel more on every side.
Box3 support_index(const VolumeGrid& grid, bool linear);

// The edge lengths of a voxel in medium space.
Vector3 voxel_size(const VolumeGrid& grid);

}  // namespace brume

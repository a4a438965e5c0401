// Writes volumes as OpenVDB files.
#pragma once

#include <span>
#include <string>

#include "volume/volume_grid.h"

namespace brume {

// The bytes of a .vdb file (version 224, packed with ZIP) that holds float grids, as fog volumes under their names.
// Voxel (i, j, k) of a grid is at the file's lattice coordinates (i, j, k); those whose value is not 0 are active. With
// `half`, values are rounded to 16-bit floats. The same grids give the same bytes. `creator` is the program's name, for
// the file's metadata. Throws std::invalid_argument unless the grids are held as floats (Storage::f32).
std::string encode_vdb(std::span<const VolumeGrid> grids, bool half, const std::string& creator);

}  // namespace brume

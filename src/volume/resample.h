// A grid's values at the voxels of another.
#pragma once

#include "volume/volume_grid.h"

namespace brume {

// The grid's box cut into `voxels`, with the values that linear interpolation has at their centres; the same values
// where the numbers of voxels are the grid's own. The same for any number of threads.
VolumeGrid resample(const VolumeGrid& grid, std::array<int, 3> voxels, Storage storage, int threads);

}  // namespace brume

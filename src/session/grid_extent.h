// Where in a grid its matter is, found brick by brick so that empty space costs nothing.
#pragma once

#include <vector>

#include "volume/volume_grid.h"

namespace brume {

// The parts of the grid, in index coordinates, where the density is above a thousandth of the greatest: for each brick
// that holds such voxels, the box around them.
std::vector<Box3> occupied_boxes(const VolumeGrid& grid);

// The smallest density of the data's box, as it is stored.
float smallest_density(const VolumeGrid& grid);

// The greatest sum of densities over the voxels of a row along `axis`.
double densest_row(const VolumeGrid& grid, int axis);

}  // namespace brume

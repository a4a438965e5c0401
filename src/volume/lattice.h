// The voxels of a procedural volume, and how they are filled.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "volume/noise.h"
#include "volume/volume_grid.h"

namespace brume {

// Cubic voxels that fill a box about the origin of the medium's space.
struct Lattice {
  std::array<int, 3> voxels;
  float voxel;  // edge

  // `size` voxels along the longest side of the box +-half, rounded up along the others; the longest side is 2.
  Lattice(std::array<double, 3> half, int size);

  // The place of index coordinates.
  NoisePoint place(float x, float y, float z) const {
    const auto along = [&](float index, std::size_t axis) {
      return (index - 0.5f * static_cast<float>(voxels[axis])) * voxel;
    };
    return {along(x, 0), along(y, 1), along(z, 2)};
  }
};

// Fills in the 512 values of a brick, x fastest; false where all are 0.
using FillBrick = std::function<bool(std::array<int, 3> brick, std::array<float, brick_voxels>& values)>;

// A grid called `name`, from what `fill` does, called for each brick, on `threads` workers (0: one a core).
VolumeGrid fill_bricks(const std::string& name, const Lattice& lattice, Storage storage, int threads,
                       const FillBrick& fill);

// The same by the values at the middles of voxels.
VolumeGrid fill_voxels(const std::string& name, const Lattice& lattice, Storage storage, int threads,
                       const std::function<float(NoisePoint)>& value);

}  // namespace brume

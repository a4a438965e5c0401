// Procedural volumes.
#pragma once

#include <cstdint>

#include "volume/volume_grid.h"

namespace brume {

// A cumulus cloud, flat below and billowing above, in a grid of `size` voxels along its longest side, centred in the
// box
// [-1, 1] x [-0.6, 0.6] x [-1, 1] of medium space; densities in [0, 1].
constexpr int max_cloud_size = 2048;
struct CloudParameters {
  int size = 128;  // 1 to max_cloud_size
  std::uint32_t seed = 0;
  Storage storage = Storage::u16;
};
// The same for any number of threads (0: one a core). Throws std::invalid_argument for a size out of range.
VolumeGrid procedural_cloud(const CloudParameters& parameters, int threads);

// A ball of noise in the box [-1, 1]^3 of medium space, in size^3 voxels, a tenth of which hold something; densities in
// [0, 1]. Keeps all values as floats while it is made. The same for any number of threads (0: one a core).
VolumeGrid noise_ball(int size, Storage storage, int threads);

// Puffs here and there in the box [-1, 1]^3 of medium space, in size^3 voxels of which about a tenth are in bricks that
// are not empty; densities in [0, 1]. Quick to make.
VolumeGrid scattered_puffs(int size, Storage storage);

}  // namespace brume

// Procedural volumes: clouds, smoke, fog and fire (base/procedural.h has their parameters), and what tests and
// benchmarks are made of. All are centred on the origin of the medium's space and are the same for any number of
// threads (0: one a core).
#pragma once

#include <cstdint>
#include <vector>

#include "base/procedural.h"
#include "volume/volume_grid.h"

namespace brume {

// The density of a procedural volume, in [0, 1]. Throws std::invalid_argument for a size below 1 or above
// max_procedural_size.
VolumeGrid procedural_density(const Procedural& procedural, Storage storage, int threads);

// Its temperatures in kelvin, 0 where nothing is hot; only of kinds that have them.
VolumeGrid procedural_temperature(const Procedural& procedural, Storage storage, int threads);

// All of its grids: "density" and, where the kind has it, "temperature", in kelvin and 0 where nothing is hot.
std::vector<VolumeGrid> procedural_grids(const Procedural& procedural, Storage storage, int threads);

// The kinds. In each, `size` voxels go along the longest side of the box.
VolumeGrid make_cloud(const Procedural& procedural, Storage storage, int threads);  // box +-(1, 0.6, 1)
VolumeGrid make_smoke(const Procedural& procedural, Storage storage, int threads);  // box +-(0.5, 1, 0.5)
VolumeGrid make_fog(const Procedural& procedural, Storage storage, int threads);    // box +-(1, 0.2, 1)
VolumeGrid make_fire(const Procedural& procedural, Storage storage, int threads);   // box +-(0.5, 1, 0.5)
VolumeGrid make_fire_temperature(const Procedural& procedural, Storage storage, int threads);

// pbrt's noise cloud, in voxels that fill its box exactly.
VolumeGrid make_noise_cloud(const NoiseCloud& cloud, Storage storage, int threads);

// A ball of noise in the box [-1, 1]^3 of medium space, in size^3 voxels, a tenth of which hold something; densities in
// [0, 1]. Keeps all values as floats while it is made.
VolumeGrid noise_ball(int size, Storage storage, int threads);

// Puffs here and there in the box [-1, 1]^3 of medium space, in size^3 voxels of which about a tenth are in bricks that
// are not empty; densities in [0, 1]. Quick to make.
VolumeGrid scattered_puffs(int size, Storage storage);

}  // namespace brume

// A grid's density at points of a ray, and its integral along stretches of rays, in SIMD lanes: what optical depths are
// made of.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiled/compiled_scene.h"

namespace brume {

// Stretches of rays through one grid, as structure of arrays. Stretch i is entry + t direction in index coordinates for
// t in [0, length], t in world units, all within the grid's bounds.
struct DensityStretches {
  std::vector<float> entry_x, entry_y, entry_z, direction_x, direction_y, direction_z, length;
  std::vector<std::uint32_t> random_key;  // the stream of the stretch's own random numbers
  std::size_t size() const { return length.size(); }
  void clear();
  void add(kernel::vec3 entry_index, kernel::vec3 direction_index, float length_world, std::uint32_t key);
};

// How to integrate.
struct DensityQuadrature {
  bool linear = true;  // interpolation
  // By DDA, exactly: over voxels for nearest interpolation, over dual cells for linear (kernel/dda.inl). Else by
  // marching in equal steps no longer than `step` (world units), with the point of each step at base + spread u of it.
  bool dda = false;
  float step = 0, placement_base = 0.5f, placement_spread = 0;
  // Stretches whose integral exceeds this need not be followed to their end.
  float enough = 0;
};

// integral[i] = the integral of the density over stretch i, in world units. The bits of a result depend on its stretch
// and on the instruction set, not on the other stretches. `stretches` and `integral` are padded to whole vectors of
// lanes.
void integrate_density(const kernel::BrickGrid& grid, const DensityQuadrature& quadrature, DensityStretches& stretches,
                       std::vector<float>& integral);

// density[i] = the density at entry + (t[i] - t_entry) direction (index coordinates, within the grid's bounds).
void sample_density(const kernel::BrickGrid& grid, bool linear, kernel::vec3 entry_index, kernel::vec3 direction_index,
                    float t_entry, std::span<const float> t, std::span<float> density);

}  // namespace brume

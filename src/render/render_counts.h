// What a render did, counted: for the user to see where time goes, and for the report of faults.
#pragma once

#include <cstdint>

namespace brume {

struct RenderCounts {
  std::int64_t rays = 0;          // from the camera, and from each scattering and reflection on
  std::int64_t shadow_rays = 0;   // towards lights
  std::int64_t collisions = 0;    // of rays with media; marching rays have none
  std::int64_t surface_hits = 0;  // of rays
  std::int64_t cells = 0;         // of majorants, entered by tracking
  std::int64_t look_ups = 0;      // of the density of a grid; of classic, those along shadow rays are not counted
  std::int64_t majorant_violations = 0;  // densities above their majorant: a fault of ours, and a bias

  RenderCounts& operator+=(const RenderCounts& other) {
    rays += other.rays;
    shadow_rays += other.shadow_rays;
    collisions += other.collisions;
    surface_hits += other.surface_hits;
    cells += other.cells;
    look_ups += other.look_ups;
    majorant_violations += other.majorant_violations;
    return *this;
  }
};

}  // namespace brume

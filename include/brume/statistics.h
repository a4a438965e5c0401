// What a render took and did.
#pragma once

#include <cstdint>
#include <string>

namespace brume {

struct Statistics {
  std::string software, instruction_set, integrator;  // "Brume 0.1.0", "AVX-512", "volpath"
  int threads = 0;
  double reading_seconds = 0;    // the scene, or the volume that was framed
  double preparing_seconds = 0;  // volume files and meshes read, what rays need built
  double rendering_seconds = 0;
  std::int64_t samples = 0;         // of all pixels together
  std::int64_t rays = 0;            // from the camera, and from each scattering and reflection on
  std::int64_t shadow_rays = 0;     // towards lights
  std::int64_t collisions = 0;      // of rays with media; classic, which marches, has none
  std::int64_t surface_hits = 0;    // of rays
  std::int64_t majorant_cells = 0;  // entered by tracking through grids
  std::int64_t look_ups = 0;        // of the density of grids; of classic those along shadow rays are not counted
  // Densities above the bound that tracking relies on: a fault of Brume where it is not 0.
  std::int64_t majorant_violations = 0;
  std::int64_t invalid_samples = 0;  // not finite, and left out
  std::int64_t volume_bytes = 0;     // of the grids in memory
  std::int64_t peak_bytes = 0;       // the most memory that this process has had

  // A table to be read, of the lines that are not 0.
  std::string table() const;
  // Writes all of it to a file, whole or not at all, as one JSON object whose members are named as above. Throws Error.
  void write(const std::string& path) const;
  // Throws Error unless write(path) can be expected to work.
  static void check_output(const std::string& path);
};

}  // namespace brume

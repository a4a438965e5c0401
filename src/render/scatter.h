// Collisions with one medium: light that reaches them, and where paths go on. In SIMD lanes over all paths.
#pragma once

#include "render/aim.h"
#include "render/light_table.h"
#include "render/paths.h"

namespace brume {

// A collision that chose a light of another kind.
struct LightRequest {
  std::uint32_t path;
  float u;                          // the number that chose
  float position[3], direction[3];  // of the collision, and of the path that came there
  float value[3];                   // what radiance there is worth, before the phase function
};

struct ScatterJob {
  const DeltaLight* lights = nullptr;
  int light_count = 0;
  float pick_end = 0;               // numbers from here on choose no light
  float picks_of_delta_lights = 0;  // numbers from here on choose lights of other kinds
  int max_depth = 0;
  int last_depth = 0;  // paths that have been scattered more often than this meet no light any more
  std::uint32_t seed = 0;
  bool is_chromatic = false;
  float density_scale = 1;  // of the density of new directions
  // Lights that paths are aimed at, and what is seen elsewhere (aim.h).
  const AimedLight* aimed_lights = nullptr;
  int aimed_light_count = 0;
  float elsewhere = 0;
  // Nearer to a point light than the root of this its light is placed along flights.
  float near_squared = 0;
  // The medium.
  std::int32_t medium = 0;
  int phase = 0;
  float phase_numbers[4] = {};
  float sigma_t[3] = {}, sigma_s[3] = {}, emission[3] = {};  // of a grid: at density 1
  const TrackedGrid* grid = nullptr;                         // none: homogeneous
  kernel::EmissionField emission_field{};                    // of a grid that emits,
  float emission_thin = 0;                                   // and how much of it is gathered along flights
};

// Moves the paths that collided with the job's medium to their collisions, adds what is emitted there, sends shadow
// rays (appended, `shadow_count` of them so far; there is room for one a path) or leaves requests, and gives the paths
// new directions, or ends them: t_max = 0. Returns the number of requests.
std::uint32_t scatter_paths(const ScatterJob& job, const PathColumns& paths, std::uint32_t count,
                            const ShadowColumns& shadows, std::uint32_t& shadow_count, LightRequest* requests);

}  // namespace brume

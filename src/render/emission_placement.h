// What thin media with grids emit, gathered all along flights.
//
// A flame may be so thin that few flights collide in it, and its light comes from few places. So where free paths are
// long, emission is not seen where a flight happens to collide (emission_along_flights in kernel/emission.inl says how
// much of it): of each stretch of a flight through the medium one place is chosen, with a density
// that follows what the cells on the way emit, about, and the light from there is worth sigma_a Le T over that density.
// T, the transmittance on the way, is ratio tracking's. Cells that lie deep are chosen less, as (1 + tau)^-2, where tau
// is the optical depth of the majorants up to them: no estimate is worth more than (1 + tau)^2 T of a mean one. No
// bias.
#pragma once

#include "render/paths.h"

namespace brume {

struct EmissionJob {
  std::int32_t medium = 0;
  const TrackedGrid* grid = nullptr;
  const std::uint32_t* cells = nullptr;  // as CompiledEmissionFactor has them
  kernel::EmissionField field{};
  float thin = 0;          // and how long a free path is where half of the emission is gathered along flights
  float emission[3] = {};  // at density 1 and factor 1
  bool is_chromatic = false;
};

// For stretches [first, last) of flights through the job's medium: appends to the shadow rays (`shadow_count` of them
// so far; there is room for one a stretch) what is emitted on the way, as leads without a ray beyond them.
void place_emission(const EmissionJob& job, const PathColumns& paths, const TrackColumns& stretches,
                    std::uint32_t first, std::uint32_t last, const ShadowColumns& shadows, std::uint32_t& shadow_count);

}  // namespace brume

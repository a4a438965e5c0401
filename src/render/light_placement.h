// Light from point lights, gathered at places of their own along flights: not where paths happen to collide, but where
// the light is strong. Through homogeneous media all of it is, in grids that of lights nearer than a free path; the
// rest is gathered at collisions. Where a light shines in a cone, only what lies in it counts.
//
// A place is drawn from a mixture of the equiangular density, in proportion to 1 / r^2, and the density of free flight,
// so that neither a near light nor a thick medium makes outliers. A grid's density is looked up there.
// Source: C. Kulla and M. Fajardo, "Importance Sampling Techniques for Path Tracing in Participating Media", CGF 31(4),
// 2012.
#pragma once

#include "render/paths.h"
#include "render/scatter.h"

namespace brume {

// For each stretch [first, last) of a path through the job's medium, whose lights are all points: appends a shadow ray
// from a place along it near a light, with the way there as its lead. There must be room for one a stretch.
void place_lights(const ScatterJob& job, const PathColumns& paths, const TrackColumns& stretches, std::uint32_t first,
                  std::uint32_t last, const ShadowColumns& shadows, std::uint32_t& shadow_count);

}  // namespace brume

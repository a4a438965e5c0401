// Emitting shapes: points and directions on them.
#pragma once

#include "compiled/compiled_scene.h"
#include "intersect/intersector.h"
#include "render/random_stream.h"

namespace brume {

// A point of an area light as seen from elsewhere, with the unit normal that the light's front has there.
struct LightPoint {
  kernel::vec3 position, normal;
  float pdf = 0;              // of the direction to it, per steradian
  std::array<float, 2> uv{};  // the place on a light that is textured (see intersect/surface_uv.h)
  float tilted_length = 0;    // of the triangle that it is on (see intersect/intersector.h)
};

// From p. Spheres without holes: uniform over the cone of directions in which they are seen (of the unit sphere, before
// the affine map), pdf 0 where a part of a sphere is not met there. Saddles: uniform over the unit square. Others:
// uniform over the area (before the affine map).
LightPoint sample_area_light(const CompiledScene& scene, const CompiledLight& light, kernel::vec3 p,
                             RandomStream::Pair numbers);

// The density of a direction from the ray's origin whose ray meets the light at `hit`.
float area_light_pdf(const CompiledScene& scene, const CompiledLight& light, const Ray& ray, const SurfaceHit& hit);

}  // namespace brume

// Lights as points of media and of surfaces see them.
#pragma once

#include "compiled/compiled_scene.h"
#include "intersect/intersector.h"
#include "render/random_stream.h"

namespace brume {

// A light drawn in proportion to (about) the power that it sends into the scene.
struct LightChoice {
  int index = -1;  // below 0: there is no light
  float chance = 0;
};
LightChoice choose_light(const CompiledScene& scene, float u);

// One direction towards a light. `value` is radiance times solid angle, that is the light's radiance over the density
// `pdf` with which the direction was chosen. Where no ray can find the light's radiance by itself, the pdf is 0: so for
// area lights that are not seen, and for point and distant lights, which have one direction and their irradiance of a
// facing surface. The ray ends short of the light's own surface.
struct LightSample {
  Ray ray;
  Spectrum value;
  float pdf = 0;  // per steradian
};

// From a point p: in a medium, where `normal` is null, else on a surface whose unit normal on the lit side it is.
// Directions of a constant infinite light are uniform in a medium and in proportion to their cosine on a surface.
// The ray starts at p; from a surface, whoever follows it starts a little off (leave_surface, started_at).
LightSample sample_light(const CompiledScene& scene, const CompiledLight& light, kernel::vec3 p,
                         const kernel::vec3* normal, RandomStream::Pair numbers);
// The same with a pair of random numbers, where the light takes any.
LightSample sample_light(const CompiledScene& scene, const CompiledLight& light, kernel::vec3 p,
                         const kernel::vec3* normal, RandomStream& random);

// Whether the light is seen in more than one direction from a point.
bool has_extent(const CompiledLight& light);

// The ray of a light sample on a surface, from `start` a little off the surface to the same end.
Ray started_at(kernel::vec3 start, const Ray& ray);

// The density with which sample_light, from the ray's origin, takes its direction. `hit` is where the ray meets the
// light's surface, as the intersector gives it, and unused for lights without one. 0 for point and distant lights.
float light_pdf(const CompiledScene& scene, const CompiledLight& light, const Ray& ray, const kernel::vec3* normal,
                const SurfaceHit& hit);

// The radiance that an infinite light, constant or image, sends against the ray; 0 for the others, and where the ray
// misses the light's portal.
Spectrum environment_radiance(const CompiledScene& scene, const CompiledLight& light, const Ray& ray);

// The radiance that the surface at `hit`, as the intersector gives it, sends against `direction`.
Spectrum emitted_radiance(const CompiledScene& scene, const SurfaceHit& hit, kernel::vec3 direction);

}  // namespace brume

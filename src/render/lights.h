// Lights as points of media and of surfaces see them.
#pragma once

#include "compiled/compiled_scene.h"
#include "intersect/intersector.h"
#include "render/random_stream.h"

namespace brume {

// One direction towards a light. `value` is radiance times solid angle, that is the light's radiance over the density
// with which the direction was chosen; point and distant lights have one direction and their irradiance of a facing
// surface.
struct LightSample {
  Ray ray;
  Spectrum value;
};

// From a point in a medium.
LightSample sample_light_from_point(const CompiledLight& light, kernel::vec3 p, RandomStream& random);

// From a surface whose unit normal on the lit side is n: directions of an infinite light are chosen in proportion to
// their cosine with n.
LightSample sample_light_from_surface(const CompiledLight& light, kernel::vec3 p, kernel::vec3 n, RandomStream& random);

}  // namespace brume

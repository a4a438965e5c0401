#include "render/lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brume {

using kernel::vec3;

namespace {

vec3 to_float(Vector3 v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

LightSample sample_point(const CompiledLight& light, vec3 p) {
  const vec3 to_light = to_float(light.position) - p;
  // A point at the light itself would see infinity.
  const float squared = std::max(dot(to_light, to_light), 1e-20f), distance = std::sqrt(squared);
  return {{p, (1 / distance) * to_light, distance}, (1 / squared) * light.value};
}

vec3 direction_around_z(float z, float turns) {
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  float sine = 0, cosine = 0;
  kernel::sincos_turns(turns, sine, cosine);
  return {r * cosine, r * sine, z};
}

// From coordinates about the z axis to coordinates about n.
// Source: T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
vec3 rotate_to(vec3 n, vec3 v) {
  const float sign = std::copysign(1.0f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  const vec3 x_axis(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), y_axis(b, sign + n.y * n.y * a, -n.y);
  return v.x * x_axis + v.y * y_axis + v.z * n;
}

}  // namespace

LightSample sample_light_from_point(const CompiledLight& light, vec3 p, RandomStream& random) {
  switch (light.kind) {
    case CompiledLight::Kind::point:
      return sample_point(light, p);
    case CompiledLight::Kind::distant:
      return {{p, to_float(light.direction_to), far_away}, light.value};
    case CompiledLight::Kind::infinite:
      break;
  }
  const float z = 1 - 2 * random.next(), turns = random.next();
  return {{p, direction_around_z(z, turns), far_away}, 4 * std::numbers::pi_v<float> * light.value};
}

LightSample sample_light_from_surface(const CompiledLight& light, vec3 p, vec3 n, RandomStream& random) {
  if (light.kind != CompiledLight::Kind::infinite) return sample_light_from_point(light, p, random);
  const float cosine = std::sqrt(1 - random.next()), turns = random.next();
  return {{p, rotate_to(n, direction_around_z(cosine, turns)), far_away},
          (std::numbers::pi_v<float> / cosine) * light.value};
}

}  // namespace brume

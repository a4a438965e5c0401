#include "render/lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/directions.h"

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
  const auto [u, turns] = random.next_pair();
  return {{p, direction_around_z(1 - 2 * u, turns), far_away}, 4 * std::numbers::pi_v<float> * light.value};
}

LightSample sample_light_from_surface(const CompiledLight& light, vec3 p, vec3 n, RandomStream& random) {
  if (light.kind != CompiledLight::Kind::infinite) return sample_light_from_point(light, p, random);
  const auto [u, turns] = random.next_pair();
  const float cosine = std::sqrt(1 - u);
  return {{p, rotate_to(n, direction_around_z(cosine, turns)), far_away},
          (std::numbers::pi_v<float> / cosine) * light.value};
}

}  // namespace brume

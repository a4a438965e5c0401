// Surfaces as integrators see them: reflection, and how rays leave them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiled/compiled_scene.h"
#include "intersect/intersector.h"

namespace brume {

// Turns a hit's normals to the side that the ray comes from.
inline SurfaceHit facing(SurfaceHit hit, kernel::vec3 direction) {
  if (dot(hit.normal, direction) <= 0) return hit;
  hit.normal = -hit.normal;
  hit.shading_normal = -hit.shading_normal;
  return hit;
}

// How far a ray starts from the surface that it leaves, against hitting it again: some tens of roundings of the hit's
// coordinates and of its distance.
inline kernel::vec3 leave_surface(kernel::vec3 p, kernel::vec3 n, float t) {
  const float extent = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), t});
  return p + (8e-6f * extent) * n;
}

inline float clamped_cosine(kernel::vec3 a, kernel::vec3 b) { return std::max(0.0f, dot(a, b)); }

// diffuse / pi + specular (s + 8) / (8 pi) (n.h)^s: the factor keeps the highlight's energy for every shininess.
// Source: T. Akenine-Möller et al., Real-Time Rendering, 3rd ed., eq. 7.48.
inline Spectrum blinn_phong(const CompiledMaterial& m, kernel::vec3 n, kernel::vec3 to_light, kernel::vec3 to_viewer) {
  Spectrum f = std::numbers::inv_pi_v<float> * m.diffuse;
  if (is_zero(m.specular)) return f;
  const kernel::vec3 sum = to_light + to_viewer;
  const float squared = dot(sum, sum);
  const float cosine = squared > 0 ? clamped_cosine(n, sum) / std::sqrt(squared) : 0;
  if (cosine > 0)
    f = f + (m.shininess + 8) / (8 * std::numbers::pi_v<float>)*kernel::pow_positive(cosine, m.shininess) * m.specular;
  return f;
}

// The direction of a mirror's reflection.
inline kernel::vec3 reflect(kernel::vec3 direction, kernel::vec3 normal) {
  return normalize(direction - (2 * dot(direction, normal)) * normal);
}

}  // namespace brume

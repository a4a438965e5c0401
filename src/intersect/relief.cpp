#include "intersect/relief.h"

#include <cmath>

namespace brume {

using kernel::vec3;

namespace {

// In u and v, to either side: together about a pixel of an image of 1024, so that finer detail is averaged, and wide
// enough that the rounding of values shows little.
constexpr double difference_step = 5e-4;

Vector3 to_double(vec3 v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }

// The change of the texture with u and v, along (du, dv).
double slope(const CompiledScene& scene, std::int32_t texture, const SurfacePlace& place, const Tangents& t, double du,
             double dv) {
  const auto value = [&](double step) {
    const SurfacePlace moved{{place.uv[0] + step * du, place.uv[1] + step * dv},
                             place.position + step * (du * t.u + dv * t.v)};
    return static_cast<double>(texture_value(scene, texture, moved)[0]);
  };
  return (value(difference_step) - value(-difference_step)) / (2 * difference_step);
}

Vector3 bumped(const CompiledScene& scene, std::int32_t texture, const SurfacePlace& place, const Tangents& t,
               Vector3 n, double area) {
  const double d_u = slope(scene, texture, place, t, 1, 0), d_v = slope(scene, texture, place, t, 0, 1);
  return n + 1 / area * (d_u * cross(n, t.v) + d_v * cross(t.u, n));
}

Vector3 mapped(const Spectrum& colour, const Tangents& t, Vector3 n, double area) {
  const auto part = [&](int channel) { return 2 * static_cast<double>(colour[channel]) - 1; };
  const Vector3 along_u = normalize(t.u - dot(n, t.u) * n);
  const Vector3 along_v = std::copysign(1.0, area) * cross(n, along_u);
  return part(0) * along_u + part(1) * along_v + part(2) * n;
}

}  // namespace

vec3 relief_normal(const CompiledScene& scene, const CompiledMaterial& material, const SurfaceHit& hit,
                   const Tangents& tangents) {
  const Vector3 n = to_double(hit.shading_normal);
  const double area = dot(n, cross(tangents.u, tangents.v));
  if (area == 0) return hit.shading_normal;
  const SurfacePlace place = place_of(hit);
  const Vector3 turned =
      normalize(material.normal_map >= 0 ? mapped(texture_value(scene, material.normal_map, place), tangents, n, area)
                                         : bumped(scene, material.displacement, place, tangents, n, area));
  if (!(dot(turned, to_double(hit.normal)) > 0)) return hit.shading_normal;
  return {static_cast<float>(turned.x), static_cast<float>(turned.y), static_cast<float>(turned.z)};
}

}  // namespace brume

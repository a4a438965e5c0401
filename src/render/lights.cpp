#include "render/lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/sphere_map.h"
#include "render/area_lights.h"
#include "render/portal.h"
#include "render/surfaces.h"

namespace brume {

using kernel::vec3;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

vec3 to_float(Vector3 v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
Vector3 to_double(vec3 v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }

LightSample sample_point(const CompiledLight& light, vec3 p) {
  const vec3 to_light = to_float(light.position) - p;
  // A point at the light itself would see infinity.
  const float squared = std::max(dot(to_light, to_light), 1e-20f), distance = std::sqrt(squared);
  const vec3 direction = (1 / distance) * to_light;
  const float falloff = kernel::cone_falloff(-dot(direction, light.cone.axis), light.cone.end, light.cone.start);
  return {{p, direction, distance}, (falloff / squared) * light.value, 0};
}

LightSample sample_constant(const CompiledLight& light, vec3 p, const vec3* normal, RandomStream::Pair numbers) {
  const auto [u, turns] = numbers;
  if (!normal) {
    const vec3 direction = kernel::direction_at_cosine({0, 0, 1}, 1 - 2 * u, turns);
    return {{p, direction, far_away}, 4 * pi * light.value, 0.25f / pi};
  }
  const float cosine = std::sqrt(1 - u);
  return {{p, kernel::direction_at_cosine(*normal, cosine, turns), far_away}, (pi / cosine) * light.value, cosine / pi};
}

// The last of the `count` steps of a cumulative table at which it does not exceed u; u becomes the share of that step
// that lies before it.
std::uint32_t draw(const float* cdf, std::uint32_t count, float& u) {
  const auto i = static_cast<std::uint32_t>(std::upper_bound(cdf + 1, cdf + count, u) - (cdf + 1));
  u = std::clamp((u - cdf[i]) / (cdf[i + 1] - cdf[i]), 0.0f, 1.0f);
  return i;
}

float pixel_density(const CompiledEnvironment& e, std::uint32_t column, std::uint32_t row) {
  const float* in_row = e.pixel_cdf.data() + static_cast<std::size_t>(row) * (e.width + 1);
  const float chance = (e.row_cdf[row + 1] - e.row_cdf[row]) * (in_row[column + 1] - in_row[column]);
  return chance / e.pixel_solid_angle[row];
}

Spectrum pixel(const CompiledEnvironment& e, std::uint32_t column, std::uint32_t row) {
  const float* rgb = e.pixels.data() + 3 * (static_cast<std::size_t>(row) * e.width + column);
  return {{rgb[0], rgb[1], rgb[2]}};
}

// A direction of the light's space in a pixel, at fractions of its width and, by solid angle, of its height.
Vector3 direction_in_pixel(const CompiledEnvironment& e, std::uint32_t column, std::uint32_t row, double right,
                           double down) {
  const double u = (column + right) / e.width;
  if (e.map == SphereMap::equal_area) return equal_area_direction({u, (row + down) / e.height});
  const double upper = std::cos(std::numbers::pi * row / e.height),
               lower = std::cos(std::numbers::pi * (row + 1) / e.height);
  const double z = upper + down * (lower - upper), ring = std::sqrt(std::max(0.0, 1 - z * z)),
               phi = 2 * std::numbers::pi * u;
  return {ring * std::cos(phi), ring * std::sin(phi), z};
}

void find_pixel(const CompiledEnvironment& e, vec3 direction, std::uint32_t& column, std::uint32_t& row) {
  const Vector3 d = normalize(e.light_from_world.vector(to_double(direction)));
  const SquarePoint p = map_point(e.map, d);
  column = std::min(static_cast<std::uint32_t>(p.u * e.width), e.width - 1);
  row = std::min(static_cast<std::uint32_t>(p.v * e.height), e.height - 1);
}

const CompiledEnvironment& environment_of(const CompiledScene& scene, const CompiledLight& light) {
  return scene.environments[static_cast<std::size_t>(light.environment)];
}

const CompiledPortal* portal_of(const CompiledScene& scene, const CompiledLight& light) {
  return light.portal < 0 ? nullptr : &scene.portals[static_cast<std::size_t>(light.portal)];
}

LightSample sample_image(const CompiledScene& scene, const CompiledLight& light, vec3 p, RandomStream::Pair numbers) {
  const CompiledEnvironment& e = environment_of(scene, light);
  auto [right, down] = numbers;
  const std::uint32_t row = draw(e.row_cdf.data(), e.height, down);
  const std::uint32_t column = draw(e.pixel_cdf.data() + static_cast<std::size_t>(row) * (e.width + 1), e.width, right);
  const Vector3 d = direction_in_pixel(e, column, row, static_cast<double>(right), static_cast<double>(down));
  const float pdf = pixel_density(e, column, row);
  if (!(pdf > 0)) return {{p, {0, 0, 1}, far_away}, {}, 0};  // a black image
  return {{p, to_float(normalize(e.world_from_light.vector(d))), far_away},
          (1 / pdf) * light.value * pixel(e, column, row),
          pdf};
}

float image_pdf(const CompiledScene& scene, const CompiledLight& light, vec3 direction) {
  std::uint32_t column = 0, row = 0;
  const CompiledEnvironment& e = environment_of(scene, light);
  find_pixel(e, direction, column, row);
  return pixel_density(e, column, row);
}

float portal_pdf(const CompiledScene& scene, const CompiledLight& light, const Ray& ray) {
  const CompiledPortal& portal = *portal_of(scene, light);
  const double solid_angle = PortalView(portal, ray.origin).solid_angle();
  if (!(solid_angle > 0 && passes(portal, ray))) return 0;
  return portal.image_share * image_pdf(scene, light, ray.direction) +
         (1 - portal.image_share) * static_cast<float>(1 / solid_angle);
}

// A share of the directions is drawn from the image's table, which knows where the image is bright, and lost where it
// misses the portal; the others are uniform in the portal's solid angle.
LightSample sample_through_portal(const CompiledScene& scene, const CompiledLight& light, vec3 p,
                                  RandomStream::Pair numbers) {
  const CompiledPortal& portal = *portal_of(scene, light);
  const PortalView view(portal, p);
  const LightSample nothing{{p, {0, 0, 1}, far_away}, {}, 0};
  if (!(view.solid_angle() > 0)) return nothing;
  const auto [u, v] = numbers;
  const float share = portal.image_share;
  const vec3 direction = u < share
                             ? sample_image(scene, light, p, {u / share, v}).ray.direction
                             : view.direction(static_cast<double>((u - share) / (1 - share)), static_cast<double>(v));
  const Ray ray{p, direction, far_away};
  const Spectrum radiance = environment_radiance(scene, light, ray);
  if (is_zero(radiance)) return nothing;
  const float pdf = portal_pdf(scene, light, ray);
  return {ray, (1 / pdf) * radiance, pdf};
}

// At a place on an area light, of its front or its back.
Spectrum radiance_at(const CompiledScene& scene, const CompiledLight& light, const SurfaceHit& place) {
  return light.texture < 0 ? light.value : light.value * texture_value(scene, light.texture, place);
}

LightSample sample_area(const CompiledScene& scene, const CompiledLight& light, vec3 p, RandomStream::Pair numbers) {
  const LightPoint q = sample_area_light(scene, light, p, numbers);
  // The shadow ray is to end short of the light's surface, also where it starts a little off another one.
  const vec3 towards = q.position - p, n = dot(q.normal, towards) < 0 ? q.normal : -q.normal;
  const float extent = std::max(rounding_extent(p, length(towards)), rounding_extent(q.position, 0, q.tilted_length));
  const vec3 to_light = leave_surface(q.position, n, 2 * extent) - p;
  const float distance = length(to_light);
  // What is as near as that is the light itself, of which p is a point: it does not shine on itself.
  const bool is_apart = dot(n, to_light) < 0;
  const bool lit = (light.two_sided || dot(q.normal, towards) < 0) && q.pdf > 0 && is_apart;
  if (!lit) return {{p, {0, 0, 1}, far_away}, {}, 0};
  SurfaceHit place;
  place.position = q.position;
  place.uv = q.uv;
  const float share = light.alpha < 0 ? 1 : texture_reflectance(scene, light.alpha, place)[0];
  return {{p, (1 / distance) * to_light, distance},
          (share / q.pdf) * radiance_at(scene, light, place),
          light.is_seen ? q.pdf : 0};
}

}  // namespace

LightChoice choose_light(const CompiledScene& scene, float u) {
  if (scene.lights.empty()) return {};
  const auto& cdf = scene.light_cdf;
  const auto i = static_cast<std::size_t>(std::upper_bound(cdf.begin(), cdf.end() - 1, u) - cdf.begin());
  return {static_cast<int>(i), scene.lights[i].chance};
}

bool has_extent(const CompiledLight& light) {
  return light.kind != CompiledLight::Kind::point && light.kind != CompiledLight::Kind::distant;
}

LightSample sample_light(const CompiledScene& scene, const CompiledLight& light, vec3 p, const vec3* normal,
                         RandomStream& random) {
  return sample_light(scene, light, p, normal, has_extent(light) ? random.next_pair() : RandomStream::Pair{});
}

LightSample sample_light(const CompiledScene& scene, const CompiledLight& light, vec3 p, const vec3* normal,
                         RandomStream::Pair numbers) {
  switch (light.kind) {
    case CompiledLight::Kind::point:
      return sample_point(light, p);
    case CompiledLight::Kind::distant:
      return {{p, to_float(light.direction_to), far_away}, light.value, 0};
    case CompiledLight::Kind::infinite:
      break;
    case CompiledLight::Kind::image:
      return light.portal < 0 ? sample_image(scene, light, p, numbers)
                              : sample_through_portal(scene, light, p, numbers);
    case CompiledLight::Kind::area:
      return sample_area(scene, light, p, numbers);
  }
  return sample_constant(light, p, normal, numbers);
}

Ray started_at(vec3 start, const Ray& ray) {
  if (ray.t_max >= far_away) return {start, ray.direction, ray.t_max};
  const vec3 to_end = ray.at(ray.t_max) - start;
  const float distance = length(to_end);
  return {start, distance > 0 ? (1 / distance) * to_end : ray.direction, distance};
}

float light_pdf(const CompiledScene& scene, const CompiledLight& light, const Ray& ray, const vec3* normal,
                const SurfaceHit& hit) {
  switch (light.kind) {
    case CompiledLight::Kind::point:
    case CompiledLight::Kind::distant:
      return 0;
    case CompiledLight::Kind::infinite:
      return normal ? clamped_cosine(*normal, ray.direction) / pi : 0.25f / pi;
    case CompiledLight::Kind::image:
      break;
    case CompiledLight::Kind::area:
      return area_light_pdf(scene, light, ray, hit);
  }
  return light.portal < 0 ? image_pdf(scene, light, ray.direction) : portal_pdf(scene, light, ray);
}

Spectrum environment_radiance(const CompiledScene& scene, const CompiledLight& light, const Ray& ray) {
  if (light.kind == CompiledLight::Kind::infinite) return light.value;
  if (light.kind != CompiledLight::Kind::image) return {};
  if (const CompiledPortal* portal = portal_of(scene, light); portal && !passes(*portal, ray)) return {};
  const CompiledEnvironment& e = environment_of(scene, light);
  std::uint32_t column = 0, row = 0;
  find_pixel(e, ray.direction, column, row);
  return light.value * pixel(e, column, row);
}

Spectrum emitted_radiance(const CompiledScene& scene, const SurfaceHit& hit, vec3 direction) {
  const std::int32_t index = scene.shapes[static_cast<std::size_t>(hit.shape)].light;
  if (index < 0) return {};
  const CompiledLight& light = scene.lights[static_cast<std::size_t>(index)];
  return light.two_sided || dot(hit.normal, direction) < 0 ? radiance_at(scene, light, hit) : Spectrum{};
}

}  // namespace brume

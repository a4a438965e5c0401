// The part of volpath that surfaces play: scalar, path by path.
#include <algorithm>

#include "render/lights.h"
#include "render/volpath.h"

namespace brume {

using kernel::vec3;

namespace {

// The choice of a direction from the surface at p, where `direction` comes.
auto aim_at_surface(const CompiledScene& scene, const Aim& aim, vec3 p, const SurfaceHit& hit, vec3 direction) {
  return AimFrom(aim, p, [&scene, &hit, direction](vec3 to_light) {
    float density = 0;
    eval_surface(scene, hit, direction, to_light, density);
    return density;
  });
}

}  // namespace

void VolpathIntegrator::meet_surface(std::uint32_t path) {
  const Ray ray = ray_of(path);
  const std::int32_t light = scene_.shapes[static_cast<std::size_t>(hits_[path].shape)].light;
  if (light >= 0) {
    const auto i = static_cast<std::size_t>(light);
    const float density = all_lights_.chance[i] * light_pdf(scene_, scene_.lights[i], ray, nullptr, hits_[path]);
    reach_light(path, emitted_radiance(scene_, hits_[path], ray.direction), density);
  }
  paths_.ray.t_max[path] = 0;
  const std::uint32_t depth = paths_.depth[path];
  if (static_cast<int>(depth) >= scene_.integrator.max_depth) return;

  const SurfaceHit hit = facing(hits_[path], ray.direction);
  const Spectrum before = spectrum_at(paths_.throughput, path);
  gather_at_surface(path, hit, before);
  if (static_cast<int>(depth) >= last_depth_) return;
  RandomStream random = random_of(path);
  const bool has_points = depth < sobol_events;
  random.skip_to(has_points ? static_cast<std::uint32_t>(first_point_of_event[depth] + 4) / 2 : 0, has_points ? 1 : 0,
                 random_keys::surface_event(depth));
  const SurfaceSample next = scatter_at_surface(path, hit, random);
  Spectrum throughput = before * next.weight;
  const float worth = max_value(throughput) / rescale_mean(path), survival = std::min(1.0f, worth / 0.05f);
  if (!(kernel::uniform_from_bits(random.next_bits()) < survival)) return;
  set(paths_.throughput, path, (1 / survival) * throughput);
  const Ray onward = continued(ray, hit, next);
  set(paths_.ray.origin, path, onward.origin);
  set(paths_.ray.direction, path, onward.direction);
  paths_.ray.t_max[path] = far_away;
  paths_.direction_density[path] = next.pdf > 0 ? next.pdf : -1;
  paths_.depth[path] = depth + 1;
  paths_.ray.key[path] = random_keys::event_key(scene_.seed, depth + 1);
  paths_.ray.distance_u[path] = depth + 1 < sobol_events ? paths_.points[first_point_of_event[depth + 1]][path]
                                                         : kernel::uniform_from_bits(random.next_bits());
}

// Where the path goes on from a surface: as the material samples it, or aimed at a light.
SurfaceSample VolpathIntegrator::scatter_at_surface(std::uint32_t path, const SurfaceHit& hit,
                                                    RandomStream& random) const {
  const Ray ray = ray_of(path);
  if (aim_.lights.empty() || !scatters_widely(*MaterialAt(scene_, hit)))
    return sample_surface(scene_, hit, ray.direction, random);
  const vec3 p = ray.at(hit.t);
  const auto aim = aim_at_surface(scene_, aim_, p, hit, ray.direction);
  SurfaceSample s;
  if (kernel::uniform_from_bits(random.next_bits()) < aim.chance()) {
    const auto [u, turns] = random.next_pair();
    s.direction = aim.draw(u * aim.chance(), turns);
    s.weight = eval_surface(scene_, hit, ray.direction, s.direction, s.pdf);
  } else {
    s = sample_surface(scene_, hit, ray.direction, random);
    if (!(s.pdf > 0)) {
      s.weight = (1 / (1 - aim.chance())) * s.weight;
      return s;
    }
    s.weight = s.pdf * s.weight;
  }
  s.pdf = aim.density(s.direction, s.pdf);
  s.weight = (1 / s.pdf) * s.weight;
  return s;
}

// Light from one light at a surface.
void VolpathIntegrator::gather_at_surface(std::uint32_t path, const SurfaceHit& hit, const Spectrum& throughput) {
  if (!scatters_widely(*MaterialAt(scene_, hit))) return;
  const std::uint32_t depth = paths_.depth[path];
  RandomStream random = random_of(path);
  random.skip_to(static_cast<std::uint32_t>(placement_point + 2) / 2, depth == 0 ? 1 : 0,
                 random_keys::light_choice(depth));
  const float u = depth < sobol_events ? paths_.points[first_point_of_event[depth] + 1][path]
                                       : kernel::uniform_from_bits(random.next_bits());
  const int picked = all_lights_.pick(u);
  if (picked < 0) return;
  const auto i = static_cast<std::size_t>(picked);
  const Ray ray = ray_of(path);
  const vec3 p = ray.at(hit.t);
  const LightSample s = sample_light(scene_, scene_.lights[i], p, lit_side(scene_, hit), random);
  float density = 0;
  const Spectrum f = eval_surface(scene_, hit, ray.direction, s.ray.direction, density);
  density = aim_at_surface(scene_, aim_, p, hit, ray.direction).density(s.ray.direction, density);
  const float light_density = all_lights_.chance[i] * s.pdf;
  const float share = s.pdf > 0 ? light_density / (light_density + density) : 1;
  send_shadow_ray(path, paths_.depth[path], started_at(leave_towards(p, hit, s.ray.direction), s.ray),
                  (share / (all_lights_.chance[i] * rescale_mean(path))) * throughput * f * s.value);
}

}  // namespace brume

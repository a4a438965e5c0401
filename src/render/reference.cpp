#include "render/reference.h"

#include <algorithm>
#include <cmath>

#include "render/phase.h"
#include "render/surfaces.h"

namespace brume {

using kernel::vec3;

namespace {

// The distance to the next event of a Poisson process of rate `rate`.
float exponential(float rate, RandomStream& random) { return -kernel::log_natural(1 - random.next()) / rate; }

}  // namespace

Spectrum ReferenceIntegrator::radiance(Ray ray, RandomStream& random, Foreground& seen) {
  Spectrum result, throughput = constant_spectrum(1);
  Departure departure;
  for (int scatterings = 0;; ++scatterings) {
    SurfaceHit hit;
    const bool is_hit = intersector_.nearest_surface(ray, hit);
    if (is_hit) ray.t_max = hit.t;
    Collision collision;
    Spectrum emitted;
    const bool collides = fly(ray, random, throughput, emitted, collision);
    ++counts_.rays;
    counts_.collisions += collides;
    counts_.surface_hits += is_hit && !collides;
    result = result + emitted;
    if (scatterings == 0 && (collides || is_hit))
      seen.add(1, collides ? length(collision.position - ray.origin) : hit.t);
    if (!collides) result = result + throughput * light_met(ray, is_hit ? &hit : nullptr, departure);
    if (scatterings == scene_.integrator.max_depth || (!collides && !is_hit)) return result;

    if (collides) {
      const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(collision.medium)];
      const auto scatter = [&](vec3 to_light, float& pdf) {
        pdf = phase_eval(medium, std::clamp(dot(to_light, ray.direction), -1.0f, 1.0f));
        return constant_spectrum(pdf);
      };
      result = result + throughput * direct_light(collision.position, nullptr, random, scatter);
      const auto [u, turns] = random.next_pair();
      const float mu = phase_sample(medium, u);
      departure = {phase_eval(medium, mu), false, {}};
      ray = {collision.position, kernel::direction_at_cosine(ray.direction, mu, turns), far_away};
    } else {
      hit = facing(hit, ray.direction);
      const auto scatter = [&](vec3 to_light, float& pdf) {
        return eval_surface(scene_, hit, ray.direction, to_light, pdf);
      };
      if (scatters_widely(*MaterialAt(scene_, hit)))
        result = result + throughput * direct_light(ray.at(hit.t), &hit, random, scatter);
      const SurfaceSample sample = sample_surface(scene_, hit, ray.direction, random);
      throughput = throughput * sample.weight;
      const vec3* side = lit_side(scene_, hit);
      departure = {sample.pdf, side != nullptr, side ? *side : vec3(0, 0, 0)};
      ray = continued(ray, hit, sample);
    }

    // Russian roulette on paths that carry little. A half suits albedos near 1, whose paths are long: against a limit
    // of 0.05, albedo 0.99 needs half the time to the same error; albedo 0.9 up to half more.
    const float survival = std::min(1.0f, max_value(throughput) / 0.5f);
    if (!(random.next() < survival)) return result;
    throughput = (1 / survival) * throughput;
  }
}

// Light that a flight meets at its end, on the surface that it hits or beyond all; weighed against next-event
// estimation, which finds the same light unless the flight began with a mirror's or a refracted direction.
Spectrum ReferenceIntegrator::light_met(const Ray& ray, const SurfaceHit* hit, const Departure& departure) const {
  const auto share = [&](const CompiledLight& light) {
    if (departure.pdf == 0) return 1.0f;
    const vec3* normal = departure.from_surface ? &departure.normal : nullptr;
    return departure.pdf /
           (departure.pdf + light.chance * light_pdf(scene_, light, ray, normal, hit ? *hit : SurfaceHit{}));
  };
  Spectrum result;
  if (hit) {
    const std::int32_t index = scene_.shapes[static_cast<std::size_t>(hit->shape)].light;
    if (index < 0) return {};
    return share(scene_.lights[static_cast<std::size_t>(index)]) * emitted_radiance(scene_, *hit, ray.direction);
  }
  for (const CompiledLight& light : scene_.lights)
    if (const Spectrum radiance = environment_radiance(scene_, light, ray); !is_zero(radiance))
      result = result + share(light) * radiance;
  return result;
}

// Next-event estimation: light that arrives directly at p, in a medium or on the surface `hit`, and is scattered along
// the path, backwards. `scatter` gives for a direction to a light the phase function or f cos, and the density with
// which the path itself goes on so.
template <class Scatter>
Spectrum ReferenceIntegrator::direct_light(vec3 p, const SurfaceHit* hit, RandomStream& random, Scatter scatter) {
  const LightChoice choice = choose_light(scene_, random.next());
  if (choice.index < 0) return {};
  const CompiledLight& light = scene_.lights[static_cast<std::size_t>(choice.index)];
  const LightSample s = sample_light(scene_, light, p, hit ? lit_side(scene_, *hit) : nullptr, random);
  float pdf = 0;
  const Spectrum scattered = s.value * scatter(s.ray.direction, pdf);
  if (is_zero(scattered)) return {};
  const float light_pdf = choice.chance * s.pdf, share = s.pdf > 0 ? light_pdf / (light_pdf + pdf) : 1;
  const Ray shadow_ray = hit ? started_at(leave_towards(p, *hit, s.ray.direction), s.ray) : s.ray;
  return (share / choice.chance) * scattered * transmittance(shadow_ray, random);
}

// Visits tentative collisions along the ray, nearest first, at the rate of a majorant of all media together (or of
// those with grids), until visit(t, majorant) returns false. active_ then holds the media that are there.
template <class Visit>
void ReferenceIntegrator::tentative_collisions(bool grids_only, RandomStream& random, Visit visit) {
  const auto medium_of = [&](const MediumSpan& span) -> const CompiledMedium& {
    return scene_.media[static_cast<std::size_t>(span.medium)];
  };
  cuts_.clear();
  for (const MediumSpan& span : spans_) {
    cuts_.push_back(span.t_begin);
    cuts_.push_back(span.t_end);
  }
  std::sort(cuts_.begin(), cuts_.end());
  for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
    active_.clear();
    float majorant = 0;
    for (const MediumSpan& span : spans_) {
      const CompiledMedium& medium = medium_of(span);
      if (span.t_begin > cuts_[i] || span.t_end < cuts_[i + 1] || (grids_only && medium.grid < 0)) continue;
      const float max_density = medium.grid < 0 ? 1 : scene_.grids[static_cast<std::size_t>(medium.grid)].max_density;
      active_.push_back(span);
      majorant += static_cast<float>(span.count) * max_density * max_value(medium.sigma_t);
    }
    if (majorant == 0) continue;
    // In double: far away and in dense media, float would not advance.
    double t = static_cast<double>(cuts_[i]);
    for (;;) {
      t += static_cast<double>(exponential(majorant, random));
      if (!(t < static_cast<double>(cuts_[i + 1]))) break;
      if (!visit(std::min(static_cast<float>(t), cuts_[i + 1]), majorant)) return;
    }
  }
}

float ReferenceIntegrator::density(const MediumSpan& span, float t) {
  const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(span.medium)];
  if (medium.grid < 0) return static_cast<float>(span.count);
  ++counts_.look_ups;
  const kernel::BrickGrid grid = scene_.grids[static_cast<std::size_t>(medium.grid)].view();
  const vec3 p = span.entry_index + (t - span.t_begin) * span.direction_index;
  return static_cast<float>(span.count) * (medium.linear ? grid_linear(grid, p) : grid_nearest(grid, p));
}

// What the medium emits at density 1.
Spectrum ReferenceIntegrator::emission_at_density_1(const MediumSpan& span, float t) const {
  const auto medium = static_cast<std::size_t>(span.medium);
  const vec3 p = span.entry_index + (t - span.t_begin) * span.direction_index;
  return emission_at(scene_.media[medium], emission_fields_[medium], p);
}

// Flies along the ray up to its t_max; true where a collision with a medium ends the flight. `throughput` is changed by
// the channels' weights, and at a collision by the albedo; `emitted` gets what the media emit towards the origin.
bool ReferenceIntegrator::fly(const Ray& ray, RandomStream& random, Spectrum& throughput, Spectrum& emitted,
                              Collision& collision) {
  if (const auto place = media_.find({&ray, 1}, spans_, crossings_)) too_many_media_ = place;
  bool collides = false;
  tentative_collisions(false, random, [&](float t, float majorant) {
    Spectrum sigma_t, emission;
    for (const MediumSpan& span : active_) {
      const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(span.medium)];
      const float d = density(span, t);
      sigma_t = sigma_t + d * medium.sigma_t;
      emission = emission + d * emission_at_density_1(span, t);
    }
    emitted = emitted + (1 / majorant) * throughput * emission;
    // A little more than the majorant may be rounding.
    if (max_value(sigma_t) > 1.00001f * majorant) ++counts_.majorant_violations;
    float real = sum(throughput * sigma_t) / (majorant * sum(throughput));
    if (real > 0.999999f) real = 1;  // what is left is rounding
    if (!(random.next() < real)) {
      for (int c = 0; c < channel_count; ++c) throughput[c] *= std::max(0.0f, 1 - sigma_t[c] / majorant) / (1 - real);
      return true;
    }
    // With which medium: in proportion to what each would scatter.
    float scattered = 0;
    for (const MediumSpan& span : active_)
      scattered += density(span, t) * sum(throughput * scene_.media[static_cast<std::size_t>(span.medium)].sigma_s);
    collides = true;
    float pick = random.next() * scattered;
    for (const MediumSpan& span : active_) {
      const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(span.medium)];
      const float d = density(span, t), share = d * sum(throughput * medium.sigma_s);
      pick -= share;
      if (share == 0 || (pick > 0 && &span != &active_.back())) continue;
      collision = {ray.at(t), span.medium};
      throughput = (d * scattered / (share * majorant * real)) * throughput * medium.sigma_s;
      return false;
    }
    throughput = {};  // absorbed
    collision = {ray.at(t), active_.front().medium};
    return false;
  });
  return collides;
}

// An unbiased estimate of the fraction of light that crosses the ray's media; 0 behind a surface.
Spectrum ReferenceIntegrator::transmittance(const Ray& ray, RandomStream& random) {
  ++counts_.shadow_rays;
  std::uint8_t blocked = 0;
  intersector_.occluded({&ray, 1}, {&blocked, 1});
  if (blocked) return {};
  if (const auto place = media_.find({&ray, 1}, spans_, crossings_)) too_many_media_ = place;
  Spectrum result = constant_spectrum(1);
  for (const MediumSpan& span : spans_) {
    const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(span.medium)];
    if (medium.grid >= 0) continue;
    const float amount = static_cast<float>(span.count) * (span.t_end - span.t_begin);
    for (int c = 0; c < channel_count; ++c) result[c] *= kernel::beer_lambert(amount * medium.sigma_t[c]);
  }
  tentative_collisions(true, random, [&](float t, float majorant) {
    Spectrum sigma_t;
    for (const MediumSpan& span : active_)
      sigma_t = sigma_t + density(span, t) * scene_.media[static_cast<std::size_t>(span.medium)].sigma_t;
    for (int c = 0; c < channel_count; ++c) result[c] *= std::max(0.0f, 1 - sigma_t[c] / majorant);
    const float survival = std::min(1.0f, max_value(result) / 0.1f);
    if (random.next() < survival) {
      result = (1 / survival) * result;
      return true;
    }
    result = {};
    return false;
  });
  return result;
}

}  // namespace brume

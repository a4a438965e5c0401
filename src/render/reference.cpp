#include "render/reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/directions.h"
#include "render/phase.h"
#include "render/surfaces.h"

namespace brume {

using kernel::vec3;

namespace {

constexpr float inverse_sphere = 0.25f * std::numbers::inv_pi_v<float>;  // density of a uniform direction

float sum(const Spectrum& s) {
  float total = 0;
  for (int c = 0; c < channel_count; ++c) total += s[c];
  return total;
}

// The distance to the next event of a Poisson process of rate `rate`.
float exponential(float rate, RandomStream& random) { return -kernel::log_natural(1 - random.next()) / rate; }

bool is_infinite(const CompiledLight& light) { return light.kind == CompiledLight::Kind::infinite; }

}  // namespace

Spectrum ReferenceIntegrator::radiance(Ray ray, RandomStream& random) {
  Spectrum result, throughput = constant_spectrum(1);
  // The share of an infinite light, seen at the end of this flight, that next-event estimation has left to it.
  float unseen_share = 1;
  for (int scatterings = 0;; ++scatterings) {
    SurfaceHit hit;
    const bool is_hit = intersector_.nearest_surface(ray, hit);
    if (is_hit) ray.t_max = hit.t;
    Collision collision;
    Spectrum emitted;
    const bool collides = fly(ray, random, throughput, emitted, collision);
    result = result + emitted;
    if (!collides && !is_hit) {
      for (const CompiledLight& light : scene_.lights)
        if (is_infinite(light)) result = result + unseen_share * throughput * light.value;
      return result;
    }
    if (scatterings == scene_.integrator.max_depth) return result;

    if (collides) {
      const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(collision.medium)];
      result = result + throughput * light_at_collision(ray, collision, random);
      const auto [u, turns] = random.next_pair();
      const float mu = phase_sample(medium, u);
      const vec3 direction = rotate_to(ray.direction, direction_around_z(mu, turns));
      const float chosen = phase_eval(medium, mu);
      unseen_share = chosen / (chosen + inverse_sphere);
      ray = {collision.position, normalize(direction), far_away};
    } else {
      hit = facing(hit, ray.direction);
      result = result + throughput * light_at_surface(ray, hit, random);
      const CompiledShape& shape = scene_.shapes[static_cast<std::size_t>(hit.shape)];
      const CompiledMaterial& material = scene_.materials[static_cast<std::size_t>(shape.material)];
      const float mirror = sum(material.mirror), matt = sum(material.diffuse + material.specular);
      if (mirror + matt == 0) return result;
      const float mirror_chance = mirror / (mirror + matt);
      vec3 direction;
      if (random.next() < mirror_chance) {
        direction = reflect(ray.direction, hit.shading_normal);
        throughput = (1 / mirror_chance) * throughput * material.mirror;
        unseen_share = 1;
      } else {
        // By the cosine, as infinite lights are sampled too: the shares are those of the chances alone.
        const auto [u, turns] = random.next_pair();
        direction = rotate_to(hit.shading_normal, direction_around_z(std::sqrt(1 - u), turns));
        const Spectrum f = blinn_phong(material, hit.shading_normal, direction, -ray.direction);
        throughput = (std::numbers::pi_v<float> / (1 - mirror_chance)) * throughput * f;
        unseen_share = (1 - mirror_chance) / (2 - mirror_chance);
      }
      if (dot(direction, hit.normal) <= 0) return result;
      ray = {leave_surface(ray.at(hit.t), hit.normal, hit.t), normalize(direction), far_away};
    }

    // Russian roulette on paths that carry little.
    const float survival = std::min(1.0f, max_value(throughput) / 0.05f);
    if (!(random.next() < survival)) return result;
    throughput = (1 / survival) * throughput;
  }
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

float ReferenceIntegrator::density(const MediumSpan& span, float t) const {
  const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(span.medium)];
  if (medium.grid < 0) return static_cast<float>(span.count);
  const kernel::BrickGrid grid = scene_.grids[static_cast<std::size_t>(medium.grid)].view();
  const vec3 p = span.entry_index + (t - span.t_begin) * span.direction_index;
  return static_cast<float>(span.count) * (medium.linear ? grid_linear(grid, p) : grid_nearest(grid, p));
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
      emission = emission + d * medium.emission;
    }
    emitted = emitted + (1 / majorant) * throughput * emission;
    // A little more than the majorant may be rounding.
    if (max_value(sigma_t) > 1.00001f * majorant) ++majorant_violations_;
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

// Light that arrives directly at a collision and goes on along the ray, backwards.
Spectrum ReferenceIntegrator::light_at_collision(const Ray& ray, const Collision& collision, RandomStream& random) {
  const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(collision.medium)];
  Spectrum result;
  for (const CompiledLight& light : scene_.lights) {
    const LightSample s = sample_light_from_point(light, collision.position, random);
    const float phase = phase_eval(medium, std::clamp(dot(s.ray.direction, ray.direction), -1.0f, 1.0f));
    const float share = is_infinite(light) ? inverse_sphere / (inverse_sphere + phase) : 1;
    result = result + (share * phase) * s.value * transmittance(s.ray, random);
  }
  return result;
}

// Light that arrives directly at a surface and is reflected along the ray, backwards.
Spectrum ReferenceIntegrator::light_at_surface(const Ray& ray, const SurfaceHit& hit, RandomStream& random) {
  const CompiledShape& shape = scene_.shapes[static_cast<std::size_t>(hit.shape)];
  const CompiledMaterial& material = scene_.materials[static_cast<std::size_t>(shape.material)];
  const float mirror = sum(material.mirror), matt = sum(material.diffuse + material.specular);
  Spectrum result;
  if (matt == 0) return result;
  const vec3 p = ray.at(hit.t), start = leave_surface(p, hit.normal, hit.t);
  const float light_share = 1 / (2 - mirror / (mirror + matt));
  for (const CompiledLight& light : scene_.lights) {
    const LightSample s = sample_light_from_surface(light, p, hit.shading_normal, random);
    const float cosine = dot(s.ray.direction, hit.shading_normal);
    if (cosine <= 0 || dot(s.ray.direction, hit.normal) <= 0) continue;
    const Spectrum f = blinn_phong(material, hit.shading_normal, s.ray.direction, -ray.direction);
    const float share = is_infinite(light) ? light_share : 1;
    result = result + (share * cosine) * f * s.value * transmittance({start, s.ray.direction, s.ray.t_max}, random);
  }
  return result;
}

}  // namespace brume

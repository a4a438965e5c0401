#include "render/classic.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/phase.h"
#include "render/surfaces.h"

namespace brume {

using kernel::vec3;

namespace {

constexpr float negligible_transmittance = 1e-4f;
// Steps whose densities are looked up together.
constexpr int batch_size = 64;
constexpr int most_followers = 4096;  // of a camera ray
// Shadow rays that are followed together: some times as many as there are lanes.
constexpr std::size_t shadow_batch = 1024;
// With random placements, the share of scattered light that one shadow ray stands for.
constexpr float faint_share = 1.0f / 32;

// Pair i of n that together are spread evenly over the square, each by itself as random as `numbers`: Hammersley's
// points, moved by `numbers` around the edges. Source: R. Cranley and T. Patterson, "Randomization of number theoretic
// methods for multiple integration", SIAM J. Numer. Anal. 13(6), 1976.
RandomStream::Pair stratified(RandomStream::Pair numbers, int i, int n) {
  const auto moved = [](float x, float by) { return x + by < 1 ? x + by : x + by - 1; };
  const auto index = static_cast<std::uint32_t>(i);
  return {moved(numbers.u, static_cast<float>(i) / static_cast<float>(n)),
          moved(numbers.v, kernel::uniform_from_bits(kernel::reverse_bits(index)))};
}

}  // namespace

ClassicIntegrator::ClassicIntegrator(const CompiledScene& scene, const Intersector& intersector,
                                     const MediaAlongRay& media, const ShadowCache* cache)
    : scene_(scene),
      intersector_(intersector),
      media_(media),
      cache_(cache),
      emission_fields_(emission_fields(scene)),
      visibility_(scene, intersector, media) {}

void ClassicIntegrator::render(std::span<CameraSample> samples) {
  direct_.assign(samples.size(), {});
  for (sample_ = 0; sample_ < samples.size(); ++sample_) samples[sample_].radiance = radiance(samples[sample_]);
  follow_shadow_rays();
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].radiance = samples[i].radiance + direct_[i];
}

// The radiance of a sample but for what its shadow rays will bring.
Spectrum ClassicIntegrator::radiance(CameraSample& sample) {
  Spectrum result;
  pending_.assign(1, {sample.ray, constant_spectrum(1), 0});
  for (int followed = 0; !pending_.empty() && followed <= most_followers; ++followed) {
    const Branch branch = pending_.back();
    pending_.pop_back();
    Foreground ahead;
    result = result + follow(branch, sample.random, ahead);
    if (followed == 0) sample.seen = ahead;
  }
  return result;
}

// What one ray adds, and in `seen` where it is stopped; the rays that go on from its end become pending.
Spectrum ClassicIntegrator::follow(const Branch& branch, RandomStream& random, Foreground& seen) {
  Branch at_end = branch;
  Ray& ray = at_end.ray;
  SurfaceHit hit;
  const bool is_hit = intersector_.nearest_surface(ray, hit);
  ++counts_.rays;
  counts_.surface_hits += is_hit;
  if (is_hit) ray.t_max = hit.t;
  const bool scatters = branch.depth < scene_.integrator.max_depth;
  Spectrum transmittance = constant_spectrum(1);
  Spectrum result = branch.throughput * cross_media(at_end, scatters, random, transmittance, seen);
  if (is_hit) seen.add(1 - seen.coverage, hit.t);
  at_end.throughput = branch.throughput * transmittance;
  if (!is_hit) return result + at_end.throughput * background(at_end);
  const std::int32_t light = scene_.shapes[static_cast<std::size_t>(hit.shape)].light;
  if (light >= 0)
    result = result + share(at_end, scene_.lights[static_cast<std::size_t>(light)], hit) * at_end.throughput *
                          emitted_radiance(scene_, hit, ray.direction);
  if (!scatters || is_zero(at_end.throughput)) return result;
  hit = facing(hit, ray.direction);
  branch_off(at_end, hit, random);
  direct_light(at_end, hit, random);
  return result + at_end.throughput * MaterialAt(scene_, hit)->ambient * scene_.ambient;
}

// The reflected and the refracted ray; of a rough surface one that a facet sends on. A shading normal can send them to
// the wrong side, where they are dropped.
void ClassicIntegrator::branch_off(const Branch& branch, const SurfaceHit& hit, RandomStream& random) {
  const MaterialAt at(scene_, hit);
  const CompiledMaterial& material = *at;
  const auto add = [&](const SurfaceSample& s) {
    const Spectrum throughput = branch.throughput * s.weight;
    if (max_value(throughput) < negligible_transmittance || (dot(s.direction, hit.normal) < 0) != s.transmitted) return;
    const vec3* side = lit_side(scene_, hit);
    pending_.push_back({continued(branch.ray, hit, s), throughput, branch.depth + 1, s.pdf,
                        side ? std::optional(*side) : std::nullopt});
  };
  if (material.alpha > 0) return add(sample_facets(material, hit, branch.ray.direction, random));
  const SmoothLobes lobes = smooth_lobes(material, hit, branch.ray.direction);
  add({reflect(branch.ray.direction, hit.shading_normal), lobes.reflected, 0, false});
  add({lobes.refracted_direction, lobes.squeeze * lobes.refracted, 0, true});
}

// The balance heuristic's share for the branch of light that it meets: shadow rays have found that light too where the
// branch comes from a facet.
float ClassicIntegrator::share(const Branch& branch, const CompiledLight& light, const SurfaceHit& hit) const {
  if (branch.pdf == 0) return 1;
  const float by_shadow_rays = static_cast<float>(scene_.integrator.shadow_samples) *
                               light_pdf(scene_, light, branch.ray, branch.normal ? &*branch.normal : nullptr, hit);
  return branch.pdf / (branch.pdf + by_shadow_rays);
}

// What the media along the ray add, in `transmittance` what they leave of what lies behind them, and in `seen` where
// the rest was stopped.
Spectrum ClassicIntegrator::cross_media(const Branch& branch, bool scatters, RandomStream& random,
                                        Spectrum& transmittance, Foreground& seen) {
  const Ray& ray = branch.ray;
  if (const auto place = media_.find({&ray, 1}, spans_, crossings_)) too_many_media_ = place;
  points_.clear();
  scatterings_.clear();
  find_cuts();
  Spectrum emitted;
  const CompiledIntegrator& settings = scene_.integrator;
  if (settings.placement_spread > 0) shares_seen_ = random.next();
  for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
    const float t_begin = cuts_[i], t_end = cuts_[i + 1];
    const float longest = longest_step(t_begin, t_end);
    if (active_.empty()) continue;
    const int count = static_cast<int>(std::clamp(std::ceil((t_end - t_begin) / longest), 1.0f, 1048576.0f));
    const float length = (t_end - t_begin) / static_cast<float>(count);
    for (int first = 0; first < count; first += batch_size) {
      place_steps(t_begin, length, first, std::min(count, first + batch_size), random);
      find_densities();
      for (std::size_t k = 0; k < steps_.size(); ++k) {
        const float before = sum(transmittance);
        emitted = emitted + take_step(ray, k, scatters, transmittance);
        const bool ends = max_value(transmittance) < negligible_transmittance;
        if (ends) transmittance = {};
        seen.add((before - sum(transmittance)) / channel_count, sample_t_[k]);
        if (!ends) continue;
        return emitted + in_scattering(branch, random);
      }
    }
  }
  return emitted + in_scattering(branch, random);
}

// Steps [first, last) of equal length from t_begin on, with a sample in each.
void ClassicIntegrator::place_steps(float t_begin, float length, int first, int last, RandomStream& random) {
  const CompiledIntegrator& settings = scene_.integrator;
  steps_.clear();
  sample_t_.clear();
  for (int k = first; k < last; ++k) {
    const float u = settings.placement_spread > 0 ? random.next() : 0;
    steps_.push_back({t_begin + length * static_cast<float>(k), length});
    sample_t_.push_back(
        kernel::march_position(t_begin, length, k, settings.placement_base, settings.placement_spread, u));
  }
}

// The places along the ray between which the set of media is constant, and with DDA the cell of each grid too.
void ClassicIntegrator::find_cuts() {
  cuts_.clear();
  for (const MediumSpan& span : spans_) {
    cuts_.push_back(span.t_begin);
    cuts_.push_back(span.t_end);
    const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(span.medium)];
    if (!scene_.integrator.dda || medium.grid < 0) continue;
    const float shift = medium.linear ? 0.5f : 0;
    kernel::Dda walk = kernel::dda_start(span.entry_index - vec3(shift, shift, shift), span.direction_index);
    for (;;) {
      const float t = span.t_begin + kernel::dda_cell_exit(walk);
      if (!(t < span.t_end)) break;
      cuts_.push_back(t);
      kernel::dda_step(walk);
    }
  }
  std::sort(cuts_.begin(), cuts_.end());
  cuts_.erase(std::unique(cuts_.begin(), cuts_.end()), cuts_.end());
}

// Finds the media that are active in [t_begin, t_end] and the longest step that they allow there.
float ClassicIntegrator::longest_step(float t_begin, float t_end) {
  active_.clear();
  float longest = far_away;
  for (const MediumSpan& span : spans_) {
    if (span.t_begin > t_begin || span.t_end < t_end) continue;
    active_.push_back(span);
    const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(span.medium)];
    if (scene_.integrator.dda && medium.grid >= 0) continue;  // one cell already
    longest = std::min(longest, march_step(scene_, medium, span.t_end - span.t_begin));
  }
  return longest;
}

// The density of each active medium in each step: at the step's sample, or with DDA its mean over the step.
void ClassicIntegrator::find_densities() {
  densities_.resize(active_.size() * batch_size);
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const MediumSpan& span = active_[i];
    const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(span.medium)];
    const std::span<float> density = std::span(densities_).subspan(i * batch_size, steps_.size());
    if (medium.grid < 0) {
      std::fill(density.begin(), density.end(), 1.0f);
    } else if (scene_.integrator.dda) {
      for (std::size_t k = 0; k < steps_.size(); ++k) density[k] = mean_density(span, medium, steps_[k]);
    } else {
      sample_density(scene_.grids[static_cast<std::size_t>(medium.grid)].view(), medium.linear, span.entry_index,
                     span.direction_index, span.t_begin, sample_t_, density);
    }
    if (medium.grid >= 0) counts_.look_ups += static_cast<std::int64_t>(steps_.size());
    for (float& d : density) d *= static_cast<float>(span.count);
  }
}

// The mean density over a step that lies within one cell.
float ClassicIntegrator::mean_density(const MediumSpan& span, const CompiledMedium& medium, const Step& step) const {
  const kernel::BrickGrid grid = scene_.grids[static_cast<std::size_t>(medium.grid)].view();
  const float shift = medium.linear ? 0.5f : 0;
  const vec3 origin = span.entry_index - vec3(shift, shift, shift);
  const float begin = step.t_begin - span.t_begin, end = begin + step.length;
  const vec3 middle = origin + (0.5f * (begin + end)) * span.direction_index;
  const int x = kernel::floor_to_int(middle.x), y = kernel::floor_to_int(middle.y), z = kernel::floor_to_int(middle.z);
  if (!medium.linear) return kernel::grid_voxel(grid, x, y, z);
  const kernel::Cell cell = kernel::grid_cell(grid, x, y, z);
  return kernel::cell_mean_linear(cell, x, y, z, origin, span.direction_index, begin, end);
}

// Crosses one step: returns what it emits, takes note of what it scatters, and lowers the transmittance.
Spectrum ClassicIntegrator::take_step(const Ray& ray, std::size_t step, bool scatters, Spectrum& transmittance) {
  Spectrum optical_depth, emission;
  const std::size_t first = scatterings_.size();
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const float amount = steps_[step].length * densities_[i * batch_size + step];
    if (amount == 0) continue;
    const MediumSpan& span = active_[i];
    const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(span.medium)];
    optical_depth = optical_depth + amount * medium.sigma_t;
    const vec3 p_index = span.entry_index + (sample_t_[step] - span.t_begin) * span.direction_index;
    emission =
        emission + amount * emission_at(medium, emission_fields_[static_cast<std::size_t>(span.medium)], p_index);
    if (scatters && !is_zero(medium.sigma_s)) scatterings_.push_back({span.medium, amount * medium.sigma_s});
  }
  if (is_zero(optical_depth)) return {};
  Spectrum share;
  for (int c = 0; c < channel_count; ++c) share[c] = transmittance[c] * kernel::mean_transmittance(optical_depth[c]);
  for (std::size_t i = first; i < scatterings_.size(); ++i) scatterings_[i].weight = scatterings_[i].weight * share;
  if (scatterings_.size() > first && chosen(first))
    points_.push_back({ray.at(sample_t_[step]), first, scatterings_.size()});
  else
    scatterings_.resize(first);
  // T exp(-tau) = T - T (1 - exp(-tau)): over many thin steps of equal depth, rounding errors of exp would add up.
  for (int c = 0; c < channel_count; ++c)
    transmittance[c] = std::max(0.0f, transmittance[c] - share[c] * optical_depth[c]);
  return emission * share;
}

// Whether the point whose scatterings begin at `first` gets shadow rays. With placements that are not random, always.
// With random ones a faint point is one of many, and one stands for all: as shares add up along the ray, a point is
// chosen whenever the sum passes another whole faint_share, and counts as that much. The sum starts at a random
// fraction, so a point's chance is its share over faint_share, which its weight is divided by: systematic sampling,
// without bias.
bool ClassicIntegrator::chosen(std::size_t first) {
  if (scene_.integrator.placement_spread == 0) return true;
  Spectrum total;
  for (std::size_t i = first; i < scatterings_.size(); ++i) total = total + scatterings_[i].weight;
  const float chance = max_value(total) / faint_share;
  if (chance >= 1) return true;
  shares_seen_ += chance;
  if (!(shares_seen_ >= 1)) return false;
  shares_seen_ -= 1;
  for (std::size_t i = first; i < scatterings_.size(); ++i)
    scatterings_[i].weight = (1 / chance) * scatterings_[i].weight;
  return true;
}

// The ambient light that the points taken note of scatter towards the ray's origin; for that of the lights it sends
// shadow rays.
Spectrum ClassicIntegrator::in_scattering(const Branch& branch, RandomStream& random) {
  Spectrum result;
  if (points_.empty()) return result;
  for (const Scattering& s : scatterings_) result = result + scene_.ambient * s.weight;
  for (std::size_t light = 0; light < scene_.lights.size(); ++light) {
    for (const Point& point : points_) {
      const LightSample s = sample_light(scene_, scene_.lights[light], point.position, nullptr, random);
      // Light travels against the shadow ray, and is scattered against the camera's: the two signs cancel.
      const float mu = std::clamp(dot(s.ray.direction, branch.ray.direction), -1.0f, 1.0f);
      Spectrum scattered;
      int cached_medium = no_medium;
      for (std::size_t k = point.first; k < point.last; ++k) {
        const auto& [medium, weight] = scatterings_[k];
        scattered = scattered + phase_eval(scene_.media[static_cast<std::size_t>(medium)], mu) * weight;
        if (cache_ && cached_medium == no_medium && cache_->covers(light, medium)) cached_medium = medium;
      }
      Spectrum worth = branch.throughput * s.value * scattered;
      if (cached_medium != no_medium) worth = worth * cache_->transmittance(light, cached_medium, point.position);
      send_shadow_ray(s.ray, random, worth, cached_medium == no_medium);
    }
  }
  return result;
}

// What the surface sends back of the light that arrives directly, by shadow rays. Of lights that have a size a rough
// surface's facets reflect a part along the rays that branch off.
void ClassicIntegrator::direct_light(const Branch& branch, const SurfaceHit& hit, RandomStream& random) {
  if (!scatters_widely(*MaterialAt(scene_, hit))) return;
  const Ray& ray = branch.ray;
  const vec3 p = ray.at(hit.t);
  for (const CompiledLight& light : scene_.lights) {
    const bool extends = has_extent(light);
    const int count = extends ? scene_.integrator.shadow_samples : 1;
    const RandomStream::Pair numbers = extends ? random.next_pair() : RandomStream::Pair{};
    for (int i = 0; i < count; ++i) {
      const LightSample s = sample_light(scene_, light, p, lit_side(scene_, hit), stratified(numbers, i, count));
      const vec3 to_light = s.ray.direction;
      float facet_pdf = 0;
      const Spectrum facets = eval_facets(scene_, hit, ray.direction, to_light, facet_pdf);
      const float light_pdf = static_cast<float>(count) * s.pdf,
                  share = light_pdf > 0 ? light_pdf / (light_pdf + facet_pdf) : 1;
      const Spectrum reflected = eval_matt(scene_, hit, ray.direction, to_light) + (facet_pdf > 0 ? share : 0) * facets;
      send_shadow_ray(started_at(leave_towards(p, hit, to_light), s.ray), random,
                      (1 / static_cast<float>(count)) * branch.throughput * s.value * reflected, true);
    }
  }
}

// Asks for light along the ray, which is worth that much to the current sample.
void ClassicIntegrator::send_shadow_ray(const Ray& ray, RandomStream& random, const Spectrum& worth,
                                        bool through_media) {
  if (is_zero(worth)) return;
  ++counts_.shadow_rays;
  const bool marches_at_random = !scene_.integrator.dda && scene_.integrator.placement_spread > 0;
  shadow_rays_.add(ray, marches_at_random ? random.next_bits() : 0, through_media);
  claims_.push_back({sample_, worth});
  if (claims_.size() == shadow_batch) follow_shadow_rays();
}

void ClassicIntegrator::follow_shadow_rays() {
  visibility_.find(shadow_rays_, transmittance_);
  for (std::size_t i = 0; i < claims_.size(); ++i) {
    Spectrum& direct = direct_[claims_[i].sample];
    direct = direct + claims_[i].worth * transmittance_[i];
  }
  shadow_rays_.clear();
  claims_.clear();
}

Spectrum ClassicIntegrator::background(const Branch& branch) const {
  Spectrum result;
  for (const CompiledLight& light : scene_.lights)
    if (const Spectrum radiance = environment_radiance(scene_, light, branch.ray); !is_zero(radiance))
      result = result + share(branch, light, {}) * radiance;
  return result;
}

}  // namespace brume

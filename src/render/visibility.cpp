#include "render/visibility.h"

#include <algorithm>
#include <bit>

#include "render/lights.h"
#include "render/surfaces.h"

namespace brume {

namespace {

// An optical depth beyond which the transmittance (below 1e-11) needs no better value.
constexpr float opaque_depth = 25;
constexpr float negligible_transmittance = 1e-6f;  // of surfaces
constexpr int most_surfaces = 1000;

float smallest_positive(const Spectrum& s) {
  float smallest = 0;
  for (int c = 0; c < channel_count; ++c)
    if (s[c] > 0 && (smallest == 0 || s[c] < smallest)) smallest = s[c];
  return smallest;
}

}  // namespace

float march_step(const CompiledScene& scene, const CompiledMedium& medium, float chord) {
  if (scene.integrator.step > 0) return static_cast<float>(scene.integrator.step);
  return medium.grid >= 0 ? static_cast<float>(medium.default_step) : chord / 64;
}

Visibility::Visibility(const CompiledScene& scene, const Intersector& intersector, const MediaAlongRay& media)
    : scene_(scene),
      intersector_(intersector),
      media_(media),
      has_glass_(std::any_of(scene.materials.begin(), scene.materials.end(),
                             [](const CompiledMaterial& m) { return !is_zero(m.refraction); })) {}

void ShadowRays::clear() {
  rays.clear();
  keys.clear();
  crosses_media.clear();
}

void ShadowRays::add(const Ray& ray, std::uint32_t key, bool through_media) {
  rays.push_back(ray);
  keys.push_back(key);
  crosses_media.push_back(through_media);
}

void Visibility::find(const ShadowRays& rays, std::vector<Spectrum>& transmittance) {
  transmittance.resize(rays.size());
  blocked_.resize(rays.size());
  intersector_.occluded(rays.rays, blocked_);
  for (std::size_t i = 0; i < rays.size(); ++i)
    transmittance[i] = blocked_[i] == 0 ? constant_spectrum(1) : has_glass_ ? cross_glass(rays.rays[i]) : Spectrum{};
  cross_media(rays, transmittance);
}

void Visibility::cross_media(const ShadowRays& rays, std::span<Spectrum> transmittance) {
  open_rays_.clear();
  open_indices_.clear();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (rays.crosses_media[i] == 0 || is_zero(transmittance[i])) continue;
    open_rays_.push_back(rays.rays[i]);
    open_indices_.push_back(i);
  }

  if (const auto place = media_.find(open_rays_, spans_, crossings_)) too_many_media_ = place;
  std::stable_sort(spans_.begin(), spans_.end(),
                   [](const MediumSpan& a, const MediumSpan& b) { return a.medium < b.medium; });
  optical_depth_.assign(open_rays_.size(), Spectrum{});
  for (auto first = spans_.begin(); first != spans_.end();) {
    const auto last = std::find_if(first, spans_.end(), [&](const auto& s) { return s.medium != first->medium; });
    add_optical_depths(first->medium, {first, last}, rays);
    first = last;
  }
  for (std::size_t i = 0; i < open_rays_.size(); ++i)
    for (int c = 0; c < channel_count; ++c)
      transmittance[open_indices_[i]][c] *= kernel::beer_lambert(optical_depth_[i][c]);
}

// What the surfaces along the ray leave; 0 behind an opaque one.
Spectrum Visibility::cross_glass(Ray ray) const {
  Spectrum left = constant_spectrum(1);
  SurfaceHit hit;
  for (int crossed = 0; intersector_.nearest_surface(ray, hit); ++crossed) {
    hit = facing(hit, ray.direction);
    left = left * straight_transmittance(*MaterialAt(scene_, hit), clamped_cosine(hit.shading_normal, -ray.direction));
    if (max_value(left) < negligible_transmittance || crossed == most_surfaces) return {};
    ray = started_at(leave_surface(ray.at(hit.t), -hit.normal, hit.extent), ray);
  }
  return left;
}

void Visibility::add_optical_depths(int medium_index, std::span<const MediumSpan> spans, const ShadowRays& rays) {
  const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(medium_index)];
  const float smallest = smallest_positive(medium.sigma_t);
  if (smallest == 0) return;
  const auto add = [&](const MediumSpan& span, float density_integral) {
    const float amount = static_cast<float>(span.count) * density_integral;
    Spectrum& tau = optical_depth_[static_cast<std::size_t>(span.ray)];
    tau = tau + amount * medium.sigma_t;
  };
  if (medium.grid < 0) {
    for (const MediumSpan& span : spans) add(span, span.t_end - span.t_begin);
    return;
  }
  const CompiledIntegrator& settings = scene_.integrator;
  stretches_.clear();
  for (const MediumSpan& span : spans) {
    const std::uint32_t ray_key = rays.keys[open_indices_[static_cast<std::size_t>(span.ray)]];
    const std::uint32_t key = kernel::random_bits(ray_key, static_cast<std::uint32_t>(medium_index),
                                                  std::bit_cast<std::uint32_t>(span.t_begin), 0);
    stretches_.add(span.entry_index, span.direction_index, span.t_end - span.t_begin, key);
  }
  const DensityQuadrature quadrature{medium.linear,
                                     settings.dda,
                                     march_step(scene_, medium, 0),
                                     settings.placement_base,
                                     settings.placement_spread,
                                     opaque_depth / smallest};
  integrate_density(scene_.grids[static_cast<std::size_t>(medium.grid)].view(), quadrature, stretches_, integral_);
  for (std::size_t i = 0; i < spans.size(); ++i) add(spans[i], integral_[i]);
}

}  // namespace brume

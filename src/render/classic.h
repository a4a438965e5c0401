// Integrator "classic": camera rays with surfaces that are lit directly, reflected and refracted rays, shadows, and
// media with absorption, emission and single scattering, crossed by ray marching or by DDA. What a graphics course
// teaches first, done with care.
//
// A ray that meets a mirror or glass goes on as one or two others, from a rough surface in a direction drawn from its
// facets, each with what is left of its weight, up to max_depth; those that weigh next to nothing are dropped (adaptive
// depth control), and a camera ray has 4096 followers at the most. Shadow rays pass through glass unrefracted, with
// Fresnel's share of the light.
//
// Along a ray with throughput 1,
//   L = sum over steps of T(t_i) (1 - exp(-tau_i)) / tau_i (sigma_s_i Ls(t_i) + sigma_a_i Le) length_i
//       + T(t_surface) (surface's reflected light),
// where tau_i is the step's optical depth, T the transmittance up to it, and Ls = sum over lights of phase function
// times the light that arrives. Within a step the coefficients are those of its one sample (march) or its exact mean
// (dda), and what multiplies emission from place to place is that of the sample; a bias of O(step^2) for placements
// about the middle and O(step) for "start" is left. A path of the camera ends where its transmittance falls below 1e-4.
// With random placements, steps that scatter little share shadow rays: one is chosen for every 1/32 of the light that
// the ray scatters, by systematic sampling, which costs no bias and, over a picture's samples, next to no noise.
// Source: N. Max, "Optical Models for Direct Volume Rendering", TVCG 1(2), 1995, section 5; T. Whitted, "An Improved
// Illumination Model for Shaded Display", CACM 23(6), 1980; R. Hall and D. Greenberg, "A Testbed for Realistic Image
// Synthesis", IEEE CG&A 3(8), 1983 (adaptive depth control).
#pragma once

#include <vector>

#include "image/film.h"
#include "render/lights.h"
#include "render/render_counts.h"
#include "render/shadow_cache.h"
#include "render/visibility.h"

namespace brume {

// A sample of a pixel: the camera's ray and its random numbers; and then the radiance that arrives along it, and what
// the ray meets, its depth along the ray.
struct CameraSample {
  Ray ray;
  RandomStream random;
  Spectrum radiance;
  Foreground seen;
};

// One to each worker: it keeps its arrays from call to call.
class ClassicIntegrator {
 public:
  // `cache` is null where shadow rays are to march through media too.
  ClassicIntegrator(const CompiledScene& scene, const Intersector& intersector, const MediaAlongRay& media,
                    const ShadowCache* cache);

  // Finds the samples' radiance. Their shadow rays are followed many together, in SIMD lanes; what comes of a sample
  // does not depend on the others.
  void render(std::span<CameraSample> samples);

  const RenderCounts& counts() const { return counts_; }

  // A place where more than max_active_media media overlap, once a ray has met one.
  std::optional<kernel::vec3> too_many_media() const {
    return too_many_media_ ? too_many_media_ : visibility_.too_many_media();
  }

 private:
  // A ray of the tree that a camera ray begins, and what radiance along it is worth.
  struct Branch {
    Ray ray;
    Spectrum throughput;
    int depth;                             // how many reflections and refractions lie before it
    float pdf = 0;                         // of its direction, where it was drawn from facets
    std::optional<kernel::vec3> normal{};  // where it comes from; see lit_side
  };
  // A medium at a sample point of a ray, and the point's share of the light that it scatters.
  struct Scattering {
    int medium;
    Spectrum weight;
  };
  struct Step {
    float t_begin, length;
  };
  struct Point {
    kernel::vec3 position;
    std::size_t first, last;  // in scatterings_
  };

  // A sample and what a shadow ray's light is worth to it.
  struct Claim {
    std::size_t sample;
    Spectrum worth;
  };

  Spectrum radiance(CameraSample& sample);
  Spectrum follow(const Branch& branch, RandomStream& random, Foreground& seen);
  void branch_off(const Branch& branch, const SurfaceHit& hit, RandomStream& random);
  Spectrum cross_media(const Branch& branch, bool scatters, RandomStream& random, Spectrum& transmittance,
                       Foreground& seen);
  void find_cuts();
  float longest_step(float t_begin, float t_end);
  void place_steps(float t_begin, float length, int first, int last, RandomStream& random);
  void find_densities();
  float mean_density(const MediumSpan& span, const CompiledMedium& medium, const Step& step) const;
  Spectrum take_step(const Ray& ray, std::size_t step, bool scatters, Spectrum& transmittance);
  bool chosen(std::size_t first);
  Spectrum in_scattering(const Branch& branch, RandomStream& random);
  void direct_light(const Branch& branch, const SurfaceHit& hit, RandomStream& random);
  void send_shadow_ray(const Ray& ray, RandomStream& random, const Spectrum& worth, bool through_media);
  void follow_shadow_rays();
  float share(const Branch& branch, const CompiledLight& light, const SurfaceHit& hit) const;
  Spectrum background(const Branch& branch) const;

  const CompiledScene& scene_;
  const Intersector& intersector_;
  const MediaAlongRay& media_;
  const ShadowCache* cache_;
  const std::vector<kernel::EmissionField> emission_fields_;
  Visibility visibility_;
  std::optional<kernel::vec3> too_many_media_;

  std::vector<Branch> pending_;
  std::vector<MediumSpan> spans_, active_;  // of the current ray; those that cover the current step
  std::vector<Crossing> crossings_;
  std::vector<float> cuts_;
  std::vector<Step> steps_;       // a batch of consecutive steps,
  std::vector<float> sample_t_;   // the place of each one's sample,
  std::vector<float> densities_;  // and its densities: batch_size for each of active_
  std::vector<Point> points_;
  std::vector<Scattering> scatterings_;
  float shares_seen_ = 0;
  std::size_t sample_ = 0;                        // the current one of those that are being rendered
  ShadowRays shadow_rays_;                        // not yet followed,
  std::vector<Claim> claims_;                     // and whose they are
  std::vector<Spectrum> transmittance_, direct_;  // of the shadow rays; what they brought to each sample
  RenderCounts counts_;
};

}  // namespace brume

// Integrator "reference": volumetric path tracing as the textbooks have it, without bias and without cleverness. It is
// what every faster estimator is tested against.
//
// From the camera on, a path flies to its next collision with a medium or to a surface, gathers there the light that
// arrives directly (next-event estimation), and goes on in a direction drawn from the phase function or the surface.
// Flight is delta tracking: tentative collisions come at the rate of a majorant, a constant that bounds the extinction
// of all media together, and each is real with probability sigma_t / majorant, else null. Transmittance towards lights
// is ratio tracking: the product of (1 - sigma_t / majorant) over tentative collisions, and exact through homogeneous
// media. Where extinction depends on the channel, one path serves all channels: the chance of a real collision is the
// mean over channels weighted by the path's throughput, and each channel's throughput is corrected by the ratio of its
// own coefficient to that mean, so weights stay bounded. Light with an extent is found both by next-event estimation,
// of one light chosen by power, and by flights that meet it; the balance heuristic weighs the two. Sources: E. Woodcock
// et al., "Techniques used in the GEM code", ANL-7050, 1965 (delta tracking); J. Novak et al., "Residual Ratio
// Tracking", TOG 33(6), 2014 (ratio tracking); P. Kutz et al., "Spectral and Decomposition Tracking", TOG 36(4), 2017
// (history-aware channels); B. Miller et al., "A null-scattering path integral formulation of light transport", TOG
// 38(4), 2019; E. Veach, PhD thesis, 1997, sections 9.2 and 10.4 (balance heuristic, roulette).
#pragma once

#include <vector>

#include "image/film.h"
#include "render/lights.h"
#include "render/media_along_ray.h"
#include "render/render_counts.h"

namespace brume {

// One to each worker: it keeps its arrays from sample to sample.
class ReferenceIntegrator {
 public:
  ReferenceIntegrator(const CompiledScene& scene, const Intersector& intersector, const MediaAlongRay& media)
      : scene_(scene), intersector_(intersector), media_(media), emission_fields_(emission_fields(scene)) {}

  // The radiance that arrives at the ray's origin; `seen` gets what the ray meets, its depth along the ray.
  Spectrum radiance(Ray ray, RandomStream& random, Foreground& seen);

  // A place where more than max_active_media media overlap, once a ray has met one.
  std::optional<kernel::vec3> too_many_media() const { return too_many_media_; }
  const RenderCounts& counts() const { return counts_; }

 private:
  struct Collision {
    kernel::vec3 position;
    int medium;
  };
  // How a flight began: the density of its direction, 0 at the camera and after mirrors and smooth glass; and from what
  // (see lit_side).
  struct Departure {
    float pdf = 0;
    bool from_surface = false;
    kernel::vec3 normal{0, 0, 0};
  };

  bool fly(const Ray& ray, RandomStream& random, Spectrum& throughput, Spectrum& emitted, Collision& collision);
  Spectrum transmittance(const Ray& ray, RandomStream& random);
  Spectrum light_met(const Ray& ray, const SurfaceHit* hit, const Departure& departure) const;
  template <class Scatter>
  Spectrum direct_light(kernel::vec3 p, const SurfaceHit* hit, RandomStream& random, Scatter scatter);
  template <class Visit>
  void tentative_collisions(bool grids_only, RandomStream& random, Visit visit);
  float density(const MediumSpan& span, float t);
  Spectrum emission_at_density_1(const MediumSpan& span, float t) const;

  const CompiledScene& scene_;
  const Intersector& intersector_;
  const MediaAlongRay& media_;
  const std::vector<kernel::EmissionField> emission_fields_;
  std::optional<kernel::vec3> too_many_media_;
  RenderCounts counts_;

  std::vector<MediumSpan> spans_, active_;  // along the current ray; those that cover the current stretch
  std::vector<float> cuts_;                 // where the set of media changes
  std::vector<Crossing> crossings_;
};

}  // namespace brume

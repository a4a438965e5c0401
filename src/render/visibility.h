// What of a light's radiance arrives: nothing behind an opaque surface, exp(-tau) through media, and Fresnel's share
// through glass, which is crossed straight on.
#pragma once

#include <span>
#include <vector>

#include "render/density.h"
#include "render/media_along_ray.h"
#include "render/random_stream.h"

namespace brume {

// The step of ray marching through a medium, in world units: the integrator's, or where it has none half the smallest
// edge of the grid's voxels, or for a homogeneous medium 1/64 of the chord.
float march_step(const CompiledScene& scene, const CompiledMedium& medium, float chord);

// Shadow rays to be followed together. What comes of one depends on it alone.
struct ShadowRays {
  std::vector<Ray> rays;
  std::vector<std::uint32_t> keys;  // of each one's own random numbers
  std::vector<std::uint8_t> crosses_media;
  std::size_t size() const { return rays.size(); }
  void clear();
  void add(const Ray& ray, std::uint32_t key, bool through_media = true);
};

// Follows shadow rays. One to each worker: it keeps its arrays from call to call.
class Visibility {
 public:
  Visibility(const CompiledScene& scene, const Intersector& intersector, const MediaAlongRay& media);

  // transmittance[i] = the fraction of the light that crosses ray i, per channel: what surfaces leave, and of that what
  // media leave of rays that cross media.
  void find(const ShadowRays& rays, std::vector<Spectrum>& transmittance);

  // The second part of that, where transmittance[i] is not 0 already.
  void cross_media(const ShadowRays& rays, std::span<Spectrum> transmittance);

  // A place where more than max_active_media media overlap, once a ray has met one.
  std::optional<kernel::vec3> too_many_media() const { return too_many_media_; }

 private:
  Spectrum cross_glass(Ray ray) const;
  void add_optical_depths(int medium_index, std::span<const MediumSpan> spans, const ShadowRays& rays);

  const CompiledScene& scene_;
  const Intersector& intersector_;
  const MediaAlongRay& media_;
  std::optional<kernel::vec3> too_many_media_;
  const bool has_glass_;  // shadow rays pass through some surface

  std::vector<std::uint8_t> blocked_;
  std::vector<Ray> open_rays_;
  std::vector<std::size_t> open_indices_;  // of the open rays
  std::vector<MediumSpan> spans_;
  std::vector<Crossing> crossings_;
  std::vector<Spectrum> optical_depth_;  // of the open rays
  DensityStretches stretches_;
  std::vector<float> integral_;
};

}  // namespace brume

// Cut-outs: surfaces that a share of the rays pass.
#pragma once

#include "intersect/textures.h"

namespace brume {

// Whether a ray passes a hit, as it does with the chance 1 - alpha: decided by a hash of both, so that a ray meets the
// same surfaces whenever it is asked about. Unbiased over rays that differ.
// Source: M. Pharr, W. Jakob and G. Humphreys, Physically Based Rendering, 4th ed., 2023, section 7.1.1.
inline bool passes(const CompiledScene& scene, const Ray& ray, const SurfaceHit& hit) {
  const std::int32_t alpha = scene.shapes[static_cast<std::size_t>(hit.shape)].alpha;
  if (alpha < 0) return false;
  const auto hash = [](kernel::vec3 v, std::uint32_t rest) {
    return kernel::random_bits(kernel::float_bits(v.x), kernel::float_bits(v.y), kernel::float_bits(v.z), rest);
  };
  const std::uint32_t bits = hash(ray.origin, hash(ray.direction, kernel::float_bits(hit.t)));
  return kernel::uniform_from_bits(bits) >= texture_reflectance(scene, alpha, hit)[0];
}

}  // namespace brume

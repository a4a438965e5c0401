// Where paths go on from: by the phase function or the material, or aimed at a point light that shines within a medium.
// Flights that pass such a light closely gather much of its light (kernel/directions.inl), which without aim is met
// seldom and then all at once.
#pragma once

#include <algorithm>
#include <vector>

#include "compiled/compiled_scene.h"
#include "kernel/scalar.h"
#include "render/media_along_ray.h"

namespace brume {

struct AimedLight {
  kernel::vec3 position;
  // Of its light, scattered once towards a point at distance 1: the radiance there, as a mean over all directions. It
  // falls as the inverse of the distance.
  float strength = 0;
};

// A path is aimed with a chance that grows with the share of the lights in what there is to be seen: `most` where there
// is nothing else.
struct Aim {
  static constexpr float most = 0.5f;
  std::vector<AimedLight> lights;
  float elsewhere = 0;  // radiance that comes from everywhere, about
};

// The point lights of the scene within media.
Aim make_aim(const CompiledScene& scene, const MediaAlongRay& media);

// The choice at the point p. density(direction) is the density, per steradian, of directions that are not aimed.
template <class Density>
class AimFrom {
 public:
  AimFrom(const Aim& aim, kernel::vec3 p, Density density) : aim_(aim), p_(p), density_(density) {
    float strength = 0;
    for (const AimedLight& light : aim.lights) strength += strength_of(light);
    if (strength > 0) scale_ = Aim::most / (strength + aim.elsewhere);
    chance_ = scale_ * strength;
  }

  float chance() const { return chance_; }

  // Of all directions, aimed or not, where `unaimed` is density(direction).
  float density(kernel::vec3 direction, float unaimed) const {
    float sum = (1 - chance_) * unaimed;
    if (chance_ > 0)
      for (const AimedLight& light : aim_.lights)
        sum += scale_ * strength_of(light) * kernel::aimed_density(normalize(light.position - p_), direction);
    return sum;
  }

  // An aimed direction, for u in [0, chance()) and turns in [0, 1).
  kernel::vec3 draw(float u, float turns) const {
    kernel::vec3 direction{0, 0, 1};
    for (const AimedLight& light : aim_.lights) {
      const float chance = scale_ * strength_of(light);
      if (!(chance > 0)) continue;
      direction = kernel::aimed_direction(normalize(light.position - p_), std::min(u / chance, 1.0f), turns);
      if (u < chance) break;
      u -= chance;
    }
    return direction;
  }

 private:
  // The more paths go towards the light anyway, the more of its light they gather.
  float strength_of(const AimedLight& light) const {
    const kernel::vec3 to_light = light.position - p_;
    const float distance = std::max(length(to_light), 1e-20f);
    return kernel::aimed_strength(light.strength, distance, density_((1 / distance) * to_light));
  }

  const Aim& aim_;
  kernel::vec3 p_;
  Density density_;
  float scale_ = 0, chance_ = 0;
};

}  // namespace brume

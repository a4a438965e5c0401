// The lights that shadow rays of volpath choose from.
#pragma once

#include <functional>
#include <vector>

#include "compiled/compiled_scene.h"

namespace brume {

// A light that is a point or a direction.
struct DeltaLight {
  bool is_point;   // else distant
  float place[3];  // the point, or the direction towards the light
  float value[3];  // intensity, or irradiance of a facing surface
  LightCone cone;  // of a point
  float pick[2];   // chosen for numbers in [pick[0], pick[1])
};

// Lights that shadow rays go to, each with a chance in proportion to its power.
struct LightTable {
  std::vector<DeltaLight> delta_lights;  // the first of `lights`
  std::vector<int> lights;
  std::vector<float> cdf;     // of `lights`
  std::vector<float> chance;  // by light of the scene; 0 for those that are not in the table
  float total = 0;            // of the chances that they have among all lights of the scene

  // The light for u in [0, 1), below 0 where there is none.
  int pick(float u) const;
};

// Of the lights for which is_in(light).
LightTable make_light_table(const CompiledScene& scene, const std::function<bool(const CompiledLight&)>& is_in);

}  // namespace brume

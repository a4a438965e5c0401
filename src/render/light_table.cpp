#include "render/light_table.h"

#include <algorithm>

namespace brume {

LightTable make_light_table(const CompiledScene& scene, const std::function<bool(const CompiledLight&)>& is_in) {
  using Kind = CompiledLight::Kind;
  const auto is_delta = [](const CompiledLight& l) { return l.kind == Kind::point || l.kind == Kind::distant; };
  LightTable table;
  table.chance.assign(scene.lights.size(), 0);
  for (const bool delta : {true, false})
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
      const CompiledLight& light = scene.lights[i];
      if (!is_in(light) || is_delta(light) != delta || !(light.chance > 0)) continue;
      table.lights.push_back(static_cast<int>(i));
      table.total += light.chance;
    }
  float cumulated = 0;
  for (const int i : table.lights) {
    const CompiledLight& light = scene.lights[static_cast<std::size_t>(i)];
    const float begin = table.cdf.empty() ? 0 : table.cdf.back();
    cumulated += light.chance / table.total;
    table.cdf.push_back(i == table.lights.back() ? 1 : std::min(cumulated, 1.0f));
    table.chance[static_cast<std::size_t>(i)] = table.cdf.back() - begin;
    if (!is_delta(light)) continue;
    const bool is_point = light.kind == Kind::point;
    const Vector3& place = is_point ? light.position : light.direction_to;
    table.delta_lights.push_back(
        {is_point,
         {static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.z)},
         {light.value[0], light.value[1], light.value[2]},
         light.cone,
         {begin, table.cdf.back()}});
  }
  return table;
}

int LightTable::pick(float u) const {
  if (lights.empty()) return -1;
  return lights[static_cast<std::size_t>(std::upper_bound(cdf.begin(), cdf.end() - 1, u) - cdf.begin())];
}

}  // namespace brume

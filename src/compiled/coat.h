// How much light the coat of a coated material lets in.
#pragma once

#include <algorithm>

#include "base/fresnel.h"
#include "compiled/compiled_scene.h"

namespace brume {

// Of light that meets it at this cosine to the normal. The rest it reflects.
inline float coat_transmittance(const CompiledMaterial& m, float cosine) {
  if (m.alpha == 0) {
    float refracted_cosine = 0;
    return 1 - fresnel_dielectric(cosine, m.refractive_index, refracted_cosine);
  }
  const auto& table = m.coat_transmittance;
  const float place = std::clamp(cosine, 0.0f, 1.0f) * static_cast<float>(table.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), table.size() - 2);
  return table[i] + (place - static_cast<float>(i)) * (table[i + 1] - table[i]);
}

}  // namespace brume

// Media whose coefficients were measured.
#pragma once

#include <string_view>
#include <vector>

#include "base/spectrum.h"

namespace brume {

// Per millimetre, in Rec.709. sigma_s is the reduced scattering coefficient: with a phase function of mean cosine g it
// stands for sigma_s (1 - g).
struct MediumPreset {
  std::string_view name;
  Spectrum sigma_s, sigma_a;
};

// pbrt's.
//
// Sources: H. W. Jensen et al., "A Practical Model for Subsurface Light Transport", SIGGRAPH 2001 (the first twelve);
// S. G. Narasimhan et al., "Acquiring Scattering Properties of Participating Media by Dilution", TOG 25(3), 2006.
const std::vector<MediumPreset>& medium_presets();

}  // namespace brume

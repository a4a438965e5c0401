// What a film makes of radiance: exposure, white balance, the colour space of the picture, and a limit.
#pragma once

#include <algorithm>
#include <limits>

#include "base/colour_space.h"
#include "base/spectrum.h"

namespace brume {

struct FilmResponse {
  Matrix3 matrix;                                                // from Rec.709 radiance to the picture's RGB
  float max_component = std::numeric_limits<float>::infinity();  // of a sample; larger ones are scaled down to it

  Spectrum operator()(const Spectrum& radiance) const {
    static_assert(channel_count == 3, "other spectra need a conversion to red, green and blue here");
    Spectrum rgb = radiance;
    if (matrix != Matrix3()) {
      const Vector3 v = matrix * Vector3{static_cast<double>(radiance[0]), static_cast<double>(radiance[1]),
                                         static_cast<double>(radiance[2])};
      for (int c = 0; c < channel_count; ++c) rgb[c] = static_cast<float>(v[c]);
    }
    const float largest = max_value(rgb);
    return largest > max_component ? (max_component / largest) * rgb : rgb;
  }
};

}  // namespace brume

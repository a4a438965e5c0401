// The pixel filter that a scene asks for. image/filter.h draws from it.
#pragma once

namespace brume {

struct PixelFilter {
  enum class Kind { box, gaussian, mitchell, triangle, sinc } kind = Kind::gaussian;
  float x_radius = 1.5f, y_radius = 1.5f;  // pixels, > 0
  float sigma = 0.5f;                      // gaussian: pixels
  float b = 1 / 3.0f, c = 1 / 3.0f;        // mitchell, in [0, 1]
  float tau = 3;                           // sinc: the Lanczos window's half-width, pixels
  bool operator==(const PixelFilter&) const = default;
};

}  // namespace brume

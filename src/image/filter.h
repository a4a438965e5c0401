// Pixel filters, importance-sampled: a sample's place in its pixel is drawn from the filter, so its weight is 1.
#pragma once

#include <vector>

namespace brume {

enum class FilterKind { box, gaussian };

class Filter {
 public:
  // Radii in pixels, > 0; sigma in pixels for the gaussian, which is pbrt's: exp(-x^2 / (2 sigma^2)) less its value at
  // the radius, a product over x and y.
  Filter(FilterKind kind, float x_radius, float y_radius, float sigma);

  // The offset from the pixel's centre, in pixels, for two numbers in [0, 1).
  float sample_x(float u) const;
  float sample_y(float u) const;

 private:
  float x_radius_, y_radius_;
  // Quantile tables of the gaussian's two factors (filter.cpp says how they are indexed); empty for box.
  std::vector<float> x_quantile_, y_quantile_;
};

}  // namespace brume

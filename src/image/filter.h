// Pixel filters, importance-sampled: a sample's place is drawn from the filter's absolute value, and its weight carries
// the sign. So each sample belongs to one pixel.
#pragma once

#include <vector>

#include "base/pixel_filter.h"

namespace brume {

// One factor of a filter, an even function of the distance from the pixel's centre:
//   box       1
//   gaussian  exp(-x^2 / (2 sigma^2)) less its value at the radius
//   triangle  radius - |x|
//   mitchell  the cubics of D. Mitchell and A. Netravali, "Reconstruction Filters in Computer Graphics", SIGGRAPH 1988,
//             equation 8, which change at half the radius and end at the radius
//   sinc      sin(pi x) / (pi x) in Lanczos' window sin(pi x / tau) / (pi x / tau)
// The shapes are pbrt's.
class FilterAxis {
 public:
  FilterAxis(const PixelFilter& shape, float radius);

  struct Sample {
    float offset;  // pixels
    float weight;  // its mean is 1; each is 1 where the filter is nowhere negative
  };
  // For u in [0, 1).
  Sample sample(float u) const;

 private:
  // One of equal parts of [0, radius], in which |f| is taken to be linear. |f| is scaled so that the integral over
  // [0, radius] is 1 where the width of a cell is.
  struct Cell {
    float below;       // the integral of |f| up to here
    float begin, end;  // |f|
    float sign;
  };

  // f of the distance in units of the radius.
  template <class Function>
  void tabulate(int cells, Function f);
  Sample sample_cells(float p) const;

  float radius_;
  float weight_ = 1;              // the integral of |f| over that of f
  std::vector<float> quantiles_;  // gaussian and triangle (filter.cpp says how they are indexed), else empty
  std::vector<Cell> cells_;       // mitchell and sinc, else empty
};

struct FilterSample {
  float x, y;  // from the pixel's centre, in pixels
  float weight;
};

// The product of a factor in x and one in y.
class Filter {
 public:
  explicit Filter(const PixelFilter& shape) : x_(shape, shape.x_radius), y_(shape, shape.y_radius) {}

  // For two numbers in [0, 1).
  FilterSample sample(float u, float v) const {
    const FilterAxis::Sample x = x_.sample(u), y = y_.sample(v);
    return {x.offset, y.offset, x.weight * y.weight};
  }

 private:
  FilterAxis x_, y_;
};

}  // namespace brume

#include "image/filter.h"

#include <cmath>
#include <numbers>

namespace brume {

namespace {

// The filter falls linearly to 0 at its radius, so its quantile goes there as the square root of the probability
// beyond. The table is therefore indexed by v = sqrt(2 p), p in [0, 1/2] the probability of lying farther out on one
// side: against v the quantile is smooth. Linear interpolation between steps of 1 / 1024 is then off by at most 3e-6 of
// the radius where that is 3 sigma, as it is by default, and by 2e-4 where it is 5 sigma.
constexpr int steps = 1024;

// The integral from x to the radius of exp(-t^2 / (2 sigma^2)) - exp(-radius^2 / (2 sigma^2)), x >= 0.
double tail(double x, double radius, double sigma) {
  const double s = sigma * std::numbers::sqrt2;
  const double gaussian = sigma * std::sqrt(std::numbers::pi / 2) * (std::erfc(x / s) - std::erfc(radius / s));
  return gaussian - (radius - x) * std::exp(-0.5 * (radius / sigma) * (radius / sigma));
}

// Distances from the centre for v = 0, 1/1024, ..., 1, by bisection of the tail's probability v^2 / 2.
std::vector<float> quantile_table(double radius, double sigma) {
  const double half = tail(0, radius, sigma);
  std::vector<float> table;
  for (int i = 0; i <= steps; ++i) {
    const double v = static_cast<double>(i) / steps;
    double lo = 0, hi = radius;
    for (int halvings = 0; halvings < 60; ++halvings) {
      const double middle = 0.5 * (lo + hi);
      (tail(middle, radius, sigma) > v * v * half ? lo : hi) = middle;
    }
    table.push_back(static_cast<float>(0.5 * (lo + hi)));
  }
  return table;
}

float sample(float u, float radius, const std::vector<float>& quantile) {
  if (quantile.empty()) return (2 * u - 1) * radius;
  const bool left = u < 0.5f;
  const float at = std::sqrt(left ? 2 * u : 2 - 2 * u) * steps;
  const int step = at < steps ? static_cast<int>(at) : steps - 1;
  const float inner = quantile[static_cast<std::size_t>(step) + 1], outer = quantile[static_cast<std::size_t>(step)];
  const float distance = outer + (at - static_cast<float>(step)) * (inner - outer);
  return left ? -distance : distance;
}

}  // namespace

Filter::Filter(FilterKind kind, float x_radius, float y_radius, float sigma)
    : x_radius_(x_radius), y_radius_(y_radius) {
  if (kind == FilterKind::box) return;
  x_quantile_ = quantile_table(x_radius, sigma);
  y_quantile_ = quantile_table(y_radius, sigma);
}

float Filter::sample_x(float u) const { return sample(u, x_radius_, x_quantile_); }
float Filter::sample_y(float u) const { return sample(u, y_radius_, y_quantile_); }

}  // namespace brume

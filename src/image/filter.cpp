#include "image/filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brume {

namespace {

// A gaussian falls linearly to 0 at its radius, so its quantile goes there as the square root of the probability
// beyond. The table is therefore indexed by v = sqrt(2 p), p in [0, 1/2] the probability of lying farther out on one
// side: against v the quantile is smooth. Linear interpolation between steps of 1 / 1024 is then off by at most 3e-6 of
// the radius where that is 3 sigma, as it is by default, and by 2e-4 where it is 5 sigma. A triangle's quantile is
// linear in v.
constexpr int gaussian_steps = 1024;

// The integral from x to the radius of exp(-t^2 / (2 sigma^2)) - exp(-radius^2 / (2 sigma^2)), x >= 0.
double tail(double x, double radius, double sigma) {
  const double s = sigma * std::numbers::sqrt2;
  const double gaussian = sigma * std::sqrt(std::numbers::pi / 2) * (std::erfc(x / s) - std::erfc(radius / s));
  return gaussian - (radius - x) * std::exp(-0.5 * (radius / sigma) * (radius / sigma));
}

// Distances from the centre for v = 0, 1/1024, ..., 1, by bisection of the tail's probability v^2 / 2.
std::vector<float> gaussian_quantiles(double radius, double sigma) {
  const double half = tail(0, radius, sigma);
  std::vector<float> table;
  for (int i = 0; i <= gaussian_steps; ++i) {
    const double v = static_cast<double>(i) / gaussian_steps;
    double lo = 0, hi = radius;
    for (int halvings = 0; halvings < 60; ++halvings) {
      const double middle = 0.5 * (lo + hi);
      (tail(middle, radius, sigma) > v * v * half ? lo : hi) = middle;
    }
    table.push_back(static_cast<float>(0.5 * (lo + hi)));
  }
  return table;
}

float quantile(const std::vector<float>& table, float u) {
  const int steps = static_cast<int>(table.size()) - 1;
  const bool left = u < 0.5f;
  const float at = std::sqrt(left ? 2 * u : 2 - 2 * u) * static_cast<float>(steps);
  const int step = std::min(static_cast<int>(at), steps - 1);
  const float inner = table[static_cast<std::size_t>(step) + 1], outer = table[static_cast<std::size_t>(step)];
  const float distance = outer + (at - static_cast<float>(step)) * (inner - outer);
  return left ? -distance : distance;
}

// x in units of half the radius.
double mitchell(double x, double b, double c) {
  if (x < 1) return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b)) / 6;
  return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) / 6;
}

double sinc(double x) {
  const double a = std::numbers::pi * x;
  return a < 1e-5 ? 1 : std::sin(a) / a;
}

// Where the filter has negative lobes: this many cells, or 64 for each pixel and each lobe where that is more.
constexpr int least_cells = 512;

int sinc_cells(double radius, double tau) {
  return std::max(least_cells, static_cast<int>(std::ceil(64 * radius * std::max(1.0, 1 / tau))));
}

}  // namespace

FilterAxis::FilterAxis(const PixelFilter& shape, float radius) : radius_(radius) {
  const double r = radius, b = shape.b, c = shape.c, tau = shape.tau;
  switch (shape.kind) {
    case PixelFilter::Kind::box:
      break;
    case PixelFilter::Kind::gaussian:
      quantiles_ = gaussian_quantiles(r, shape.sigma);
      break;
    case PixelFilter::Kind::triangle:
      quantiles_ = {radius, 0};
      break;
    case PixelFilter::Kind::mitchell:
      tabulate(least_cells, [&](double x) { return mitchell(2 * x, b, c); });
      break;
    case PixelFilter::Kind::sinc:
      tabulate(sinc_cells(r, tau), [&](double x) { return sinc(x * r) * sinc(x * r / tau); });
      break;
  }
}

template <class Function>
void FilterAxis::tabulate(int cells, Function f) {
  const auto height = [&](int i) { return std::abs(f(static_cast<double>(i) / cells)); };
  const auto mass = [&](int i) { return 0.5 * (height(i) + height(i + 1)); };
  const auto sign = [&](int i) { return f((i + 0.5) / cells) < 0 ? -1 : 1; };
  double total = 0, net = 0;
  for (int i = 0; i < cells; ++i) {
    total += mass(i);
    net += sign(i) * mass(i);
  }
  double below = 0;
  for (int i = 0; i < cells; ++i) {
    cells_.push_back({static_cast<float>(below / total), static_cast<float>(height(i) / total),
                      static_cast<float>(height(i + 1) / total), static_cast<float>(sign(i))});
    below += mass(i);
  }
  weight_ = static_cast<float>(total / net);
}

// At the distance below which the part p of the integral of |f| lies.
FilterAxis::Sample FilterAxis::sample_cells(float p) const {
  const auto above =
      std::upper_bound(cells_.begin() + 1, cells_.end(), p, [](float v, const Cell& c) { return v < c.below; });
  const Cell& cell = *(above - 1);
  // The root t of begin t + (end - begin) t^2 / 2 = p - below.
  const float rest = p - cell.below, slope = cell.end - cell.begin;
  const float divisor = cell.begin + std::sqrt(std::max(0.0f, cell.begin * cell.begin + 2 * slope * rest));
  const float t = divisor > 0 ? std::min(2 * rest / divisor, 1.0f) : 0;
  const float cells_inside = static_cast<float>(above - 1 - cells_.begin()) + t;
  return {cells_inside / static_cast<float>(cells_.size()) * radius_, cell.sign * weight_};
}

FilterAxis::Sample FilterAxis::sample(float u) const {
  if (!quantiles_.empty()) return {quantile(quantiles_, u), 1};
  if (cells_.empty()) return {(2 * u - 1) * radius_, 1};
  if (u >= 0.5f) return sample_cells(2 * u - 1);
  const Sample mirrored = sample_cells(1 - 2 * u);
  return {-mirrored.offset, mirrored.weight};
}

}  // namespace brume

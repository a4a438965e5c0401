// The places that a filter draws are distributed as the filter: Pearson's chi-squared test against the filter
// integrated over 100 bins, with a twin whose quantile table is laid out wrongly.
#include "image/filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "kernel/scalar.h"
#include "kernel/statistics.h"

namespace brume {
namespace {

constexpr int bins = 100, samples = 1'000'000;

using Density = std::function<double(double)>;

Density gaussian(double radius, double sigma) {
  return [=](double x) {
    return std::exp(-0.5 * x * x / (sigma * sigma)) - std::exp(-0.5 * radius * radius / (sigma * sigma));
  };
}

// Simpson's rule.
double integral(const Density& f, double a, double b) {
  constexpr int intervals = 32;
  const double h = (b - a) / intervals;
  double sum = f(a) + f(b);
  for (int i = 1; i < intervals; ++i) sum += (i % 2 ? 4 : 2) * f(a + i * h);
  return sum * h / 3;
}

std::vector<double> bin_probabilities(const Density& f, double radius) {
  std::vector<double> p;
  double total = 0;
  for (int i = 0; i < bins; ++i) {
    p.push_back(integral(f, radius * (2.0 * i / bins - 1), radius * (2.0 * (i + 1) / bins - 1)));
    total += p.back();
  }
  for (double& x : p) x /= total;
  return p;
}

double p_value(const std::vector<double>& counts, const std::vector<double>& probabilities) {
  return chi_squared_p_value(chi_squared(counts, probabilities, samples), bins - 1);
}

std::vector<double> histogram(const std::function<float(float)>& draw, double radius, std::uint32_t seed) {
  std::vector<double> counts(bins);
  for (std::uint32_t i = 0; i < samples; ++i) {
    const double x = static_cast<double>(draw(kernel::random_uniform(seed, 0, i, 0)));
    EXPECT_LE(std::abs(x), radius);
    const int bin = static_cast<int>(std::floor((x / radius + 1) / 2 * bins));
    ++counts[static_cast<std::size_t>(std::clamp(bin, 0, bins - 1))];
  }
  return counts;
}

struct Case {
  std::string name;
  Filter filter;
  double x_radius, y_radius;
  Density x_density, y_density;
};

std::vector<Case> cases() {
  const Density constant = [](double) { return 1.0; };
  return {
      {"box", Filter(FilterKind::box, 0.5f, 1, 0), 0.5, 1, constant, constant},
      {"gaussian", Filter(FilterKind::gaussian, 1.5f, 1.5f, 0.5f), 1.5, 1.5, gaussian(1.5, 0.5), gaussian(1.5, 0.5)},
      {"wide gaussian", Filter(FilterKind::gaussian, 2, 1, 1.5f), 2, 1, gaussian(2, 1.5), gaussian(1, 1.5)},
  };
}

TEST(Filter, IsDistributedAsItsDensity) {
  const double threshold = sidak(0.01, 6);
  for (const Case& c : cases()) {
    const auto x = histogram([&](float u) { return c.filter.sample_x(u); }, c.x_radius, 11);
    const auto y = histogram([&](float u) { return c.filter.sample_y(u); }, c.y_radius, 12);
    EXPECT_GT(p_value(x, bin_probabilities(c.x_density, c.x_radius)), threshold) << c.name;
    EXPECT_GT(p_value(y, bin_probabilities(c.y_density, c.y_radius)), threshold) << c.name;
  }
}

// The fault: quantiles on 1024 equal steps of u, linear between. It makes the first and last step, an eighth of the
// radius wide each, flat.
TEST(Filter, TheTestRejectsQuantilesOnEqualSteps) {
  const Density f = gaussian(1.5, 0.5);
  constexpr int steps = 1024, fine = 1 << 16;
  std::vector<double> quantile{-1.5};
  double sum = 0;
  const double total = integral(f, -1.5, 0) * 2;
  for (int i = 0; i < fine && quantile.size() < steps; ++i) {
    sum += f(-1.5 + 3 * (i + 0.5) / fine) * 3 / fine;
    if (sum >= total * static_cast<double>(quantile.size()) / steps) quantile.push_back(-1.5 + 3 * (i + 1.0) / fine);
  }
  quantile.push_back(1.5);
  const auto draw = [&](float u) {
    const double at = static_cast<double>(u) * steps;
    const auto step = static_cast<std::size_t>(at);
    return static_cast<float>(quantile[step] + (at - std::floor(at)) * (quantile[step + 1] - quantile[step]));
  };
  const auto counts = histogram(draw, 1.5, 13);
  const auto probabilities = bin_probabilities(f, 1.5);
  EXPECT_LT(p_value(counts, probabilities), sidak(0.01, 6));
  EXPECT_GT(chi_squared(counts, probabilities, samples) - (bins - 1), 100);
}

TEST(Filter, QuantilesAreMonotonicAndSymmetric) {
  const Filter filter(FilterKind::gaussian, 1.5f, 1.5f, 0.5f);
  float last = -1.5f;
  for (int i = 0; i < 4096; ++i) {
    const float u = static_cast<float>(i) / 4096, x = filter.sample_x(u);
    EXPECT_GE(x, last);
    if (i > 0) {
      EXPECT_NEAR(x, -filter.sample_x(1 - u), 1e-6f);
    }
    last = x;
  }
  EXPECT_EQ(filter.sample_x(0), -1.5f);
  EXPECT_NEAR(filter.sample_x(0.5f), 0, 1e-6f);
}

TEST(Filter, ExtremeShapesStayFinite) {
  for (const float sigma : {1e-20f, 1e-3f, 32.0f})
    for (const float radius : {1e-10f, 0.5f, 32.0f}) {
      const Filter filter(FilterKind::gaussian, radius, radius, sigma);
      for (int i = 0; i < 64; ++i) EXPECT_LE(std::abs(filter.sample_x(static_cast<float>(i) / 64)), radius);
    }
}

}  // namespace
}  // namespace brume

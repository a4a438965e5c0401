// The places that a filter draws are distributed as the filter's absolute value: Pearson's chi-squared test against it
// integrated over 100 bins, with a twin whose quantile table is laid out wrongly. Their weights have the mean 1 and
// give the filter's second moment, negative lobes included, with a twin whose weights have no sign.
#include "image/filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
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

// Of |f|.
std::vector<double> bin_probabilities(const Density& signed_density, double radius) {
  const Density f = [&](double x) { return std::abs(signed_density(x)); };
  std::vector<double> p;
  double total = 0;
  for (int i = 0; i < bins; ++i) {
    p.push_back(integral(f, radius * (2.0 * i / bins - 1), radius * (2.0 * (i + 1) / bins - 1)));
    total += p.back();
  }
  for (double& x : p) x /= total;
  return p;
}

Density triangle(double radius) {
  return [=](double x) { return radius - std::abs(x); };
}

Density mitchell(double radius, double b, double c) {
  return [=](double at) {
    const double x = 2 * std::abs(at) / radius, x2 = x * x, x3 = x2 * x;
    if (x < 1) return (12 - 9 * b - 6 * c) * x3 + (-18 + 12 * b + 6 * c) * x2 + 6 - 2 * b;
    return (-b - 6 * c) * x3 + (6 * b + 30 * c) * x2 + (-12 * b - 48 * c) * x + 8 * b + 24 * c;
  };
}

Density sinc(double tau) {
  const auto one = [](double x) { return x == 0 ? 1.0 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x); };
  return [=](double x) { return one(x) * one(x / tau); };
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
  PixelFilter shape;
  Density x_density, y_density;
};

std::vector<Case> cases() {
  using Kind = PixelFilter::Kind;
  const Density constant = [](double) { return 1.0; };
  return {
      {"box", {Kind::box, 0.5f, 1}, constant, constant},
      {"gaussian", {Kind::gaussian, 1.5f, 1.5f, 0.5f}, gaussian(1.5, 0.5), gaussian(1.5, 0.5)},
      {"wide gaussian", {Kind::gaussian, 2, 1, 1.5f}, gaussian(2, 1.5), gaussian(1, 1.5)},
      {"triangle", {Kind::triangle, 2, 0.5f}, triangle(2), triangle(0.5)},
      {"mitchell", {Kind::mitchell, 2, 3}, mitchell(2, 1.0 / 3, 1.0 / 3), mitchell(3, 1.0 / 3, 1.0 / 3)},
      {"b-spline", {Kind::mitchell, 2, 2, 0, 1, 0}, mitchell(2, 1, 0), mitchell(2, 1, 0)},
      {"sharp mitchell", {Kind::mitchell, 2, 2, 0, 0, 1}, mitchell(2, 0, 1), mitchell(2, 0, 1)},
      {"sinc", {Kind::sinc, 4, 4, 0, 0, 0, 3}, sinc(3), sinc(3)},
      {"wide sinc", {Kind::sinc, 10, 2.5f, 0, 0, 0, 0.7f}, sinc(0.7), sinc(0.7)},
  };
}

TEST(Filter, IsDistributedAsItsAbsoluteValue) {
  const double threshold = sidak(0.01, 2 * static_cast<int>(cases().size()));
  for (const Case& c : cases()) {
    const Filter filter(c.shape);
    const auto x = histogram([&](float u) { return filter.sample(u, 0).x; }, c.shape.x_radius, 11);
    const auto y = histogram([&](float u) { return filter.sample(0, u).y; }, c.shape.y_radius, 12);
    EXPECT_GT(p_value(x, bin_probabilities(c.x_density, c.shape.x_radius)), threshold) << c.name;
    EXPECT_GT(p_value(y, bin_probabilities(c.y_density, c.shape.y_radius)), threshold) << c.name;
  }
}

// The mean of weight x^2 over the filter, by the midpoints of equal parts of u; and the mean weight.
struct Moments {
  double weight = 0, second = 0;
};
Moments moments(const FilterAxis& axis) {
  constexpr int parts = 1 << 20;
  Moments m;
  for (int i = 0; i < parts; ++i) {
    const FilterAxis::Sample s = axis.sample((static_cast<float>(i) + 0.5f) / parts);
    m.weight += static_cast<double>(s.weight) / parts;
    m.second += static_cast<double>(s.weight) * s.offset * s.offset / parts;
  }
  return m;
}

double second_moment(const Density& f, double radius) {
  double sum = 0, total = 0;
  for (int i = 0; i < 1000; ++i) {
    const double a = radius * i / 1000, b = radius * (i + 1) / 1000;
    sum += integral([&](double x) { return f(x) * x * x; }, a, b);
    total += integral(f, a, b);
  }
  return sum / total;
}

constexpr double moment_tolerance = 1e-3;  // of the radius squared

TEST(Filter, WeightsHaveMeanOneAndGiveTheSecondMoment) {
  for (const Case& c : cases()) {
    const double radius = c.shape.x_radius;
    const Moments m = moments(FilterAxis(c.shape, c.shape.x_radius));
    EXPECT_NEAR(m.weight, 1, 1e-5) << c.name;
    EXPECT_NEAR(m.second, second_moment(c.x_density, radius), moment_tolerance * radius * radius) << c.name;
  }
}

// The fault: weights without their sign.
TEST(Filter, TheTestRejectsWeightsWithoutSign) {
  for (const Case& c : cases()) {
    if (c.name != "mitchell" && c.name != "sinc") continue;
    const double radius = c.shape.x_radius;
    const Density f = c.x_density;
    const double unsigned_moment = second_moment([&](double x) { return std::abs(f(x)); }, radius);
    EXPECT_GT(std::abs(unsigned_moment - second_moment(f, radius)), 8 * moment_tolerance * radius * radius) << c.name;
  }
}

TEST(Filter, WithoutNegativeLobesEachWeightIsOne) {
  for (const Case& c : cases()) {
    if (c.shape.kind == PixelFilter::Kind::mitchell || c.shape.kind == PixelFilter::Kind::sinc) continue;
    const Filter filter(c.shape);
    for (int i = 0; i < 1024; ++i) EXPECT_EQ(filter.sample(static_cast<float>(i) / 1024, 0.3f).weight, 1) << c.name;
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

TEST(Filter, OffsetsAreMonotonicAndSymmetric) {
  for (const Case& c : cases()) {
    const FilterAxis axis(c.shape, c.shape.x_radius);
    float last = -c.shape.x_radius;
    for (int i = 0; i < 4096; ++i) {
      const float u = static_cast<float>(i) / 4096, x = axis.sample(u).offset;
      EXPECT_GE(x, last - 1e-6f) << c.name;
      if (i > 0) {
        EXPECT_NEAR(x, -axis.sample(1 - u).offset, 2e-6f) << c.name;
      }
      last = x;
    }
    EXPECT_NEAR(axis.sample(0).offset, -c.shape.x_radius, 5e-3f) << c.name;
    EXPECT_NEAR(axis.sample(0.5f).offset, 0, 1e-6f) << c.name;
  }
}

TEST(Filter, ExtremeShapesStayFinite) {
  using Kind = PixelFilter::Kind;
  for (const Kind kind : {Kind::box, Kind::gaussian, Kind::mitchell, Kind::triangle, Kind::sinc})
    for (const float width : {1e-20f, 1e-3f, 0.1f, 32.0f, 1000.0f}) {
      if (kind == Kind::gaussian ? width > 32 : width < 0.1f) continue;
      for (const float radius : {0.0f, 1e-10f, 0.5f, 32.0f}) {
        const FilterAxis axis({kind, radius, radius, width, 1, 1, width}, radius);
        for (int i = 0; i <= 64; ++i) {
          const FilterAxis::Sample s = axis.sample(std::min(static_cast<float>(i) / 64, 1 - 0x1p-24f));
          EXPECT_LE(std::abs(s.offset), radius);
          EXPECT_LE(std::abs(s.weight), 10);
        }
      }
    }
}

}  // namespace
}  // namespace brume

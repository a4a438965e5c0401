// Directions about an axis, and directions aimed at a light, are drawn with the density that they are said to have:
// Pearson's chi-squared test of 10^6 samples over cells of angle and turn. The faults this catches: a density without
// its sine, and a frame that is not orthonormal.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernel/scalar.h"
#include "kernel/statistics.h"

namespace brume {
namespace {

using kernel::vec3;

constexpr int samples = 1000000, bands = 24, sectors = 12;
constexpr double pi = std::numbers::pi;

// Axes in all octants, and at both poles of the frame.
const std::array axes{vec3(0, 0, 1), vec3(0, 0, -1), vec3(1, 0, 0), vec3(0.6f, -0.64f, 0.48f), vec3(-0.6f, 0, -0.8f)};

// A frame about the axis that owes nothing to the one under test.
std::array<vec3, 2> frame(vec3 axis) {
  const vec3 other = std::fabs(axis.x) > 0.5f ? vec3(0, 1, 0) : vec3(1, 0, 0);
  const vec3 x = normalize(cross(axis, other));
  return {x, cross(axis, x)};
}

// The p-value of aimed directions under a density that is uniform in the angle, or in its cosine: cells of equal
// probability either way.
double aimed_p_value(vec3 axis, bool by_cosine) {
  const auto [x, y] = frame(axis);
  std::vector<double> counts(bands * sectors);
  for (std::uint32_t i = 0; i < samples; ++i) {
    const auto number = [&](std::uint32_t k) { return kernel::random_uniform(9, 1, i, k); };
    const vec3 d = kernel::aimed_direction(axis, number(0), number(1));
    EXPECT_NEAR(length(d), 1, 1e-6);
    const double cosine = static_cast<double>(dot(d, axis));
    const double angle = std::atan2(static_cast<double>(length(cross(axis, d))), cosine);
    const double share = by_cosine ? (1 - cosine) / 2 : angle / pi;
    const double turn = std::atan2(static_cast<double>(dot(d, y)), static_cast<double>(dot(d, x))) / (2 * pi) + 0.5;
    const auto cell = [](double u, int n) { return std::min(static_cast<std::size_t>(u * n), std::size_t(n - 1)); };
    ++counts[cell(share, bands) * sectors + cell(turn, sectors)];
  }
  const std::vector<double> chances(counts.size(), 1.0 / static_cast<double>(counts.size()));
  return chi_squared_p_value(chi_squared(counts, chances, samples), static_cast<double>(counts.size() - 1));
}

TEST(Directions, AimedOnesAreUniformInTheirAngle) {
  for (const vec3& axis : axes) {
    EXPECT_GT(aimed_p_value(axis, false), sidak(0.01, static_cast<int>(axes.size())));
    EXPECT_LT(aimed_p_value(axis, true), 1e-6);  // the twin
  }
}

// The density over the sphere, in bands of the angle: 1/n in each, by the midpoint rule.
TEST(Directions, TheirDensityIsThatOfAUniformAngle) {
  for (const vec3& axis : axes) {
    double sum = 0;
    constexpr int n = 2000;
    for (int i = 0; i < n; ++i) {
      const double angle = pi * (i + 0.5) / n;
      const vec3 d =
          kernel::direction_about(axis, static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle)), 0.1f);
      const double density = static_cast<double>(kernel::aimed_density(axis, d));
      EXPECT_NEAR(density * 2 * pi * pi * std::sin(angle), 1, 2e-3) << angle;
      sum += density * 2 * pi * std::sin(angle) * pi / n;
    }
    EXPECT_NEAR(sum, 1, 1e-4);
  }
}

TEST(Directions, AtACosineHaveThatCosine) {
  for (const vec3& axis : axes)
    for (const float cosine : {-1.0f, -0.3f, 0.0f, 0.999f, 1.0f})
      for (const float turns : {0.0f, 0.2f, 0.7f}) {
        const vec3 d = kernel::direction_at_cosine(axis, cosine, turns);
        EXPECT_NEAR(dot(d, axis), cosine, 3e-7);
        EXPECT_NEAR(length(d), 1, 3e-7);
      }
}

}  // namespace
}  // namespace brume

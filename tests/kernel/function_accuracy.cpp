// The kernels' own functions against double precision, within the bounds that their files state.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "kernel/scalar.h"

namespace brume {
namespace {

// |value - exact| in units of the last place of `exact` as a float.
double ulps(float value, double exact) {
  int exponent = 0;
  std::frexp(exact, &exponent);
  return std::abs(value - exact) / std::ldexp(1.0, std::max(exponent - 24, -149));
}

// Calls visit(x) for every `stride`-th float from lo to hi, both positive.
template <class Visit>
void for_floats(float lo, float hi, std::uint32_t stride, Visit visit) {
  const std::uint32_t end = std::bit_cast<std::uint32_t>(hi);
  for (std::uint32_t bits = std::bit_cast<std::uint32_t>(lo); bits <= end; bits += stride)
    visit(std::bit_cast<float>(bits));
}

float random(std::uint32_t index, std::uint32_t dimension, float lo, float hi) {
  return lo + (hi - lo) * kernel::random_uniform(9, 9, index, dimension);
}

TEST(FunctionAccuracy, LogNatural) {
  double worst = 0;
  for_floats(1.17549435e-38f, 3.4e38f, 397,
             [&](float x) { worst = std::max(worst, ulps(kernel::log_natural(x), std::log(static_cast<double>(x)))); });
  for_floats(0.9f, 1.5f, 3, [&](float x) {  // where the result passes 0 and the worst error is
    worst = std::max(worst, ulps(kernel::log_natural(x), std::log(static_cast<double>(x))));
  });
  EXPECT_EQ(kernel::log_natural(1.0f), 0.0f);
  EXPECT_LE(worst, 1.0);
  EXPECT_GT(worst, 0.5);  // that the measure measures
}

TEST(FunctionAccuracy, ExpNatural) {
  double worst = 0;
  const auto check = [&](float x) {
    worst = std::max(worst, ulps(kernel::exp_natural(x), std::exp(static_cast<double>(x))));
  };
  for_floats(1e-6f, 88.0f, 101, check);
  for_floats(1e-6f, 87.3f, 101, [&](float x) { check(-x); });
  EXPECT_LE(worst, 1.1);
  EXPECT_GT(worst, 0.5);
  EXPECT_EQ(kernel::exp_natural(0.0f), 1.0f);
  EXPECT_EQ(kernel::exp_natural(-87.31f), 0.0f);
  EXPECT_EQ(kernel::exp_natural(-1e30f), 0.0f);
  EXPECT_TRUE(std::isfinite(kernel::exp_natural(1e30f)));
}

TEST(FunctionAccuracy, SincosTurns) {
  double worst = 0;
  for (std::uint32_t i = 0; i < 2000000; ++i) {
    const float range = std::array{1.0f, 30.0f, 1e5f}[i % 3];
    const float u = random(i, 0, -range, range);
    const double turns = u - std::round(static_cast<double>(u));
    float sine = 0, cosine = 0;
    kernel::sincos_turns(u, sine, cosine);
    worst = std::max({worst, std::abs(sine - std::sin(2 * std::numbers::pi * turns)),
                      std::abs(cosine - std::cos(2 * std::numbers::pi * turns))});
  }
  EXPECT_LE(worst, 1.2e-7);
  EXPECT_GT(worst, 3e-8);
}

TEST(FunctionAccuracy, AtanTurns) {
  double worst = 0;
  for_floats(1e-20f, 1e20f, 397, [&](float x) {
    const double exact = std::atan(static_cast<double>(x)) / (2 * std::numbers::pi);
    worst = std::max(
        {worst, std::abs(kernel::atan_turns(x) - exact) / exact, std::abs(kernel::atan_turns(-x) + exact) / exact});
  });
  EXPECT_LE(worst, 3e-7);
  EXPECT_GT(worst, 3e-8);
  EXPECT_EQ(kernel::atan_turns(0.0f), 0.0f);
}

TEST(FunctionAccuracy, PowPositive) {
  double worst = 0;
  for (std::uint32_t i = 0; i < 2000000; ++i) {
    const float x = std::exp2(random(i, 0, -30, 30)), y = random(i, 1, -4, 4);
    const double logarithm = y * std::log(static_cast<double>(x));
    if (std::abs(logarithm) > 86) continue;
    const double exact = std::exp(logarithm);
    worst = std::max(worst, std::abs(kernel::pow_positive(x, y) - exact) / exact / (1 + std::abs(logarithm)));
  }
  EXPECT_LE(worst, 1.3e-7);
  EXPECT_GT(worst, 3e-8);
}

TEST(FunctionAccuracy, MeanTransmittance) {
  double worst = 0;
  for_floats(1e-6f, 100.0f, 101, [&](float tau) {
    const double exact = -std::expm1(-static_cast<double>(tau)) / tau;
    worst = std::max(worst, std::abs(kernel::mean_transmittance(tau) - exact) / exact);
  });
  EXPECT_LE(worst, 2e-7);
  EXPECT_GT(worst, 3e-8);
  EXPECT_EQ(kernel::mean_transmittance(0.0f), 1.0f);
}

TEST(FunctionAccuracy, BeerLambert) {
  EXPECT_NEAR(kernel::beer_lambert(1.0f), 0.36787944, 3e-8);
  EXPECT_EQ(kernel::beer_lambert(0.0f), 1.0f);
  EXPECT_EQ(kernel::beer_lambert(1e30f), 0.0f);
}

TEST(FunctionAccuracy, MarchPlacements) {
  EXPECT_FLOAT_EQ(kernel::march_position(2.0f, 0.5f, 3, 0.0f, 0.0f, 0.9f), 3.5f);    // start
  EXPECT_FLOAT_EQ(kernel::march_position(2.0f, 0.5f, 3, 0.0f, 1.0f, 0.9f), 3.95f);   // random
  EXPECT_FLOAT_EQ(kernel::march_position(2.0f, 0.5f, 3, 0.5f, 0.0f, 0.9f), 3.75f);   // middle
  EXPECT_FLOAT_EQ(kernel::march_position(2.0f, 0.5f, 3, 0.25f, 0.5f, 0.9f), 3.85f);  // middle-random
}

}  // namespace
}  // namespace brume

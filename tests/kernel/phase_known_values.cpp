// Phase functions against values and limits that are known: Draine's distribution function in closed form, the phase
// functions that it and the two lobes contain, and the published mean cosine of a droplet. The faults this catches: a
// sampler that is off by less than a chi-squared test can see, and a fit with one coefficient mistyped.
#include <gtest/gtest.h>

#include "kernel/phase_cases.h"

namespace brume {
namespace {

// The probability that Draine's cosine is below mu: the density integrated over s = sqrt(1 + g^2 - 2 g mu), in which it
// is (1 + alpha mu(s)^2) / s^2 and mu(s) = (1 + g^2 - s^2) / (2 g). Loses 16 |lg g| digits.
double draine_distribution(double mu, double g, double alpha) {
  if (g == 0) return (mu + 1 + alpha * (mu * mu * mu + 1) / 3) / (2 + 2 * alpha / 3);
  const double a = 1 + g * g, b = 1 / (4 * g * g);
  const auto antiderivative = [&](double s) {
    return -(1 + alpha * a * a * b) / s - 2 * alpha * a * b * s + alpha * b * s * s * s / 3;
  };
  const double integral = antiderivative(1 + g) - antiderivative(std::sqrt(a - 2 * g * mu));
  return (1 - g * g) / (2 * g * (1 + alpha * (1 + 2 * g * g) / 3)) * integral;
}

// How far the distribution function at the samples is from u at most. A sample stands for all that round to it.
double worst_inversion(const PhaseCase& phase, double g, double alpha) {
  constexpr int count = 4096;
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    const double u = (i + 0.5) / count;
    const float mu = phase.sample(static_cast<float>(u), phase.p);
    const double below = draine_distribution(std::max(std::nextafter(mu, -2.0f), -1.0f), g, alpha);
    const double above = draine_distribution(std::min(std::nextafter(mu, 2.0f), 1.0f), g, alpha);
    worst = std::max({worst, below - u, u - above});
  }
  return worst;
}

constexpr double inversion_tolerance = 1e-6;

TEST(DraineSampling, InvertsTheDistributionFunction) {
  for (const float g : {0.0f, 0.05f, 0.2f, -0.4f, 0.55f, 0.6f, -0.65f, 0.75f, 0.85f, 0.95f, -0.95f, 0.99f, 0.999f})
    for (const float alpha : {0.0f, 0.01f, 1.0f, 20.0f, 50.0f, 100.0f, 250.0f, 1000.0f})
      EXPECT_LE(worst_inversion(phase_case("draine", {g, alpha}), g, alpha), inversion_tolerance) << g << ' ' << alpha;
}

// A chi-squared test of 10^6 samples cannot see 1 % in alpha here, which moves u by 3e-5.
TEST(DraineSampling, OnePercentInAlphaTwinIsRejected) {
  EXPECT_GT(worst_inversion(phase_case("draine", {0.3f, 252.5f}), 0.3f, 250.0), 8 * inversion_tolerance);
}

// Both densities at, and samples from, many places.
void expect_same(const PhaseCase& a, const PhaseCase& b) {
  for (int i = 0; i < 1000; ++i) {
    const float u = static_cast<float>(i) / 1000, mu = 2 * u - 1;
    EXPECT_NEAR(a.eval(mu, a.p), b.eval(mu, b.p), 2e-6 * b.eval(mu, b.p)) << "mu " << mu;
    EXPECT_NEAR(a.sample(u, a.p), b.sample(u, b.p), 4e-6) << "u " << u;
  }
  EXPECT_NEAR(a.mean_cosine(a.p), b.mean_cosine(b.p), 1e-6);
}

TEST(DraineLimits, AlphaZeroIsHenyeyGreenstein) {
  for (const float g : {-0.9f, -0.3f, 0.0f, 1e-4f, 0.5f, 0.98f})
    expect_same(phase_case("draine", {g, 0}), henyey_greenstein_case(g));
}

TEST(DraineLimits, NoLobeAndAlphaOneIsRayleigh) {
  expect_same(phase_case("draine", {0, 1}), phase_case("rayleigh", {}));
}

// W. M. Cornette and J. G. Shanks, Applied Optics 31(16), 1992, eq. 8.
TEST(DraineLimits, AlphaOneIsCornetteShanks) {
  const double g = 0.5;
  const PhaseCase phase = phase_case("draine", {0.5f, 1});
  for (const double mu : {-1.0, -0.25, 0.0, 0.5, 1.0}) {
    const double expected = 3 * (1 - g * g) * (1 + mu * mu) /
                            (8 * 3.14159265358979324 * (2 + g * g) * std::pow(1 + g * g - 2 * g * mu, 1.5));
    EXPECT_NEAR(phase.eval(static_cast<float>(mu), phase.p), expected, 1e-6 * expected);
  }
}

TEST(TwoLobe, AllWeightOnOneIsThatOne) {
  expect_same(phase_case("two_lobe", {0.9f, -0.4f, 1}), henyey_greenstein_case(0.9f));
  expect_same(phase_case("two_lobe", {0.9f, -0.4f, 0}), henyey_greenstein_case(-0.4f));
}

// 0.3 of the samples, those with the smaller u, come from the first lobe.
TEST(TwoLobe, UChoosesTheLobeByItsWeight) {
  const PhaseCase phase = phase_case("two_lobe", {0.9f, -0.4f, 0.3f});
  const PhaseCase first = henyey_greenstein_case(0.9f), second = henyey_greenstein_case(-0.4f);
  EXPECT_NEAR(phase.sample(0.15f, phase.p), first.sample(0.5f, first.p), 1e-5);
  EXPECT_NEAR(phase.sample(0.65f, phase.p), second.sample(0.5f, second.p), 1e-5);
}

double mie_mean_cosine(float diameter) {
  const PhaseCase phase = phase_case("mie", {diameter});
  return phase.mean_cosine(phase.p);
}

// Jendersie and d'Eon 2023.
TEST(Mie, MeanCosineOfATenMicrometreDropletIsThePublishedOne) { EXPECT_NEAR(mie_mean_cosine(10), 0.864164, 1e-6); }

TEST(Mie, OnePerMilleInTheDiameterTwinIsRejected) { EXPECT_GT(std::abs(mie_mean_cosine(10.01f) - 0.864164), 8e-6); }

TEST(Mie, FitIsAPhaseFunctionForEveryDiameter) {
  for (float d = 0.1f; d <= 50; d *= 1.001f) {
    const kernel::vec4 p = phase_case("mie", {d}).p;
    EXPECT_TRUE(std::abs(p.x) < 1 && std::abs(p.y) < 1 && p.z >= 0 && p.w > 0 && p.w < 1) << "d " << d;
  }
}

// The pieces for small and for large droplets hardly differ where they meet.
TEST(Mie, FitIsNearlyContinuousAtFiveMicrometres) {
  EXPECT_NEAR(mie_mean_cosine(std::nextafter(5.0f, 0.0f)), mie_mean_cosine(5), 1e-3);
}

}  // namespace
}  // namespace brume

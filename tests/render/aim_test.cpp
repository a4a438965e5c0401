// Paths aimed at lamps: the fluence at a distance from a point source in an infinite medium. Estimates of it by
// collisions and shadow rays alone have an infinite variance; with flights that gather light all along and are aimed at
// the lamp they have not. Source: transport theory (K. M. Case and P. F. Zweifel, Linear Transport Theory, 1967),
// checked by analog walks.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/estimates.h"
#include "sanitized.h"

namespace brume {
namespace {

constexpr double pi = std::numbers::pi;

// Isotropic scattering, sigma_t = 1, everywhere; a lamp of power 1 at an angle to the direction that the camera sees.
SceneDescription lamp_in_infinite_fog(float albedo, double distance, double angle) {
  SceneDescription s = needle_scene();
  s.integrator.name = "volpath";
  s.integrator.max_depth = 100000;
  s.media = {homogeneous_medium("fog", 1 - albedo, albedo)};
  s.camera.medium = "fog";
  s.lights = {point_light({distance * std::sin(angle), 0, distance * std::cos(angle)}, static_cast<float>(0.25 / pi))};
  return s;
}

// The fluence is the direct e^-r / (4 pi r^2) and the radiance over all directions: 2 pi sin(angle) L(angle), in which
// the peak of L about the lamp is gone, by Gauss-Legendre quadrature over v with angle = pi v^2: for small angles the
// integrand is as smooth as v^3 ln v only.
Estimate fluence(float albedo, double distance, int samples) {
  constexpr double node[] = {0.00921968287664, 0.04794137181476, 0.11504866290285, 0.20634102285669,
                             0.31608425050091, 0.43738329574427, 0.56261670425573, 0.68391574949909,
                             0.79365897714331, 0.88495133709715, 0.95205862818524, 0.99078031712336};
  constexpr double weight[] = {0.02358766819326, 0.05346966299766, 0.08003916427167, 0.10158371336153,
                               0.11674626826918, 0.12457352290670, 0.12457352290670, 0.11674626826918,
                               0.10158371336153, 0.08003916427167, 0.05346966299766, 0.02358766819326};
  Estimate sum{std::exp(-distance) / (4 * pi * distance * distance), 0};
  double variance = 0;
  for (std::size_t i = 0; i < std::size(node); ++i) {
    const double angle = pi * node[i] * node[i], share = 2 * pi * 2 * pi * node[i] * weight[i] * std::sin(angle);
    SceneDescription s = lamp_in_infinite_fog(albedo, distance, angle);
    s.sampler.seed = static_cast<std::uint32_t>(i);
    const Estimate e = estimate(s, samples);
    sum.mean += share * e.mean;
    variance += share * share * e.standard_error * e.standard_error;
  }
  sum.standard_error = std::sqrt(variance);
  return sum;
}

void expect_fluence(double distance, double expected, int samples, double relative_error) {
  const Estimate e = fluence(0.9f, distance, samples);
  std::printf("mean %.6f, standard error %.6f, expected %.6f, z %+.2f\n", e.mean, e.standard_error, expected,
              (e.mean - expected) / e.standard_error);
  EXPECT_LE(std::abs(e.mean - expected), 4 * e.standard_error + 5e-7);
  EXPECT_LE(e.standard_error, relative_error * expected);
}

// Catches a density that is not that of the directions drawn, or a weight that leaves it out: both change how much is
// scattered, as the twin's albedo does.
TEST(Aim, FluenceAtADistanceFromALamp) {
  constexpr double expected = 0.143284;
  if (sanitized) return expect_fluence(1, expected, 2000, 2e-2);
  expect_fluence(1, expected, 50000, 3.5e-3);
  const Estimate twin = fluence(0.88f, 1, 50000);
  EXPECT_GT(std::abs(twin.mean - expected), 8 * twin.standard_error);
}
TEST(NightlyAim, FluenceAtADistanceFromALamp) {
  expect_fluence(1, 0.143284, 6000000, 4e-4);
  expect_fluence(2, 0.037126, 6000000, 6e-4);
}

}  // namespace
}  // namespace brume

// Cones of light: on surfaces, in media, and their power, against closed forms and quadrature.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "compile/compile.h"
#include "render/estimates.h"
#include "render/lights.h"

namespace brume {
namespace {

constexpr double pi = std::numbers::pi;

double cosine(double degrees) { return std::cos(degrees * pi / 180); }

// What pbrt's smooth step gives at a cosine to the axis. The twin's is straight.
double falloff(const SpotLight& spot, double cos_theta, bool smooth = true) {
  const double end = cosine(spot.cone_angle), start = cosine(spot.cone_angle - spot.cone_delta);
  const double t = std::clamp((cos_theta - end) / (start - end), 0.0, 1.0);
  return smooth ? t * t * (3 - 2 * t) : t;
}

double cosine_to_axis(const SpotLight& spot, Vector3 p) {
  return dot(normalize(p - spot.from), normalize(spot.to - spot.from));
}

class Spot : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Integrators, Spot, ::testing::Values("classic", "reference", "volpath"),
                         [](const auto& test) { return std::string(test.param); });

// A grey floor at z = 0 shows 0.5 / pi times I f cos / d^2, without variance: on the axis, in the edge of the cone, and
// beyond it.
TEST_P(Spot, LightsAFloor) {
  SpotLight spot{{0.3, 0.2, -1.5}, {0.3, 0.2, 0}, constant_spectrum(7), 20, 12};
  int in_edge = 0;
  for (const double aside : {0.3, 0.1, 0.0, -0.1, -0.2, -0.5}) {
    SceneDescription s = needle_scene({0, 0, -0.5});
    s.integrator.name = GetParam();
    s.shapes = {square_facing_z({0, 0, 0}, 0.5, 0.5f)};
    spot.to = {0.3 - aside, 0.2, 0};
    s.lights = {{spot, {}}};
    const Vector3 lit{0, 0, 0}, away = lit - spot.from;
    const double cos_theta = cosine_to_axis(spot, lit), irradiance = 7 * 1.5 / std::pow(length(away), 3);
    const double expected = 0.5 / pi * irradiance * falloff(spot, cos_theta);
    const double found = static_cast<double>(radiance(s));
    EXPECT_NEAR(found, expected, 1e-5 * irradiance) << aside;
    const double twin = 0.5 / pi * irradiance * falloff(spot, cos_theta, false);
    if (std::abs(twin - expected) > 1e-3 * irradiance) {
      ++in_edge;
      EXPECT_GT(std::abs(found - twin), 1e-3 * irradiance * 0.9) << aside;
    }
    if (aside == -0.5) {
      EXPECT_EQ(found, 0);
    }
  }
  EXPECT_GE(in_edge, 1);
}

// Single scattering along +z for t in [0, 4] in homogeneous fog: the integral of
// sigma_s / (4 pi) e^(-sigma_t (t + d)) I f / d^2, in which the flight enters and leaves the cone.
double scattered_once(const SpotLight& spot, double sigma_a, double sigma_s) {
  constexpr int n = 200000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double t = 4 * (i + 0.5) / n;
    const Vector3 p{0, 0, t};
    const double d = length(p - spot.from);
    sum += std::exp(-(sigma_a + sigma_s) * (t + d)) * falloff(spot, cosine_to_axis(spot, p)) / (d * d);
  }
  return sum * 4 / n * sigma_s / (4 * pi) * static_cast<double>(spot.intensity[0]);
}

SceneDescription spot_in_fog(const char* integrator, const SpotLight& spot, bool grid) {
  SceneDescription s = needle_scene();
  s.integrator.name = integrator;
  s.integrator.step = 0.002;
  s.shapes = {square_facing_z({0, 0, 4}, 1, 0)};
  s.lights = {{spot, {}}};
  if (grid) {
    s.media = {grid_medium("fog", {-3, -3, -1}, {3, 3, 5}, {8, 8, 8}, std::vector<float>(512, 1), 0.2f, 0.5f)};
    s.media[0].linear_interpolation = false;
    s.shapes.push_back(free_volume("fog"));
  } else {
    s.media = {homogeneous_medium("fog", 0.2f, 0.5f)};
    s.camera.medium = "fog";
  }
  return s;
}

// Catches a cone that is left out where light is placed along flights (homogeneous media, and near lights in grids), or
// at collisions. The twin's cone is six degrees wider.
TEST_P(Spot, LightsFog) {
  const SpotLight spot{{1, 0.3, 1}, {0.2, 0, 2}, constant_spectrum(1), 25, 10};
  const double expected = scattered_once(spot, 0.2, 0.5);
  SpotLight wider = spot;
  wider.cone_angle += 6;
  for (const bool grid : {false, true}) {
    const SceneDescription s = spot_in_fog(GetParam(), spot, grid), twin = spot_in_fog(GetParam(), wider, grid);
    if (std::string(GetParam()) == "classic") {
      EXPECT_NEAR(radiance(s), expected, 1e-3 * expected);
      EXPECT_GT(std::abs(static_cast<double>(radiance(twin)) - expected), 0.05 * expected);
    } else {
      expect_estimate(s, expected, 0, 6e-3);
      expect_rejected(twin, {{expected, 0}}, 6e-3);
    }
  }
}

// Light is placed within the cone alone: a flight that is lit for a twentieth of its length has about the noise of one
// that is lit all along. Without, it has several times as much. From the front, from behind and across.
TEST(SpotPlacement, IsWithinTheCone) {
  for (const Vector3 from : {Vector3{1, 0, 2}, Vector3{0.15, 0, -1}, Vector3{0.15, 0, 3.9}}) {
    const SpotLight spot{from, {0, 0, 2}, constant_spectrum(1), 5, 0};
    const double expected = scattered_once(spot, 0.2, 0.5);
    const Estimate e = estimate(spot_in_fog("volpath", spot, false), 20000);
    EXPECT_LT(std::abs(e.mean - expected), 4 * e.standard_error + 1e-3 * expected);
    const double noise = e.standard_error * std::sqrt(20000) / expected;
    std::printf("noise of a sample %.2f\n", noise);
    EXPECT_LT(noise, 1.2);
  }
}

// All that goes out in all directions: `power` for a light of luminance 1, and the share that the choice of lights
// takes for it. The twin leaves out the edge.
TEST(SpotPower, IsWhatGoesOutInAllDirections) {
  for (const double delta : {0.0, 8.0, 40.0}) {
    SceneDescription s = needle_scene();
    const SpotLight spot{{0, 0, 0}, {1, 2, -1}, constant_spectrum(2), 40, delta};
    s.lights = {{spot, {}}};
    std::vector<Diagnostic> warnings;
    const CompiledScene compiled = compile(s, 1, warnings);
    constexpr int rings = 4000, sectors = 8;
    const Vector3 axis = normalize(spot.to), x = normalize(cross(axis, {0, 0, 1})), y = cross(axis, x);
    double power = 0;
    for (int i = 0; i < rings; ++i)
      for (int j = 0; j < sectors; ++j) {
        const double z = 1 - 2 * (i + 0.5) / rings, r = std::sqrt(1 - z * z), phi = 2 * pi * j / sectors;
        const Vector3 d = z * axis + r * std::cos(phi) * x + r * std::sin(phi) * y;
        const kernel::vec3 p(static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z));
        RandomStream random(compiled, 0, 0, 0);
        power += static_cast<double>(sample_light(compiled, compiled.lights[0], p, nullptr, random).value[0]) * 4 * pi /
                 (rings * sectors);
      }
    const double solid_angle = 2 * pi * (1 - (cosine(40) + cosine(40 - delta)) / 2);
    EXPECT_NEAR(power, 2 * solid_angle, 2e-3 * power) << delta;
    EXPECT_NEAR(static_cast<double>(compiled.lights[0].cone.share()), solid_angle / (4 * pi), 1e-6);
    if (delta > 0) {
      EXPECT_GT(std::abs(power - 2 * 2 * pi * (1 - cosine(40))), 0.05 * power);
    }
  }
}

}  // namespace
}  // namespace brume

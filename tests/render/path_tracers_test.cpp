// What holds for every integrator that solves the whole of light transport, beyond the table of cases.h.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/estimates.h"
#include "render/path_tracers.h"
#include "sanitized.h"

namespace brume {
namespace {

class PathTracers : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Both, PathTracers, path_tracers(), integrator_name);

// A lamp far away and almost ahead, whose light is even along the ray.
// Catches an angle that is the difference of two nearly equal ones: the twin is as far off as that is in floats.
TEST_P(PathTracers, SingleScatteringOfAFarLampAhead) {
  SceneDescription s = needle_scene();
  s.integrator.name = GetParam();
  s.media = {homogeneous_medium("fog", 0, 0.01f)};
  s.shapes = {box_shape({-1, -1, 1}, {1, 1, 2}, "fog")};
  s.lights = {point_light({0.3, 0, 1000}, 1e6f)};
  // 0.01 (1/(4 pi)) exp(-0.01) (1000 / 998.5)^2. The reference meets one collision in a hundred paths.
  const double error = s.integrator.name == "volpath" ? 1e-4 : 5e-3;
  const double expected = 0.01 / (4 * std::numbers::pi) * std::exp(-0.01) * 1e6 / (999.0 * 998.0);
  expect_estimate(s, expected, 4e-9, error);
  const double angle = std::atan(999 / 0.3) - std::atan(998 / 0.3);
  const float difference = std::atan(999 / 0.3f) - std::atan(998 / 0.3f);
  expect_rejected(s, {{expected * static_cast<double>(difference) / angle, 4e-9}}, error);
}

ShapeDescription lamp(Vector3 centre, double radius, float reflectance) {
  ShapeDescription s = sphere_shape(centre, radius, "");
  s.material = DiffuseMaterial{constant_spectrum(reflectance)};
  s.light = AreaLight{constant_spectrum(10), false, 0};
  return s;
}

// Catches shadow rays from a sphere to itself: it is convex, and lights no point of its own.
TEST_P(PathTracers, ASphereDoesNotLightItself) {
  SceneDescription s = needle_scene({0.1, 0.2, -4});
  s.integrator.name = GetParam();
  s.film.width = s.film.height = 32;
  s.camera.fov = 5;
  for (const double radius : {0.4, 1.7}) {
    s.shapes = {lamp({0.1, 0.2, 0}, radius, 0.5f)};
    for (const float v : render_film(s, 4, 2).image().pixels) ASSERT_NEAR(v, 10, 1e-4);
  }
}

// Catches shadow rays that end on the lamp itself where the camera is further from the floor than the lamp: the floor
// right under a sphere of radius r at height h has the irradiance pi L (r / h)^2, seen from anywhere. In the twin,
// those to the middle of the lamp end early, on a black ball.
TEST_P(PathTracers, ALampOverAFloorSeenAtASlant) {
  SceneDescription s = needle_scene();
  s.integrator.name = GetParam();
  s.camera.world_from_camera = inverse(look_at({0.1, 0.2, -4}, {1.2, -1, -0.5}, {0, 1, 0}));
  s.shapes = {square_facing_y({0, -1, 0}, 6, 0.6f), lamp({1.2, 1, -0.5}, 0.3, 0.3f)};
  expect_estimate(s, 0.6 * 10 * 0.09 / 4, 1e-6, 1e-3);
  s.shapes.push_back(sphere_shape({1.2, 0.2, -0.5}, 0.05, ""));
  s.shapes.back().material = DiffuseMaterial{{}};
  expect_rejected(s, 0.6 * 10 * 0.09 / 4);
}

// Catches radiance that refraction does not squeeze: a camera within glass sees the sky n^2 times as bright.
TEST_P(PathTracers, RadianceWithinGlassIsTheSquareOfItsIndexAsGreat) {
  SceneDescription s = needle_scene({0, 0, 0});
  s.integrator.name = GetParam();
  s.integrator.max_depth = 100;
  ShapeDescription ball = sphere_shape({0.1, 0.2, 0.3}, 2, "");
  ball.material = DielectricMaterial{1.5f};
  s.shapes = {ball};
  s.lights = {sky(1)};
  expect_estimate(s, 2.25, 0, 1e-3);
  expect_rejected(s, 1);
}

// A scene of everything at depth 1, where both integrators estimate the same: their means agree. (Emission apart:
// classic does not let emitting media light others.) Catches light that one of them loses or counts twice.
TEST(Integrators, ReferenceIsClassicAtDepthOne) {
  SceneDescription s = needle_scene({0.1, 0.2, -4});
  std::vector<float> density(5 * 6 * 7);
  for (std::size_t i = 0; i < density.size(); ++i) density[i] = static_cast<float>((i * 37) % 11) / 11;
  s.media = {homogeneous_medium("fog", 0.1f, 0.5f),
             grid_medium("smoke", {-1, -1, -1}, {1, 1, 1}, {5, 6, 7}, density, 0.3f, 1)};
  set_phase(s.media[1], "henyey_greenstein", {0.5f});
  s.shapes = {sphere_shape({0.5, 0, 0}, 0.9, "fog"), free_volume("smoke"), square_facing_z({0, 0, 3}, 2, 0.5f),
              square_facing_y({0, -1.5, 0}, 3, 0.7f)};
  s.lights = {sky(0.3f), distant_light({1, 2, -1}, 1), point_light({-2, 1, -2}, 3)};
  s.integrator.step = 0.01;
  s.integrator.placement = Placement::random;
  const Estimate classic = estimate(s, 10000);
  s.integrator.name = "reference";
  const Estimate reference = estimate(s, sanitized ? 10000 : 400000);
  const double error = std::hypot(classic.standard_error, reference.standard_error);
  EXPECT_LE(std::abs(classic.mean - reference.mean), 4 * error);
  if (sanitized) return;
  EXPECT_LT(error, 3e-3 * classic.mean);
  // Its twin, with a tenth of the sky's light missing.
  s.lights[0] = sky(0.27f);
  EXPECT_GT(std::abs(estimate(s, 400000).mean - classic.mean), 8 * error);
}

// One path serves all channels: each channel's mean is that of a grey scene with its coefficients. Catches channels
// that are weighed with each other's extinction or albedo.
TEST_P(PathTracers, EachChannelIsTheGreySceneOfItsCoefficients) {
  std::vector<float> density(4 * 4 * 4);
  for (std::size_t i = 0; i < density.size(); ++i) density[i] = static_cast<float>((i * 5) % 7) / 6;
  const Spectrum sigma_s{{0.5f, 2.0f, 4.0f}}, sigma_a{{1.0f, 0.1f, 0.3f}};
  SceneDescription s = needle_scene({0.1, 0.2, -4});
  s.integrator.name = GetParam();
  s.integrator.max_depth = 50;
  s.media = {grid_medium("grid", {-1, -1, -1}, {1, 1, 1}, {4, 4, 4}, density, 0, 0),
             homogeneous_medium("ball", 0.2f, 0.6f)};
  set_phase(s.media[0], "henyey_greenstein", {0.4f});
  s.shapes = {free_volume("grid"), sphere_shape({0.2, 0, 0}, 0.7, "ball")};
  s.lights = {sky(1), distant_light({1, 1, -1}, 1)};
  for (int c = 0; c < channel_count; ++c) {
    s.media[0].sigma_s = constant_spectrum(sigma_s[c]);
    s.media[0].sigma_a = constant_spectrum(sigma_a[c]);
    const int samples = sanitized ? 5000 : 100000;
    const Estimate grey = estimate(s, samples);
    s.media[0].sigma_s = sigma_s;
    s.media[0].sigma_a = sigma_a;
    SceneDescription coloured = s;
    coloured.sampler.seed = 99;
    const Estimate colour = estimate(coloured, samples, c);
    const double error = std::hypot(grey.standard_error, colour.standard_error);
    EXPECT_LE(std::abs(grey.mean - colour.mean), 4 * error) << "channel " << c;
    if (sanitized) continue;
    EXPECT_LT(error, 1e-2 * grey.mean);
    // The neighbour's coefficients would show.
    EXPECT_GT(std::abs(grey.mean - estimate(coloured, samples, (c + 1) % channel_count).mean), 8 * error);
  }
}

// Uniform surroundings and no absorption: every sample is 1, to rounding, of media in any company. Catches a collision
// that is weighed with another albedo than 1. The twin absorbs a little.
TEST(VolpathFurnace, EveryPixelIsOne) {
  SceneDescription s = needle_scene({0, 0, -3});
  s.camera.fov = 60;
  s.film.width = s.film.height = 32;
  s.integrator.name = "volpath";
  s.integrator.max_depth = 100000;
  std::vector<float> density(6 * 5 * 4);
  for (std::size_t i = 0; i < density.size(); ++i) density[i] = static_cast<float>((i * 7) % 5) / 4;
  s.media = {homogeneous_medium("ball", 0, 2), grid_medium("grid", {-1, -1, -1}, {1, 1, 1}, {6, 5, 4}, density, 0, 3)};
  set_phase(s.media[1], "henyey_greenstein", {0.7f});
  s.shapes = {sphere_shape({0.3, 0, 0}, 0.8, "ball"), free_volume("grid")};
  s.lights = {sky(1)};
  for (const float v : render_film(s, 16, 2).image().pixels) ASSERT_NEAR(v, 1, 1e-5);
  s.media[1].sigma_a = constant_spectrum(0.003f);
  double mean = 0;
  for (const float v : render_film(s, 16, 2).image().pixels) mean += static_cast<double>(v) / (3 * 32 * 32);
  EXPECT_LT(mean, 1 - 1e-4);
}

}  // namespace
}  // namespace brume

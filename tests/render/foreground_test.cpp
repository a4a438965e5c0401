// Alpha and depth: which share of a pixel surfaces and media cover, and how far away, held against Beer and Lambert's
// law by every integrator.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/scenes.h"

namespace brume {
namespace {

constexpr double near_end = 2, thickness = 3;
constexpr int sample_count = 40000;

enum class Slab { homogeneous, grid };

// A slab before a sky, seen along the normal, with optical depth sigma * thickness.
SceneDescription slab_scene(Slab kind, const Spectrum& sigma_t) {
  SceneDescription s = needle_scene();
  const Vector3 lo{-50, -50, near_end}, hi{50, 50, near_end + thickness};
  s.media = {kind == Slab::grid ? grid_medium("slab", lo, hi, {4, 4, 4}, std::vector<float>(64, 1.0f), 0, 0)
                                : homogeneous_medium("slab", 0, 0)};
  s.media[0].linear_interpolation = false;  // it would fade at the ends
  s.media[0].sigma_a = 0.25f * sigma_t;
  s.media[0].sigma_s = 0.75f * sigma_t;
  s.shapes = {kind == Slab::grid ? free_volume("slab") : box_shape(lo, hi, "slab")};
  s.lights = {sky(1)};
  s.integrator.step = 0.01;
  return s;
}

struct Seen {
  double alpha, depth;
};

Seen seen(SceneDescription scene, const char* integrator) {
  scene.integrator.name = integrator;
  const Image image = render_film(scene, scene.integrator.name == "classic" ? 1 : sample_count).image();
  return {static_cast<double>(image.alpha[0]), static_cast<double>(image.depth[0])};
}

double covered(double sigma) { return 1 - std::exp(-sigma * thickness); }

// The mean distance of what covers it: that of an exponential density which is cut at the far end.
double mean_depth(double sigma) {
  return near_end + 1 / sigma - thickness * std::exp(-sigma * thickness) / covered(sigma);
}

// Four standard errors of a share, and of a mean of distances within the slab; classic has no noise, but steps.
double alpha_limit(double alpha) { return 4 * std::sqrt(alpha * (1 - alpha) / sample_count) + 1e-5; }
double depth_limit(double alpha) { return 4 * thickness / std::sqrt(12 * alpha * sample_count) + 1e-4; }

class Foregrounds : public testing::TestWithParam<const char*> {};

TEST_P(Foregrounds, ASlabCoversWhatItDoesNotTransmit) {
  constexpr double sigma = 0.3;
  const double alpha = covered(sigma);
  for (const Slab kind : {Slab::homogeneous, Slab::grid}) {
    const Seen s = seen(slab_scene(kind, constant_spectrum(0.3f)), GetParam());
    EXPECT_NEAR(s.alpha, alpha, alpha_limit(alpha));
    EXPECT_NEAR(s.depth, mean_depth(sigma), depth_limit(alpha));
    // The twin is a third less dense.
    const Seen twin = seen(slab_scene(kind, constant_spectrum(0.2f)), GetParam());
    EXPECT_GT(std::abs(twin.alpha - alpha), alpha_limit(alpha));
    EXPECT_GT(std::abs(twin.depth - mean_depth(sigma)), depth_limit(alpha));
  }
}

// Catches extinctions that are averaged in place of what they transmit, and the share of one channel alone. The twins
// are those shares, each 8 standard errors away and more.
TEST_P(Foregrounds, TransmittancesOfColoursAreAveraged) {
  const Spectrum sigma{{0.1f, 0.2f, 0.9f}};
  double alpha = 0;
  std::vector<double> faulty = {covered(mean(sigma))};
  for (const float s : sigma.value) {
    faulty.push_back(covered(static_cast<double>(s)));
    alpha += faulty.back() / channel_count;
  }
  for (const Slab kind : {Slab::homogeneous, Slab::grid}) {
    const Seen s = seen(slab_scene(kind, sigma), GetParam());
    EXPECT_NEAR(s.alpha, alpha, alpha_limit(alpha));
    for (const double twin : faulty) EXPECT_GT(std::abs(s.alpha - twin), 2 * alpha_limit(alpha));
  }
}

// Catches a surface whose depth counts in full in the mean, and not by what the slab lets through: the twin.
TEST_P(Foregrounds, ASurfaceBehindTheSlabCoversTheRest) {
  constexpr double sigma = 0.3, surface = 10;
  for (const Slab kind : {Slab::homogeneous, Slab::grid}) {
    SceneDescription scene = slab_scene(kind, constant_spectrum(0.3f));
    scene.shapes.push_back(square_facing_z({0, 0, surface}, 1, 0.5f));
    const Seen s = seen(scene, GetParam());
    EXPECT_NEAR(s.alpha, 1, 1e-5);
    const double expected = covered(sigma) * mean_depth(sigma) + (1 - covered(sigma)) * surface;
    const double limit = 4 * surface / std::sqrt(sample_count);
    EXPECT_NEAR(s.depth, expected, limit);
    const double twin = (covered(sigma) * mean_depth(sigma) + surface) / (covered(sigma) + 1);
    EXPECT_GT(std::abs(s.depth - twin), 2 * limit);
  }
}

// Along the axis, at every angle, and before whatever else the path meets.
TEST_P(Foregrounds, DepthIsAlongTheAxis) {
  SceneDescription s = needle_scene({0, 0, -4});
  s.film.width = s.film.height = 8;
  s.camera.fov = 90;
  s.integrator.name = GetParam();
  s.integrator.max_depth = 3;
  s.shapes = {square_facing_z({0, 0, 1}, 2.5, 0.9f), square_facing_y({0, -40, 0}, 1, 0.9f)};
  s.lights = {sky(1)};
  const Image image = render_film(s, 4).image();
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    const bool hits = i / 8 >= 2 && i / 8 < 6 && i % 8 >= 2 && i % 8 < 6;
    EXPECT_EQ(image.alpha[i], hits ? 1 : 0) << i;
    EXPECT_FLOAT_EQ(image.depth[i], hits ? 5 : std::numeric_limits<float>::infinity()) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, Foregrounds, testing::Values("classic", "reference", "volpath"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace brume

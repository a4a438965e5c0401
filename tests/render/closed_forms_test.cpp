// The classic integrator against numbers known in closed form or by quadrature: Beer and Lambert's law, and single
// scattering of a point light in a homogeneous medium. No variance: tolerances are of rounding and of the step.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/estimates.h"
#include "scene/colour.h"

namespace brume {
namespace {

struct Method {
  Traversal traversal;
  Placement placement;
  const char* name;
};

constexpr Method methods[] = {{Traversal::march, Placement::start, "march, start"},
                              {Traversal::march, Placement::random, "march, random"},
                              {Traversal::march, Placement::middle, "march, middle"},
                              {Traversal::march, Placement::middle_random, "march, middle-random"},
                              {Traversal::dda, Placement::middle, "dda, middle"}};

void set_method(SceneDescription& scene, const Method& method, double step) {
  scene.integrator.traversal = method.traversal;
  scene.integrator.placement = method.placement;
  scene.integrator.step = step;
}

// Single scattering along +z for t in [0, 4], point light of intensity 1 at (1, 0, 2), homogeneous medium everywhere; a
// black square ends the ray.
SceneDescription single_scattering(float sigma_s, float sigma_a, float g) {
  SceneDescription s = needle_scene();
  MediumDescription fog = homogeneous_medium("fog", sigma_a, sigma_s);
  if (g != 0) set_phase(fog, "henyey_greenstein", {g});
  s.media = {fog};
  s.camera.medium = "fog";
  s.shapes = {square_facing_z({0, 0, 4}, 1, 0)};
  s.lights = {point_light({1, 0, 2}, 1)};
  s.integrator.step = 0.01;
  return s;
}

TEST(SingleScattering, MatchesQuadrature) {
  EXPECT_NEAR(radiance(single_scattering(0.5f, 0, 0)), 0.01857249, 1e-5 * 0.01857249);
  EXPECT_NEAR(radiance(single_scattering(0.5f, 0, 0.6f)), 0.02007662, 1e-5 * 0.02007662);
  EXPECT_NEAR(radiance(single_scattering(0.5f, 0.5f, 0)), 0.00446067, 1e-5 * 0.00446067 + 5e-9);
}

// Catches a phase function evaluated with the sign of mu reversed: such a renderer gives the mirror image's number.
TEST(SingleScattering, SeesTheSignOfMu) {
  EXPECT_GT(std::abs(radiance(single_scattering(0.5f, 0, -0.6f)) - 0.02007662f), 1e-3f * 0.02007662f);
}

// The same medium as a grid in a box that holds the ray and the light: every traversal and placement, to its own order.
TEST(SingleScattering, AGridOfOnesIsTheHomogeneousMedium) {
  SceneDescription homogeneous = single_scattering(0.5f, 0.1f, 0.6f);
  homogeneous.camera.medium = "";
  homogeneous.shapes.push_back(box_shape({-2, -2, -1}, {2, 2, 6}, "fog"));
  const float expected = radiance(homogeneous);
  for (const bool linear : {false, true})
    for (const Method& method : methods) {
      SceneDescription s = single_scattering(0.5f, 0.1f, 0.6f);
      s.camera.medium = "";
      s.media = {grid_medium("fog", {-2, -2, -1}, {2, 2, 6}, {200, 200, 350}, std::vector<float>(200 * 200 * 350, 1),
                             0.1f, 0.5f)};
      s.media[0].linear_interpolation = linear;
      set_phase(s.media[0], "henyey_greenstein", {0.6f});
      s.shapes.push_back(free_volume("fog"));
      set_method(s, method, 0.004);
      // Random placements choose at random which faint points get shadow rays: 64 samples then have a standard error of
      // 0.15 %.
      const bool is_random = method.placement == Placement::random || method.placement == Placement::middle_random;
      const double tolerance = is_random ? 8e-3 : method.placement == Placement::start ? 4e-3 : 2e-4;
      EXPECT_NEAR(radiance(s, is_random ? 64 : 1), expected, tolerance * expected)
          << method.name << (linear ? ", linear" : ", nearest");
    }
}

// For a choice of faint points that their weights do not make up for: a bias of 1 % would stand 8 standard errors
// out.
TEST(SingleScattering, FaintPointsAreChosenWithoutBias) {
  SceneDescription s = single_scattering(0.05f, 0.02f, 0.6f);
  const double expected = static_cast<double>(radiance(s));
  s.integrator.placement = Placement::random;
  s.integrator.step = 0.05;
  const Estimate e = estimate(s, 40000);
  RecordProperty("z", std::to_string((e.mean - expected) / e.standard_error));
  EXPECT_LT(e.standard_error, 1e-3 * expected);
  EXPECT_LT(std::abs(e.mean - expected), 4 * e.standard_error);
  EXPECT_GT(std::abs(e.mean - 1.01 * expected), 8 * e.standard_error);
}

// Transmittance through one mean free path of absorber before a sky of radiance 1.
TEST(BeerLambert, OneMeanFreePath) {
  const float expected = 0.36787944f;
  for (const Method& method : methods) {
    SceneDescription s = needle_scene({0.1, 0.2, -5});
    set_method(s, method, 0.01);
    s.lights = {sky(1)};

    s.media = {homogeneous_medium("absorber", 1, 0)};
    s.shapes = {box_shape({-1, -1, 0}, {1, 1, 1}, "absorber")};
    EXPECT_NEAR(radiance(s), expected, 1e-5) << "box, " << method.name;

    s.shapes = {sphere_shape({0.1, 0.2, 0}, 0.5, "absorber")};
    EXPECT_NEAR(radiance(s), expected, 1e-5) << "sphere, " << method.name;

    s.media = {grid_medium("absorber", {-1, -1, 0}, {1, 1, 1}, {3, 5, 7}, std::vector<float>(3 * 5 * 7, 1), 1, 0)};
    s.media[0].linear_interpolation = false;
    s.shapes = {free_volume("absorber")};
    EXPECT_NEAR(radiance(s), expected, 1e-5) << "free grid, " << method.name;

    s.shapes = {box_shape({-2, -2, -2}, {2, 2, 2}, "absorber")};
    EXPECT_NEAR(radiance(s), expected, 1e-5) << "grid in a larger box, " << method.name;
  }
}

// The near half of a gas at 1800 K, the far half at 2500 K: Le (1 - exp(-tau)) of each, the far one's through the near.
TEST(Emission, OfTwoLayersOfBlackBodies) {
  for (const Method& method : methods) {
    SceneDescription s = needle_scene({0.1, 0.2, -5});
    set_method(s, method, 0.001);
    s.media = {grid_medium("fire", {-1, -1, 0}, {1, 1, 2}, {1, 1, 2}, {1, 2}, 0.7f, 0)};
    s.media[0].linear_interpolation = false;
    s.media[0].temperatures = TemperatureScale{};
    s.media[0].emission = constant_spectrum(1);
    std::get<UniformGridMedium>(s.media[0].kind).temperature = {1800, 2500};
    s.shapes = {free_volume("fire")};
    const float expected = blackbody_emission(1800)[0] * (1 - std::exp(-0.7f)) +
                           blackbody_emission(2500)[0] * std::exp(-0.7f) * (1 - std::exp(-1.4f));
    EXPECT_NEAR(radiance(s), expected, 1e-3 * expected) << method.name;
  }
}

// Coefficients are per unit of world length, whatever the medium's transform scales.
TEST(BeerLambert, CoefficientsArePerWorldUnit) {
  SceneDescription s = needle_scene({0, 0, -50});
  s.lights = {sky(1)};
  s.media = {grid_medium("m", {-1, -1, 0}, {1, 1, 1}, {2, 2, 2}, std::vector<float>(8, 1), 0.1f, 0)};
  s.media[0].linear_interpolation = false;
  s.media[0].world_from_medium = scale({7, 1, 10});
  s.shapes = {free_volume("m")};
  EXPECT_NEAR(radiance(s), 0.36787944f, 1e-5);
}

// A floor under an absorbing slab: the shadow is the fraction that the slab leaves, neither 0 nor 1.
TEST(Shadows, AVolumeCastsTheFractionThatItLeaves) {
  SceneDescription s = needle_scene({0, 0, -3});
  s.camera.world_from_camera = translate({0, 0.5, 0}) * rotate(90, {1, 0, 0});  // looks down
  s.shapes = {square_facing_y({0, 0, 0}, 10, 0.5f)};
  s.lights = {distant_light({0, 1, 0}, 2)};
  const float unshadowed = 2 * 0.5f / std::numbers::pi_v<float>;
  EXPECT_NEAR(radiance(s), unshadowed, 1e-5 * unshadowed);

  s.media = {homogeneous_medium("absorber", 0.7f, 0)};
  s.shapes.push_back(box_shape({-1, 1, -1}, {1, 2, 1}, "absorber"));
  EXPECT_NEAR(radiance(s), unshadowed * std::exp(-0.7f), 1e-5 * unshadowed);

  s.shapes.back() = square_facing_y({0, 1, 0}, 1, 0);
  EXPECT_EQ(radiance(s), 0);  // an opaque square blocks all
}

// A diffuse floor under a sky of radiance 1 reflects its reflectance, every sample: the directions follow the cosine.
TEST(Sky, LightsADiffuseFloor) {
  SceneDescription s = needle_scene();
  s.camera.world_from_camera = translate({0, 1, 0}) * rotate(90, {1, 0, 0});
  s.shapes = {square_facing_y({0, 0, 0}, 10, 0.3f)};
  s.lights = {sky(1)};
  EXPECT_NEAR(radiance(s, 16), 0.3f, 1e-5);
}

// An infinitely thin isotropic scatterer under a uniform sky returns sigma_s times its length.
TEST(Sky, LightsAThinMedium) {
  SceneDescription s = needle_scene({0, 0, -5});
  s.media = {homogeneous_medium("thin", 0, 1e-4f)};
  s.shapes = {box_shape({-1, -1, 0}, {1, 1, 1}, "thin"), square_facing_z({0, 0, 1e4}, 1, 0)};
  s.lights = {sky(1)};
  EXPECT_NEAR(radiance(s, 64), 1e-4f, 1e-4 * 1e-3);
}

TEST(Mirror, ReflectsTheSkyAndTheDepthIsCounted) {
  SceneDescription s = needle_scene({0, 1, 0});
  s.camera.world_from_camera = translate({0, 1, 0}) * rotate(90, {1, 0, 0});
  s.shapes = {square_facing_y({0, 0, 0}, 10, 0)};
  s.shapes[0].material = BlinnPhongMaterial{{}, {}, constant_spectrum(0.25f), 1};
  s.lights = {sky(2)};
  EXPECT_NEAR(radiance(s), 0.5f, 1e-6);
  s.integrator.max_depth = 0;
  EXPECT_EQ(radiance(s), 0);
}

// Emission of a slab of optical depth 1: Le (1 - 1/e).
TEST(Emission, SlabOfOneMeanFreePath) {
  SceneDescription s = needle_scene({0, 0, -5});
  s.media = {homogeneous_medium("fire", 1, 0)};
  s.media[0].emission = constant_spectrum(3);
  s.shapes = {box_shape({-1, -1, 0}, {1, 1, 1}, "fire")};
  EXPECT_NEAR(radiance(s), 3 * (1 - 0.36787944f), 1e-5);
}

// A chord through an absorbing sphere of radius 5 that emits: Le (1 - e^-chord).
TEST(Emission, ChordOfASphere) {
  SceneDescription s = needle_scene({3, 0, -20});
  s.media = {homogeneous_medium("fire", 1, 0)};
  s.media[0].emission = constant_spectrum(1);
  s.shapes = {sphere_shape({0, 0, 0}, 5, "fire")};
  EXPECT_NEAR(radiance(s), 1 - std::exp(-8), 1e-5);
}

}  // namespace
}  // namespace brume

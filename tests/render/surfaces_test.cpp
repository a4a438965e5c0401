// Fresnel's equations, and surfaces that neither make nor lose light.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "render/estimates.h"
#include "render/fresnel.h"
#include "render/path_tracers.h"
#include "render/surfaces.h"

namespace brume {
namespace {

float dielectric(float cosine, float eta) {
  float refracted = 0;
  return fresnel_dielectric(cosine, eta, refracted);
}

// Reflectance of glass for diffuse light: the integral of 2 mu R(mu).
double diffuse_reflectance(float eta) {
  constexpr int steps = 200000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double mu = (i + 0.5) / steps;
    sum += 2 * mu * static_cast<double>(dielectric(static_cast<float>(mu), eta)) / steps;
  }
  return sum;
}

TEST(Fresnel, GlassReflectsAsTheTextbooksSay) {
  EXPECT_NEAR(dielectric(1, 1.5f), 0.04, 1e-6);
  EXPECT_NEAR(dielectric(1, 1 / 1.5f), 0.04, 1e-6);
  // At Brewster's angle the parallel part vanishes and the other is ((1 - n^2) / (1 + n^2))^2.
  const float brewster = 1 / std::sqrt(1 + 1.5f * 1.5f);
  EXPECT_NEAR(dielectric(brewster, 1.5f), 0.5 * std::pow(1.25 / 3.25, 2), 1e-6);
  EXPECT_EQ(dielectric(0.7f, 1 / 1.5f), 1);  // beyond the critical angle, whose cosine is 0.745
  EXPECT_NEAR(dielectric(0, 1.5f), 1, 1e-6);
  // Source: W. G. Egan and T. W. Hilgeman, Optical Properties of Inhomogeneous Materials, 1979, external n = 1.5.
  EXPECT_NEAR(diffuse_reflectance(1.5f), 0.0918, 5e-5);
  // From within, by reciprocity: 1 - (1 - R) / n^2.
  EXPECT_NEAR(diffuse_reflectance(1 / 1.5f), 1 - (1 - diffuse_reflectance(1.5f)) / 2.25, 2e-5);
}

TEST(Fresnel, AConductorThatAbsorbsNothingIsADielectric) {
  for (const float cosine : {1.0f, 0.8f, 0.5f, 0.2f, 0.05f})
    EXPECT_NEAR(fresnel_conductor(cosine, 1.5f, 0), dielectric(cosine, 1.5f), 2e-6) << cosine;
  EXPECT_NEAR(fresnel_conductor(1, 0.2f, 3.9f), (0.64 + 15.21) / (1.44 + 15.21), 1e-6);
  EXPECT_NEAR(fresnel_conductor(1e-7f, 0.2f, 3.9f), 1, 1e-6);
  // The amplitudes themselves, in complex numbers.
  const double c = 0.3, s2 = 1 - c * c;
  const std::complex<double> n(0.2, 3.9), root = std::sqrt(n * n - s2);
  const double s = std::norm((c - root) / (c + root)), p = std::norm((n * n * c - root) / (n * n * c + root));
  EXPECT_NEAR(fresnel_conductor(0.3f, 0.2f, 3.9f), 0.5 * (s + p), 2e-6);
}

TEST(Surfaces, RefractionObeysSnell) {
  CompiledScene scene;
  scene.width = scene.height = 1;
  scene.shapes.resize(1);
  scene.shapes[0].material = 0;
  scene.materials.resize(1);
  scene.materials[0].kind = CompiledMaterial::Kind::dielectric;
  scene.materials[0].refractive_index = 1.5f;
  SurfaceHit hit;
  hit.shape = 0;
  hit.normal = hit.shading_normal = {0, 0, 1};
  int transmitted = 0;
  for (int i = 0; i < 10000; ++i) {
    RandomStream random(scene, 0, 0, i);
    const SurfaceSample s = sample_surface(scene, hit, {0.6f, 0, -0.8f}, random);
    EXPECT_EQ(s.pdf, 0);
    if (!s.transmitted) {
      EXPECT_NEAR(s.direction.z, 0.8f, 1e-6f);
      continue;
    }
    ++transmitted;
    EXPECT_NEAR(s.direction.x, 0.4f, 1e-6f);
    EXPECT_LT(s.direction.z, 0);
    EXPECT_NEAR(s.weight[0], 1 / 2.25f, 1e-6f);
  }
  const double share = 1 - static_cast<double>(dielectric(0.8f, 1.5f));
  EXPECT_NEAR(transmitted, 1e4 * share, 4 * std::sqrt(1e4 * share * (1 - share)));
}

class Furnace : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(PathTracers, Furnace, path_tracers(), integrator_name);

SceneDescription furnace(const char* integrator, const MaterialDescription& material) {
  SceneDescription s = needle_scene({0.1, 0.3, -5});
  s.integrator.name = integrator;
  s.integrator.max_depth = 1000;
  ShapeDescription ball = sphere_shape({0, 0, 0}, 1, "");
  ball.material = material;
  s.shapes = {ball, square_facing_y({0, -1.2, 0}, 10, 1)};
  s.lights = {sky(1)};
  return s;
}

// A ball above white ground under a white sky: nothing is to be seen.
TEST_P(Furnace, GlassMakesAndLosesNoLight) {
  expect_estimate(furnace(GetParam(), DielectricMaterial{1.5f}), 1, 0, 1e-3);
  SceneDescription grey = furnace(GetParam(), DielectricMaterial{1.5f});
  std::get<DiffuseMaterial>(grey.shapes[1].material).reflectance = constant_spectrum(0.9f);
  expect_rejected(grey, 1);
}

// k = 200 reflects 0.9999 and more; k = 3 about 0.7.
TEST_P(Furnace, APerfectConductorLosesNoLight) {
  const auto metal = [](float k) { return ConductorMaterial{constant_spectrum(1), constant_spectrum(k)}; };
  expect_estimate(furnace(GetParam(), metal(200)), 1, 1e-4, 1e-3);
  expect_rejected(furnace(GetParam(), metal(3)), 1);
}

}  // namespace
}  // namespace brume

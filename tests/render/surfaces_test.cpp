// Fresnel's equations, and surfaces that neither make nor lose light.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "base/fresnel.h"
#include "compile/compile.h"
#include "render/estimates.h"
#include "render/path_tracers.h"
#include "render/surfaces.h"
#include "sanitized.h"

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

// The count catches rays that are let through as often as Fresnel says of light polarised across the plane of the rays,
// or as Schlick's approximation of it says. The twins are these.
TEST(Surfaces, RefractionObeysSnell) {
  CompiledScene scene;
  scene.width = scene.height = 1;
  scene.shapes.resize(1);
  scene.shapes[0].material = 0;
  scene.materials.resize(1);
  scene.materials[0].refraction = constant_spectrum(1);
  scene.materials[0].refractive_index = 1.5f;
  SurfaceHit hit;
  hit.shape = 0;
  hit.normal = hit.shading_normal = {0, 0, 1};
  constexpr int n = 1000000;
  int transmitted = 0;
  for (int i = 0; i < n; ++i) {
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
  const auto errors_out = [&](double reflectance) {
    return std::abs(transmitted - n * (1 - reflectance)) / std::sqrt(n * reflectance * (1 - reflectance));
  };
  EXPECT_LE(errors_out(static_cast<double>(dielectric(0.8f, 1.5f))), 4);
  const double inside = std::sqrt(1 - 0.4 * 0.4), across = std::pow((0.8 - 1.5 * inside) / (0.8 + 1.5 * inside), 2);
  EXPECT_GT(errors_out(across), 8);
  EXPECT_GT(errors_out(0.04 + 0.96 * std::pow(1 - 0.8, 5)), 8);
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
// Catches light that is lost or made where paths meet glass, reflected and refracted shares that do not sum to 1. Those
// of the twin sum to 0.99.
TEST_P(Furnace, GlassMakesAndLosesNoLight) {
  expect_estimate(furnace(GetParam(), DielectricMaterial{1.5f}), 1, 0, 1e-3);
  BlinnPhongMaterial glass{{}, {}, {}, 1};
  glass.refraction = constant_spectrum(0.99f);
  expect_rejected(furnace(GetParam(), glass), 1);
}

// k = 200 reflects 0.9999 and more.
// Catches a k that is not squared: that of the twin is its root.
TEST_P(Furnace, APerfectConductorLosesNoLight) {
  const auto metal = [](float k) { return ConductorMaterial{constant_spectrum(1), constant_spectrum(k)}; };
  expect_estimate(furnace(GetParam(), metal(200)), 1, 1e-4, 1e-3);
  expect_rejected(furnace(GetParam(), metal(std::sqrt(200.0f))), {{1, 1e-4}}, 1e-3);
}

// A facing square under a white sky shows all that it sends back: a highlight takes no more than its colour, for every
// shininess, and a metal's is tinted by the diffuse colour.
// Catches a highlight with another factor, and a sampler whose density is not the one that it is said to have: the
// twins' highlight is 4 % too bright. Of metals it catches a highlight that is tinted wholly or not at all, and a
// diffuse part that is less for them, as other shading models have it. The twins are what these would give.
TEST_P(Furnace, BlinnPhongSendsBackItsColours) {
  const auto square = [&](float specular, float shininess, float metallic) {
    SceneDescription s = needle_scene({0, 0, -1});
    s.integrator.name = GetParam();
    s.shapes = {square_facing_z({0, 0, 0}, 3, 0)};
    BlinnPhongMaterial m{constant_spectrum(0.25f), constant_spectrum(specular), constant_spectrum(0.1f), shininess};
    m.metallic = metallic;
    s.shapes[0].material = m;
    s.lights = {sky(1)};
    return s;
  };
  for (const float shininess : {0.0f, 8.0f, 1000.0f}) {
    expect_estimate(square(0.5f, shininess, 0), 0.85, 1e-5, 1e-3);
    expect_rejected(square(0.52f, shininess, 0), 0.85);
  }
  const SceneDescription metal = square(0.6f, 32, 0.5f);
  expect_estimate(metal, 0.25 + 0.6 * 0.625 + 0.1, 1e-5, 1e-3);
  for (const double faulty : {0.25 + 0.6 * 0.25 + 0.1, 0.25 + 0.6 + 0.1, 0.5 * 0.25 + 0.6 * 0.625 + 0.1})
    expect_rejected(metal, {{faulty, 1e-5}}, 1e-3);
}

// Catches a mirror or glass that is taken with another chance than it is weighed with: the twin's glass with 7 / 6 of
// it.
TEST_P(Furnace, GlassUnderAMirrorMakesAndLosesNoLight) {
  BlinnPhongMaterial m{{}, {}, constant_spectrum(0.3f), 1};
  m.refraction = constant_spectrum(0.7f);
  expect_estimate(furnace(GetParam(), m), 1, 1e-6, 1e-3);
  m.refraction = constant_spectrum(0.6f);
  expect_rejected(furnace(GetParam(), m), 1);
}

// Light that the coat lets through goes to and fro between base and coat until it leaves.
// Catches light of which a part is lost on that way. The base of the twin has the reflectance with which light that
// goes to and fro is what a white base sends back where it does not: rho / (1 - rho R_i) = 1.
TEST_P(Furnace, ACoatOverWhiteMakesAndLosesNoLight) {
  expect_estimate(furnace(GetParam(), CoatedDiffuseMaterial{constant_spectrum(1), 1.5f}), 1, 2e-6, 1e-3);
  const float once = 1 / (1 + static_cast<float>(diffuse_reflectance(1 / 1.5f)));
  expect_rejected(furnace(GetParam(), CoatedDiffuseMaterial{constant_spectrum(once), 1.5f}), {{1, 2e-6}}, 1e-3);
}

// Seen at 60 degrees: F + (1 - F) rho (1 - R_i) / (1 - rho R_i), with the reflectance from within as the test of
// Fresnel's equations has it.
// Catches light that does not go to and fro between base and coat, as in the twin.
TEST_P(Furnace, ACoatedSurfaceSendsBackItsAlbedo) {
  SceneDescription s = needle_scene();
  s.integrator.name = GetParam();
  s.camera.world_from_camera = rotate(60, {0, 1, 0}) * translate({0, 0, -1});
  s.shapes = {square_facing_z({0, 0, 0}, 3, 0)};
  s.shapes[0].material = CoatedDiffuseMaterial{constant_spectrum(0.6f), 1.5f};
  s.lights = {sky(1)};
  const double f = static_cast<double>(dielectric(0.5f, 1.5f)), r = diffuse_reflectance(1 / 1.5f);
  const double expected = f + (1 - f) * 0.6 * (1 - r) / (1 - 0.6 * r);
  expect_estimate(s, expected, 1e-5, 1e-3);
  expect_rejected(s, f + (1 - f) * 0.6 * (1 - r));
  // Light is found by lamps and by paths alike.
  ShapeDescription lamp = sphere_shape({0.3, 0.2, -2}, 0.7, "");
  lamp.material = DiffuseMaterial{{}};
  lamp.light = AreaLight{constant_spectrum(1), false, 0};
  s.shapes.push_back(lamp);
  expect_estimate(s, expected, 1e-5, 1e-3);
}

// Catches weights of lamps' samples and of paths that do not sum to 1: a tenth of the twin's lamp counts twice.
TEST_P(Furnace, AHighlightIsFoundByLampsAndByPathsAlike) {
  SceneDescription s = needle_scene({0, 0, -0.5});
  s.integrator.name = GetParam();
  s.shapes = {square_facing_z({0, 0, 0}, 3, 0), sphere_shape({0.3, 0.2, -2}, 0.7, "")};
  s.shapes[0].material = BlinnPhongMaterial{constant_spectrum(0.2f), constant_spectrum(0.5f), {}, 12};
  s.shapes[1].material = DiffuseMaterial{{}};
  s.shapes[1].light = AreaLight{constant_spectrum(1), false, 0};
  s.lights = {sky(1)};
  expect_estimate(s, 0.7, 1e-5, 1e-3);
  s.shapes[1].light->radiance = constant_spectrum(1.1f);
  expect_rejected(s, 0.7);
}

// What a rough metal sends back of a white sky, seen at a cosine mu, by quadrature over the directions l of the light:
// the integral of F D / (4 mu (1 + Lambda + Lambda')) dl, written anew.
double rough_metal_albedo(double mu, double alpha, double k) {
  constexpr int rings = 500, sectors = 1000;
  const auto hidden = [&](double c) { return (std::sqrt(1 + alpha * alpha * (1 / (c * c) - 1)) - 1) / 2; };
  const double vx = std::sqrt(1 - mu * mu);
  double sum = 0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double lz = (i + 0.5) / rings, r = std::sqrt(1 - lz * lz), phi = 2 * std::numbers::pi * (j + 0.5) / sectors;
      const double hx = r * std::cos(phi) + vx, hy = r * std::sin(phi), hz = lz + mu;
      const double size = std::sqrt(hx * hx + hy * hy + hz * hz), cosine = hz / size;
      const double t = cosine * cosine * (alpha * alpha - 1) + 1;
      const double d = alpha * alpha / (std::numbers::pi * t * t);
      const float f = fresnel_conductor(static_cast<float>((hx * vx + hz * mu) / size), 1, static_cast<float>(k));
      sum += static_cast<double>(f) * d / (4 * mu * (1 + hidden(mu) + hidden(lz)));
    }
  return sum * 2 * std::numbers::pi / (rings * sectors);
}

// Catches facets that hide too many others or too few, a density that is not the sampler's, and lamps and paths that
// are weighed wrongly against each other. The twin is what facets a tenth rougher would give.
TEST_P(Furnace, ARoughMetalSendsBackItsAlbedo) {
  SceneDescription s = needle_scene();
  s.integrator.name = GetParam();
  s.camera.world_from_camera = rotate(60, {0, 1, 0}) * translate({0, 0, -1});
  s.shapes = {square_facing_z({0, 0, 0}, 3, 0)};
  s.lights = {sky(1)};
  const auto metal = [](float alpha) { return ConductorMaterial{constant_spectrum(1), constant_spectrum(4), alpha}; };
  for (const float alpha : {0.5f, 0.1f}) {
    s.shapes[0].material = metal(alpha);
    expect_estimate(s, rough_metal_albedo(0.5, static_cast<double>(alpha), 4), 1e-5, 1e-3);
  }
  s.shapes[0].material = metal(0.5f);
  expect_rejected(s, rough_metal_albedo(0.5, 0.55, 4));
  ShapeDescription lamp = sphere_shape({-0.6, 0.2, -1.5}, 0.7, "");
  lamp.material = DiffuseMaterial{{}};
  lamp.light = AreaLight{constant_spectrum(1), false, 0};
  s.shapes.push_back(lamp);
  expect_estimate(s, rough_metal_albedo(0.5, 0.5, 4), 1e-5, 1e-3);
  s.integrator.name = "classic";
  expect_estimate(s, rough_metal_albedo(0.5, 0.5, 4), 1e-5, 1e-3);
}

// What a boundary of rough glass sends to a viewer at a cosine mu of a white sky on both of its sides, by quadrature
// over the facets, in coordinates about the viewer's direction v, so that it has nothing in common with a sum over
// lights: the integral of D v.h / mu times the share of facets that light reaches too, (1 + ...) being Smith's, and
// Fresnel's.
double rough_glass_albedo(double mu, double alpha, double eta) {
  constexpr int rings = 1000, sectors = 1000;
  const auto hidden = [&](double c) { return (std::sqrt(1 + alpha * alpha * (1 / (c * c) - 1)) - 1) / 2; };
  const double nx = std::sqrt(1 - mu * mu);  // the surface's normal, where v is the z axis
  double sum = 0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double hz = (i + 0.5) / rings, r = std::sqrt(1 - hz * hz), phi = 2 * std::numbers::pi * (j + 0.5) / sectors;
      const double cosine = r * std::cos(phi) * nx + hz * mu;  // n.h
      if (cosine <= 0) continue;
      const double t = cosine * cosine * (alpha * alpha - 1) + 1;
      const double facets = alpha * alpha / (std::numbers::pi * t * t) * hz / mu;
      float refracted = 0;
      const double reflectance =
          static_cast<double>(fresnel_dielectric(static_cast<float>(hz), static_cast<float>(eta), refracted));
      const double mirrored = 2 * hz * cosine - mu;  // n.l, l = 2 (v.h) h - v
      if (mirrored > 0) sum += facets * reflectance / (1 + hidden(mu) + hidden(mirrored));
      // l = -v / eta + (v.h / eta - cos) h
      const double bent = -mu / eta + (hz / eta - static_cast<double>(refracted)) * cosine;
      if (bent < 0 && reflectance < 1)
        sum += facets * (1 - reflectance) / (eta * eta) / (1 + hidden(mu) + hidden(-bent));
    }
  return sum * 2 * std::numbers::pi / (rings * sectors);
}

// Seen from outside and from within, where facets reflect totally. Lamps as bright as the sky stand before it and
// behind. Catches facets that refract into other directions than they are said to, a density that is not the sampler's,
// and shadow rays that do not find what lies behind. The twins are what facets an eighth rougher would give.
TEST_P(Furnace, RoughGlassSendsBackAndLetsThroughItsShare) {
  for (const std::string integrator : {GetParam(), "classic"})
    for (const bool from_within : {false, true}) {
      SceneDescription s = needle_scene();
      s.integrator.name = integrator;
      s.camera.world_from_camera = rotate(from_within ? 30 : -120, {0, 1, 0}) * translate({0, 0, -1});
      s.shapes = {square_facing_z({0, 0, 0}, 3, 0)};
      s.shapes[0].material = DielectricMaterial{1.5f, 0.4f};
      s.lights = {sky(1)};
      const double mu = from_within ? std::sqrt(0.75) : 0.5, eta = from_within ? 1 / 1.5 : 1.5;
      const double expected = rough_glass_albedo(mu, 0.4, eta);
      SCOPED_TRACE(integrator + (from_within ? " from within" : ""));
      expect_estimate(s, expected, 1e-5, 1e-3);
      expect_rejected(s, rough_glass_albedo(mu, 0.45, eta));
      for (const double z : {-1.8, 1.8}) {
        s.shapes.push_back(sphere_shape({z < 0 ? -0.6 : 0.4, 0.2, z}, 0.7, ""));
        s.shapes.back().material = DiffuseMaterial{{}};
        s.shapes.back().light = AreaLight{constant_spectrum(1), false, 0};
      }
      expect_estimate(s, expected, 1e-5, 1e-3);
    }
}

// Facets with next to no spread are smooth glass, and none at all where there is nothing to refract.
// Catches a roughness of which the root is taken, as pbrt does where it is to, and facets that hide each other though
// they refract nothing. The twins have that root, and an index that differs from 1.
TEST_P(Furnace, HardlyRoughGlassIsTheSmoothOne) {
  SceneDescription s = furnace(GetParam(), DielectricMaterial{1.5f, 0.02f});
  expect_estimate(s, 1, 2e-3, 1e-3);
  s.shapes[0].material = DielectricMaterial{1.5f, std::sqrt(0.02f)};
  expect_rejected(s, {{1, 2e-3}}, 1e-3);
  s.shapes[0].material = DielectricMaterial{1, 0.3f};
  expect_estimate(s, 1, 1e-6, 1e-3);
  s.shapes[0].material = DielectricMaterial{1.001f, 0.3f};
  expect_rejected(s, {{1, 1e-6}}, 1e-3);
}

// The base gets what the facets of the coat do not reflect. The table of that is exact to 2e-4.
// Catches light that is lost between base and coat: the twin's base loses 3 % of it each time.
TEST_P(Furnace, ARoughCoatOverWhiteMakesAndLosesNoLight) {
  for (const float alpha : {0.1f, 0.6f})
    expect_estimate(furnace(GetParam(), CoatedDiffuseMaterial{constant_spectrum(1), 1.5f, alpha}), 1, 2e-4, 1e-3);
  expect_rejected(furnace(GetParam(), CoatedDiffuseMaterial{constant_spectrum(0.97f), 1.5f, 0.6f}), {{1, 2e-4}}, 1e-3);
}

// Facets with next to no spread are the mirror: to 5e-4, what they change and the table's error. The ground would but
// add noise.
// Catches a roughness of which the root is taken, as the twin does.
TEST_P(Furnace, AHardlyRoughCoatIsTheSmoothOne) {
  const auto with_roughness = [&](float alpha, std::uint32_t seed) {
    SceneDescription s = furnace(GetParam(), CoatedDiffuseMaterial{constant_spectrum(0.5f), 1.5f, alpha});
    s.shapes.pop_back();
    s.sampler.seed = seed;
    return estimate(s, sanitized ? 10000 : 600000);
  };
  const Estimate smooth = with_roughness(0, 1);
  const auto errors_apart = [&](float alpha, std::uint32_t seed) {
    const Estimate rough = with_roughness(alpha, seed);
    std::printf("smooth %.6f, rough %.6f +- %.6f\n", smooth.mean, rough.mean, rough.standard_error);
    return (std::abs(rough.mean - smooth.mean) - 5e-4) / std::hypot(rough.standard_error, smooth.standard_error);
  };
  EXPECT_LE(errors_apart(0.02f, 2), 4);
  if (sanitized) return;
  EXPECT_GT(errors_apart(std::sqrt(0.02f), 3), 8);
}

// A ball of glass that absorbs, seen through its middle: what is reflected to and fro along the axis adds up to R + (1
// - R)^2 a / (1 - R a).
// Catches light that the glass absorbs on its first way through alone, or in one channel as in another. The twins are
// what these would give.
TEST_P(Furnace, GlassAbsorbsAlongTheWay) {
  SceneDescription s = needle_scene({0, 0, -5});
  s.integrator.name = GetParam();
  s.integrator.max_depth = 1000;
  BlinnPhongMaterial m{{}, {}, {}, 1};
  m.refraction = constant_spectrum(1);
  m.absorption = Spectrum{{0.1f, 0.35f, 0.9f}};
  s.shapes = {sphere_shape({0, 0, 0}, 1, "")};
  s.shapes[0].material = m;
  s.lights = {sky(1)};
  std::vector<Expected> expected;
  for (int c = 0; c < channel_count; ++c) {
    const double a = std::exp(-2 * static_cast<double>(m.absorption[c]));
    expected.push_back({0.04 + 0.96 * 0.96 * a / (1 - 0.04 * a), 1e-5});
  }
  expect_estimates(s, expected, 2e-3);
  std::vector<Expected> first_way = expected, one_channel(channel_count, expected[0]);
  for (int c = 0; c < channel_count; ++c)
    first_way[static_cast<std::size_t>(c)].value =
        0.04 + 0.96 * std::exp(-2 * static_cast<double>(m.absorption[c]));  // (1 - R)^2 a / (1 - R)
  expect_rejected(s, first_way, 2e-3);
  expect_rejected(s, one_channel, 2e-3);
}

// f is the same with light and viewer exchanged.
TEST(Surfaces, ReflectionIsReciprocal) {
  SceneDescription s = needle_scene();
  s.shapes.assign(3, square_facing_z({0, 0, 0}, 1, 0));
  s.shapes[0].material = CoatedDiffuseMaterial{constant_spectrum(0.6f), 1.5f};
  s.shapes[1].material = BlinnPhongMaterial{constant_spectrum(0.2f), constant_spectrum(0.5f), {}, 12};
  s.shapes[2].material = CoatedDiffuseMaterial{constant_spectrum(0.6f), 1.5f, 0.3f};
  std::vector<Diagnostic> warnings;
  const CompiledScene scene = compile(s, 1, warnings);
  const kernel::vec3 a = normalize(kernel::vec3(0.3f, 0.5f, 0.4f)), b = normalize(kernel::vec3(-0.5f, 0.1f, 0.9f));
  for (int shape : {0, 1, 2}) {
    SurfaceHit hit;
    hit.shape = shape;
    hit.normal = hit.shading_normal = {0, 0, 1};
    float pdf = 0;
    const float there = eval_surface(scene, hit, -a, b, pdf)[0] / b.z;
    const float back = eval_surface(scene, hit, -b, a, pdf)[0] / a.z;
    EXPECT_GT(there, 0.01f);
    EXPECT_NEAR(there, back, 1e-6f);
  }
}

}  // namespace
}  // namespace brume

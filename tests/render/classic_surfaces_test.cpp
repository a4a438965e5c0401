// Integrator "classic": refraction, shadows of what is transparent, and lights with a size, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/fresnel.h"
#include "render/estimates.h"

namespace brume {
namespace {

constexpr double pi = std::numbers::pi;

double fresnel(double cosine, double eta) {
  float refracted = 0;
  return static_cast<double>(fresnel_dielectric(static_cast<float>(cosine), static_cast<float>(eta), refracted));
}

BlinnPhongMaterial glass(float absorption, float refraction = 1) {
  BlinnPhongMaterial m{{}, {}, {}, 1};
  m.refraction = constant_spectrum(refraction);
  m.absorption = constant_spectrum(absorption);
  return m;
}

ShapeDescription with_material(ShapeDescription shape, const MaterialDescription& material) {
  shape.material = material;
  return shape;
}

ShapeDescription emitting_square_facing_z(Vector3 centre, double half, float radiance) {
  ShapeDescription s = square_facing_z(centre, half, 0);
  s.light = AreaLight{constant_spectrum(radiance), true, 0};
  return s;
}

// A floor of reflectance 0.5 at y = 0, seen from above by a camera beneath what stands at y >= 1.
SceneDescription floor_scene() {
  SceneDescription s = needle_scene();
  s.camera.world_from_camera = translate({0, 0.5, 0}) * rotate(90, {1, 0, 0});
  s.shapes = {square_facing_y({0, 0, 0}, 10, 0.5f)};
  return s;
}

// The shadow of a plate 0.3 thick, its light at an angle to it.
// Catches a plate that is opaque, that is not met twice, or whose Fresnel's angle is that of a ray from within.
TEST(ClassicShadows, AGlassPlateTakesFresnelsShareTwiceAndAbsorbs) {
  SceneDescription s = floor_scene();
  const double cosine = 0.6;
  s.lights = {distant_light({0.8, cosine, 0}, 2)};
  const float unshadowed = radiance(s);
  EXPECT_NEAR(unshadowed, 2 * cosine * 0.5 / pi, 1e-5);
  s.shapes.push_back(with_material(box_shape({-5, 1, -5}, {5, 1.3, 5}, ""), glass(0.7f)));
  const double once = 1 - fresnel(cosine, 1.5), absorbed = std::exp(-0.7 * 0.3 / cosine);
  const double shadow = static_cast<double>(radiance(s) / unshadowed);
  EXPECT_NEAR(shadow, once * once * absorbed, 1e-4);
  EXPECT_GT(std::abs(shadow - once * once), 1e-2);      // a twin without absorption,
  EXPECT_GT(std::abs(shadow - once * absorbed), 1e-2);  // and one that meets one face
  // The glass of half the surface, and the same absorber as a medium in a dielectric.
  s.shapes.back().material = glass(0.7f, 0.5f);
  EXPECT_NEAR(radiance(s) / unshadowed, 0.25 * once * once * absorbed, 1e-4);
  s.media = {homogeneous_medium("ink", 0.7f, 0)};
  s.shapes.back().material = DielectricMaterial{1.5f};
  s.shapes.back().inside = "ink";
  EXPECT_NEAR(radiance(s) / unshadowed, once * once * absorbed, 1e-4);
  // Something opaque behind the plate, and before it.
  for (const double y : {0.9, 1.1, 2.0}) {
    s.shapes.push_back(square_facing_y({y / cosine * 0.8, y, 0}, 0.2, 0));
    EXPECT_EQ(radiance(s), 0) << y;
    s.shapes.pop_back();
  }
}

// A tint is that of each channel.
TEST(ClassicShadows, ColouredGlassColoursItsShadow) {
  SceneDescription s = floor_scene();
  s.lights = {distant_light({0, 1, 0}, 2)};
  BlinnPhongMaterial m = glass(0);
  m.absorption = Spectrum{{0.1f, 1, 3}};
  s.shapes.push_back(with_material(box_shape({-5, 1, -5}, {5, 1.5, 5}, ""), m));
  const Image image = render_film(s, 1).image();
  for (int c = 0; c < channel_count; ++c)
    EXPECT_NEAR(image.pixels[static_cast<std::size_t>(c)],
                2 * 0.5 / pi * 0.96 * 0.96 * std::exp(-0.5 * static_cast<double>(m.absorption[c])), 1e-5);
}

// A sphere over a floor, half hidden by a plate with an edge at x = 0: the irradiance by quadrature over the cone of
// directions in which it is seen.
double penumbra(double height, double radius, double edge_height, double edge_x) {
  constexpr int rings = 1000, sectors = 2000;
  const double sine2 = radius * radius / (height * height);
  double sum = 0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double r2 = (i + 0.5) / rings * sine2;  // equal steps of sine^2 are equal steps of cos dw
      const double x = std::sqrt(r2 / (1 - r2)) * std::cos(2 * pi * (j + 0.5) / sectors) * edge_height;
      sum += x > edge_x;
    }
  return sum / (rings * sectors) * pi * sine2;  // times the radiance
}

SceneDescription half_hidden_sphere(double radius) {
  SceneDescription s = floor_scene();
  s.integrator.shadow_samples = 64;
  s.lights = {{SphereLight{{0, 3, 0}, radius, constant_spectrum(4)}, {}}};
  ShapeDescription plate = square_facing_y({-4.9, 1, 0}, 5, 0);  // its edge is at x = 0.1
  s.shapes.push_back(plate);
  return s;
}

// Catches a light whose intensity depends on its size, and shadow samples that are not spread over all of it.
TEST(ClassicLights, ASphereCastsAPenumbra) {
  SceneDescription s = half_hidden_sphere(0.8);
  const double radiance = 4 / (pi * 0.64), expected = 0.5 / pi * radiance * penumbra(3, 0.8, 1, 0.1);
  expect_estimate(s, expected, 1e-5, 5e-4);
  expect_rejected(half_hidden_sphere(0.7), expected);
  s.shapes.pop_back();
  expect_estimate(s, 0.5 / pi * 4 / 9, 1e-6, 5e-4);  // without the plate: I / h^2, whatever the radius
}

// Sixteen shadow rays that are spread evenly are better than sixteen that are not.
TEST(ClassicLights, ShadowSamplesAreStratified) {
  SceneDescription s = half_hidden_sphere(0.8);
  s.integrator.shadow_samples = 1;
  const double one = estimate(s, 20000).standard_error;
  s.integrator.shadow_samples = 16;
  const double sixteen = estimate(s, 20000).standard_error;
  EXPECT_LT(sixteen, 0.6 * one / 4);
}

// Catches media or surfaces that ambient light leaves out, and a coefficient that is not the one given.
TEST(ClassicLights, AmbientLightReachesSurfacesAndMedia) {
  SceneDescription s = floor_scene();
  s.lights = {{AmbientLight{constant_spectrum(0.8f)}, {}}};
  EXPECT_NEAR(radiance(s), 0.4f, 1e-6);
  BlinnPhongMaterial m;
  m.ambient = constant_spectrum(0.3f);
  s.shapes[0].material = m;
  EXPECT_NEAR(radiance(s), 0.24f, 1e-6);
  s.media = {homogeneous_medium("fog", 0, 0.5f)};
  s.shapes.push_back(box_shape({-1, 0.1, -1}, {1, 0.3, 1}, "fog"));
  const double left = std::exp(-0.1);
  EXPECT_NEAR(radiance(s), 0.24 * left + 0.8 * (1 - left), 1e-5);
}

// A camera in glass before its upper face, with a lamp below: beyond the critical angle the face is a mirror; within it
// the sky comes in, n^2 times as bright.
TEST(ClassicRefraction, GlassReflectsAllBeyondTheCriticalAngle) {
  for (const double degrees : {60.0, 30.0}) {
    SceneDescription s = needle_scene();
    s.camera.world_from_camera = rotate(degrees, {0, 1, 0}) * translate({0, 0, -1});
    s.shapes = {with_material(box_shape({-50, -50, -9}, {50, 50, 0}, ""), DielectricMaterial{1.5f}),
                emitting_square_facing_z({0, 0, -3}, 40, 2)};
    s.lights = {sky(1)};
    const double f = fresnel(std::cos(degrees * pi / 180), 1 / 1.5);
    EXPECT_EQ(f == 1, degrees == 60);
    EXPECT_NEAR(radiance(s), f * 2 + (1 - f) * 2.25, 1e-5) << degrees;
    s.integrator.max_depth = 0;
    EXPECT_EQ(radiance(s), 0);
  }
}

// A ray that misses a ball's centre by 0.6 radii: it is bent by 2 (asin(0.6) - asin(0.6 / n)), and a small lamp stands
// where it then goes.
// Catches a direction that is wrong on entering or leaving, a chord of another length, and a lamp that is seen past the
// ball.
TEST(ClassicRefraction, ARayCrossesAGlassBallAsItShould) {
  constexpr double n = 1.5, b = 0.6;
  const double incidence = std::asin(b), refracted = std::asin(b / n), turn = 2 * (incidence - refracted);
  // In the plane of the ray: it travels along +z at x = b, towards the axis.
  const double chord = 2 * std::cos(refracted);
  const Vector3 in{b, 0, -std::cos(incidence)};
  const double inner = incidence - refracted;
  const Vector3 out = in + chord * Vector3{-std::sin(inner), 0, std::cos(inner)};
  const Vector3 direction{-std::sin(turn), 0, std::cos(turn)};
  const Vector3 target = out + (4 - out.z) / direction.z * direction;
  const double once = 1 - fresnel(std::cos(incidence), n);

  SceneDescription s = needle_scene({b, 0, -3});
  s.integrator.max_depth = 2;
  s.shapes = {with_material(sphere_shape({0, 0, 0}, 1, ""), glass(0.7f)), emitting_square_facing_z(target, 1e-3, 5)};
  const double expected = 5 * once * once * std::exp(-0.7 * chord);
  EXPECT_NEAR(radiance(s), expected, 1e-4 * expected);
  s.media = {homogeneous_medium("ink", 0.7f, 0)};
  s.shapes[0].material = DielectricMaterial{1.5f};
  s.shapes[0].inside = "ink";
  EXPECT_NEAR(radiance(s), expected, 1e-4 * expected);
  s.shapes[1] = emitting_square_facing_z(target + Vector3{3e-3, 0, 0}, 1e-3, 5);
  EXPECT_EQ(radiance(s), 0);
  s.shapes[1] = emitting_square_facing_z(target, 1e-3, 5);
  s.shapes[0].material = DielectricMaterial{1.51f};
  EXPECT_EQ(radiance(s), 0);
}

// A thin scatterer in a slab of glass, lit at an angle: light comes in through one face, and goes to the camera through
// the other, where radiance loses the n^2 that it gained.
TEST(ClassicRefraction, LiquidInGlassIsLitThroughTheGlass) {
  SceneDescription s = needle_scene({0, 0, -3});
  s.integrator.max_depth = 2;
  s.media = {homogeneous_medium("liquid", 0, 1e-4f)};
  s.shapes = {with_material(box_shape({-50, -50, 0}, {50, 50, 1}, "liquid"), DielectricMaterial{1.5f})};
  s.lights = {distant_light({0.8, 0, -0.6}, 3)};
  const double expected = 0.96 / 2.25 * 1e-4 / (4 * pi) * 3 * (1 - fresnel(0.6, 1.5));
  EXPECT_NEAR(radiance(s), expected, 1e-3 * expected);
  s.lights = {distant_light({0.8, 0, 0.6}, 3)};  // through the other face
  EXPECT_NEAR(radiance(s), expected, 1e-3 * expected);
  s.shapes[0].material = InterfaceMaterial{};
  EXPECT_GT(radiance(s), 2 * expected);  // a twin without glass
}

// What is reflected to and fro in a ball adds up to all of the light, but for what is dropped.
TEST(ClassicRefraction, ABallOfGlassUnderAWhiteSkyIsNotSeen) {
  SceneDescription s = needle_scene({0.3, 0.4, -3});
  s.integrator.max_depth = 100;
  s.lights = {sky(1)};
  s.shapes = {with_material(sphere_shape({0, 0, 0}, 1, ""), DielectricMaterial{1.5f})};
  EXPECT_NEAR(radiance(s), 1, 2e-4);
  s.shapes[0].material = glass(0, 0.99f);
  EXPECT_LT(radiance(s), 0.99f);
}

// Two mirrors that lose nothing: an end is reached however deep a scene says to go.
TEST(ClassicRefraction, BranchesHaveAnEnd) {
  SceneDescription s = needle_scene({0.1, 0.2, -1});
  s.integrator.max_depth = 1000000;
  BlinnPhongMaterial m = glass(0);
  m.reflection = constant_spectrum(1);
  s.shapes = {with_material(square_facing_z({0, 0, 0}, 50, 0), m),
              with_material(square_facing_z({0, 0, -2}, 50, 0), m)};
  EXPECT_TRUE(std::isfinite(radiance(s)));
}

}  // namespace
}  // namespace brume

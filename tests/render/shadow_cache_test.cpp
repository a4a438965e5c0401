// "volumeshadows" "cached" of the classic integrator: its lattice against exact optical depths, and its pictures
// against a closed form and against marched shadow rays. The faults these catch: lattice points looked up a spacing
// off; light that reaches the points of a medium unshadowed; outermost points whose shadow rays miss the grid, along
// whose faces they pass.
#include "render/shadow_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "compile/compile.h"
#include "render/lights.h"
#include "render/scenes.h"

namespace brume {
namespace {

constexpr int resolution = 40;

// A smooth ball of density 1 in its middle, in the box [-1, 1]^3, under a lamp in the box and a sun.
SceneDescription smooth_ball() {
  std::vector<float> density;
  const auto at = [](int i) { return (i + 0.5) / resolution * 2 - 1; };
  for (int z = 0; z < resolution; ++z)
    for (int y = 0; y < resolution; ++y)
      for (int x = 0; x < resolution; ++x) {
        const double r2 = at(x) * at(x) + at(y) * at(y) + at(z) * at(z);
        density.push_back(static_cast<float>(std::exp(-4 * r2)));
      }
  SceneDescription s = needle_scene({0.1, 0.2, -5});
  s.media = {
      grid_medium("ball", {-1, -1, -1}, {1, 1, 1}, {resolution, resolution, resolution}, std::move(density), 0.5f, 2)};
  s.shapes = {free_volume("ball")};
  s.lights = {point_light({0.4, 0.8, -0.7}, 3), distant_light({0.3, 0.8, 0.5}, 2)};
  s.integrator.placement = Placement::middle;
  return s;
}

// The worst error of looked-up transmittances at places up to 0.9 from the middle, each displaced by `shift` after
// its true transmittance was found by DDA.
float worst_error(std::size_t light, kernel::vec3 shift) {
  SceneDescription description = smooth_ball();
  description.integrator.traversal = Traversal::dda;
  std::vector<Diagnostic> warnings;
  const CompiledScene scene = compile(description, 1, warnings);
  const Intersector intersector(scene);
  const MediaAlongRay media(scene, intersector);
  const ShadowCache cache(scene, intersector, media, 1, [] { return true; });
  EXPECT_TRUE(cache.covers(light, 0));
  Visibility visibility(scene, intersector, media);
  std::vector<Spectrum> truth;
  float worst = 0;
  for (int i = 0; i < 2000; ++i) {
    RandomStream random(scene, i, 0, 0);
    const auto coordinate = [&] { return 1.8f * random.next() - 0.9f; };
    const float x = coordinate(), y = coordinate(), z = coordinate();
    const kernel::vec3 p(x, y, z);
    ShadowRays ray;
    ray.add(sample_light(scene, scene.lights[light], p, nullptr, random).ray, random.next_bits());
    visibility.find(ray, truth);
    worst = std::max(worst, std::abs(cache.transmittance(light, 0, p + shift)[0] - truth[0][0]));
  }
  return worst;
}

TEST(ShadowCache, HoldsTheTransmittance) {
  for (const std::size_t light : {0u, 1u}) EXPECT_LT(worst_error(light, {0, 0, 0}), 0.01f) << "light " << light;
}

TEST(ShadowCacheTwin, ASpacingOffIsRejected) {
  for (const std::size_t light : {0u, 1u})
    for (const kernel::vec3 shift : {kernel::vec3(0.1f, 0, 0), kernel::vec3(0, 0.1f, 0), kernel::vec3(0, 0, 0.1f)})
      EXPECT_GT(worst_error(light, shift), 0.02f) << "light " << light;
}

void expect_as_marched(SceneDescription s, double tolerance) {
  const float marched = radiance(s);
  s.integrator.volume_shadows = VolumeShadows::cached;
  const float cached = radiance(s);
  EXPECT_GT(marched, 0);
  EXPECT_NEAR(cached, marched, tolerance * static_cast<double>(marched));
  EXPECT_NE(cached, marched);  // else the lattice was not asked
}

TEST(CachedShadows, SmoothVolumeIsAsMarched) {
  SceneDescription s = smooth_ball();
  s.integrator.step = 0.01;
  expect_as_marched(s, 2e-3);
  s.lights[0].kind = SpotLight{{0.4, 0.8, -0.7}, {0, 0, 0}, constant_spectrum(3), 60, 10};
  expect_as_marched(s, 2e-3);
}

// Points in a fog without a grid, under the sky as well, get shadow rays, which march through the ball.
TEST(CachedShadows, WhereThereIsNoGridAndUnderTheSky) {
  SceneDescription s = smooth_ball();
  s.integrator.step = 0.01;
  s.media.push_back(homogeneous_medium("fog", 0.1f, 0.2f));
  s.camera.medium = "fog";
  s.shapes.push_back(square_facing_z({0, 0, 3}, 1, 0.5f));
  s.lights.push_back(sky(1));
  expect_as_marched(s, 2e-3);
}

// Light of irradiance 2 from above on a box of ones, which the camera's ray crosses 0.87 below its top:
// 2 sigma_s / (4 pi) exp(-0.87 sigma_t) (1 - exp(-2 sigma_t)) / sigma_t.
TEST(CachedShadows, ConstantGridIsTheClosedForm) {
  SceneDescription s = needle_scene({0.03, 0.13, 0});
  s.media = {grid_medium("m", {-1, -1, 1}, {1, 1, 3}, {20, 20, 20}, std::vector<float>(20 * 20 * 20, 1), 0.1f, 0.5f)};
  s.media[0].linear_interpolation = false;
  s.shapes = {free_volume("m")};
  s.lights = {distant_light({0, 1, 0}, 2)};
  s.integrator.step = 0.01;
  s.integrator.volume_shadows = VolumeShadows::cached;
  const double unshadowed = 2 * 0.5 / (4 * std::numbers::pi) * (1 - std::exp(-2 * 0.6)) / 0.6,
               expected = unshadowed * std::exp(-0.87 * 0.6);
  const double found = static_cast<double>(radiance(s));
  EXPECT_NEAR(found, expected, 2e-3 * expected);  // (0.2 sigma_t)^2 / 8 by interpolation
  EXPECT_GT(std::abs(found - unshadowed), 0.2 * expected);

  // Surfaces are not in the lattice: shadow rays still find them.
  s.shapes.push_back(square_facing_y({0, 2, 2}, 3, 0));
  EXPECT_EQ(radiance(s), 0);
}

TEST(CachedShadows, ThreadsMakeNoDifference) {
  SceneDescription s = smooth_ball();
  s.camera.fov = 20;
  s.film.width = s.film.height = 12;
  s.integrator.volume_shadows = VolumeShadows::cached;
  s.integrator.placement = Placement::random;
  EXPECT_EQ(render_film(s, 2, 1).image().pixels, render_film(s, 2, 2).image().pixels);
}

}  // namespace
}  // namespace brume

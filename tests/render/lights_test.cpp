// Lights: closed forms of what they give, and emitters as bright as the sky behind them, which must not be seen.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "compile/compile.h"
#include "image/temporary_folder.h"
#include "kernel/statistics.h"
#include "render/backend.h"
#include "render/emitters.h"
#include "render/estimates.h"
#include "render/lights.h"
#include "render/path_tracers.h"
#include "sanitized.h"

namespace brume {
namespace {

constexpr double pi = std::numbers::pi;

CompiledScene compiled(const SceneDescription& scene) {
  std::vector<Diagnostic> warnings;
  return compile(scene, 1, warnings);
}

// As estimate(), of a scene in which something was changed after compiling.
Estimate estimate_compiled(CompiledScene scene, int edge) {
  scene.width = scene.height = edge;
  const auto backend = make_cpu_backend();
  backend->prepare(scene);
  Film film(edge, edge);
  backend->render(0, 1, 2, film, [](double) { return true; });
  const Image image = film.image();
  double sum = 0, squares = 0;
  const double n = edge * edge;
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    const auto v = static_cast<double>(image.pixels[i]);
    sum += v;
    squares += v * v;
  }
  return {sum / n, std::sqrt((squares / n - sum * sum / n / n) / (n - 1))};
}

class Lights : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(PathTracers, Lights, path_tracers(), integrator_name);

// E = pi L R^2 / (R^2 + h^2) on the axis of a disk.
// Catches a disk that sends out no light on its front, or some on its back, and light as strong along a disk as ahead.
// The twins are turned round but shine on both sides, or are what a disk without a cosine would give.
TEST_P(Lights, DiskGivesItsIrradiance) {
  const double expected = 0.5 * 0.36 / (0.36 + 1);
  const SceneDescription lit = lit_square(GetParam(), {emitter(DiskShape{0.6, 0, 0, 360}, translate({0, 0, -1}))});
  expect_estimate(lit, expected, 0, 1e-3);
  SceneDescription away =
      lit_square(GetParam(), {emitter(DiskShape{0.6, 0, 0, 360}, translate({0, 0, -1}) * rotate(180, {1, 0, 0}))});
  EXPECT_EQ(estimate(away, 10000).mean, 0);
  away.shapes[0].light->two_sided = true;
  EXPECT_GT(estimate(away, 10000).mean, 0);
  expect_rejected(lit, 1 - 1 / std::sqrt(1 + 0.36));
}

// A ring is a disk less another, and half of it gives half.
// Catches points that are spread evenly over the radius and not over the area. The twin is the irradiance of those: the
// area times the mean of 1 / (1 + r^2)^2 over the radii.
TEST_P(Lights, HalfARingGivesItsIrradiance) {
  const double expected = 0.25 * (0.36 / (0.36 + 1) - 0.09 / (0.09 + 1));
  const SceneDescription ring = lit_square(GetParam(), {emitter(DiskShape{0.6, 0, 0.3, 180}, translate({0, 0, -1}))});
  expect_estimate(ring, expected, 0, 1e-3);
  const auto integral = [](double r) { return 0.5 * (r / (1 + r * r) + std::atan(r)); };
  expect_rejected(ring, 0.25 * (0.36 - 0.09) * (integral(0.6) - integral(0.3)) / 0.3);
}

// E = pi L (R / d)^2, and by reciprocity the light's power says nothing else.
// Catches a cosine at the square that is the one to the sphere's middle for the whole of its solid angle, and points
// that are spread over the disk that is seen at the middle's distance. The twins are what these would give.
TEST_P(Lights, SphereGivesItsIrradiance) {
  const SceneDescription s = lit_square(GetParam(), {emitter(SphereShape{0.7}, translate({0, 0, -2}))});
  expect_estimate(s, 0.5 * 0.49 / 4, 0, 1e-3);
  expect_rejected(s, 0.5 * 2 * (1 - std::sqrt(1 - 0.49 / 4)));
  expect_rejected(s, 0.5 * 0.49 / (4 + 0.49));
}

// A sphere light has the irradiance of a point light of its intensity, E = I / d^2, whatever its size.
// Catches a radiance for which the intensity is divided by the area of the sphere, and one for which it is divided by
// pi alone. The twins are what these would give.
TEST_P(Lights, SphereLightIsASphereOfItsIntensity) {
  SceneDescription s = lit_square(GetParam(), {});
  for (const double radius : {0.2, 0.9}) {
    s.lights = {{SphereLight{{0, 0, -2}, radius, constant_spectrum(3)}, {}}};
    expect_estimate(s, 0.5 / pi * 3 / 4, 0, 1e-3);
    expect_rejected(s, 0.5 / pi * 3 / 4 / 4);
    expect_rejected(s, 0.5 / pi * 3 / 4 * radius * radius);
  }
}

TEST_P(Lights, AmbientLightIsWarnedOfOnce) {
  SceneDescription s = lit_square(GetParam(), {});
  s.lights.assign(2, {AmbientLight{constant_spectrum(1)}, {}});
  std::vector<Diagnostic> warnings;
  compile(s, 1, warnings);
  EXPECT_EQ(warnings.size(), 1u);
  EXPECT_EQ(radiance(s), 0);
  s.integrator.name = "classic";
  compile(s, 1, warnings);
  EXPECT_EQ(warnings.size(), 1u);
}

// The power of a sphere whose area is 4 pi r^2 is pi L times that, and 10 by `power`.
// Catches a power that is shared out over the area before the sphere's transform, or over the half-space's 2 pi where
// its integral of the cosine, pi, is due. The twins are what these would give.
TEST_P(Lights, PowerMakesTheRadiance) {
  ShapeDescription sphere = emitter(SphereShape{0.5}, translate({0, 0, -2}) * scale({1.4, 1.4, 1.4}));
  sphere.light->power = 10;
  const SceneDescription s = lit_square(GetParam(), {sphere});
  const double expected = 0.5 * 0.49 / 4 * 10 / (4 * pi * pi * 0.49);
  expect_estimate(s, expected, 0, 1e-3);
  for (const double faulty : {1.4 * 1.4, 0.5}) expect_rejected(s, faulty * expected);
}

// The square under each of the emitters and a sky of radiance 1 shows its reflectance; with the fault planted it does
// not.
void expect_unseen(const char* integrator, const std::vector<Emitters>& all, void (*plant)(CompiledScene&)) {
  for (const Emitters& emitters : all) {
    std::printf("%s\n", emitters.name);
    SceneDescription s = lit_square(integrator, emitters.shapes);
    s.lights = {sky(1)};
    expect_estimate(s, 0.5, 0, 2e-3);
    if (sanitized) continue;
    CompiledScene faulty = compiled(s);
    plant(faulty);
    const Estimate e = estimate_compiled(std::move(faulty), 600);
    EXPECT_GT(std::abs(e.mean - 0.5), 8 * e.standard_error) << emitters.name;
  }
}

// Emitters of radiance 1 under a sky of radiance 1 cannot be seen, nor can what they light: a grey square shows its
// reflectance. So for every kind of emitter, alone or with others, in view of the square or around it.
// Catches a density of light sampling that is not that of the samples, or not that of the weights against the surface's
// own directions. The twin draws points of larger quadrics than rays meet, or takes a mesh for larger than it is.
TEST_P(Lights, EmittersAsBrightAsTheSkyCannotBeSeen) {
  expect_unseen(GetParam(), emitter_cases(), [](CompiledScene& faulty) {
    if (faulty.quadrics.empty()) faulty.lights.back().area *= 1.5f;
    for (CompiledQuadric& q : faulty.quadrics) q.world_from_object = q.world_from_object * scale({1.4, 1.4, 1.4});
  });
}

// Nor can emitters with holes, through which the sky is seen, or another part of them. The twin's points shine as if
// there were no holes.
TEST_P(Lights, EmittersWithHolesAsBrightAsTheSkyCannotBeSeen) {
  expect_unseen(GetParam(), cut_out_emitter_cases(), [](CompiledScene& faulty) {
    for (CompiledLight& light : faulty.lights) light.alpha = -1;
  });
}

// Where a sample goes, a ray that meets the light has the sample's density.
TEST(LightSamples, HaveTheDensityOfTheirRays) {
  std::vector<Emitters> cases = emitter_cases();
  for (Emitters& emitters : cut_out_emitter_cases()) cases.push_back(std::move(emitters));
  for (const Emitters& emitters : cases) {
    const CompiledScene scene = compiled(lit_square("reference", emitters.shapes));
    const Intersector intersector(scene);
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
      RandomStream random(scene, 0, 0, i);
      const int picked = i % static_cast<int>(scene.lights.size());
      const CompiledLight& light = scene.lights[static_cast<std::size_t>(picked)];
      const LightSample s = sample_light(scene, light, {0.05f, -0.1f, -0.02f}, nullptr, random);
      SurfaceHit hit;
      if (is_zero(s.value) || !intersector.nearest_surface({s.ray.origin, s.ray.direction}, hit)) continue;
      if (scene.shapes[static_cast<std::size_t>(hit.shape)].light != picked) continue;
      if (std::abs(hit.t - s.ray.t_max) > 3e-4f) continue;  // another part of it is in front
      // The ray's end is a little off the light: where it grazes, the ray meets another place.
      if (std::abs(dot(hit.normal, s.ray.direction)) < 0.2f) continue;
      ++met;
      EXPECT_NEAR(light_pdf(scene, light, s.ray, nullptr, hit), s.pdf, 2e-3f * s.pdf) << emitters.name;
    }
    EXPECT_GT(met, 200) << emitters.name;
  }
}

// The same in a medium that scatters forwards, where directions are those of the phase function.
// Catches weights of these and of light sampling that do not sum to 1. The twin's tube is seen with a fifth less.
TEST_P(Lights, EmittersAsBrightAsTheSkyCannotBeSeenInFog) {
  SceneDescription s = needle_scene({0, 0, -4});
  s.integrator.name = GetParam();
  s.integrator.max_depth = 1000;
  s.media = {homogeneous_medium("fog", 0, 0.7f)};
  set_phase(s.media[0], "henyey_greenstein", {0.6f});
  for (const Emitters& emitters : emitter_cases())
    if (std::string(emitters.name) == "several") s.shapes = emitters.shapes;
  // Of the light that black emitters stop, they send out as much.
  s.shapes.push_back(sphere_shape({0, 0, 0}, 3, "fog"));
  s.lights = {sky(1)};
  expect_estimate(s, 1, 0, 2e-3);
  s.shapes[0].light->radiance = constant_spectrum(0.8f);
  expect_rejected(s, 1);
}

// Images. Their pixels are random, so that no symmetry hides a fault.
class Images : public ::testing::Test {
 protected:
  std::string write(int width, int height, std::uint32_t seed, float constant = 0) {
    std::mt19937 random(seed);
    Image image{width, height, {}};
    for (int i = 0; i < 3 * width * height; ++i)
      image.pixels.push_back(constant > 0 ? constant : std::pow(static_cast<float>(random() >> 8) * 0x1p-24f, 4.0f));
    const std::string path = folder_.file("sky" + std::to_string(files_++) + ".pfm");
    write_image(path, image, {});
    return path;
  }

  static SceneDescription scene(const char* integrator, const std::string& path) {
    SceneDescription s = lit_square(integrator, {});
    s.lights = {{InfiniteLight{constant_spectrum(1), path, rotate(30, {1, 2, 3}), 0}, {}}};
    return s;
  }

  TemporaryFolder folder_;
  int files_ = 0;
};

// What a facing square of reflectance 0.5 sends back, by quadrature over directions of the half-space.
double reflected(const CompiledScene& scene, double turn) {
  constexpr int rings = 600, sectors = 1200;
  double sum = 0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double z = -std::sqrt((i + 0.5) / rings), r = std::sqrt(1 - z * z);  // equal steps of the cosine's integral
      const double phi = 2 * pi * (j + 0.5) / sectors + turn;
      const kernel::vec3 d(static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                           static_cast<float>(z));
      sum += static_cast<double>(environment_radiance(scene, scene.lights[0], {{0, 0, 0}, d})[0]);
    }
  return 0.5 * sum / (rings * sectors);
}

// Catches an image that is not turned as its light is. The twin is the same image, turned.
TEST_F(Images, LightAsTheirPixelsSay) {
  for (const int width : {16, 32}) {
    SceneDescription s = scene("reference", write(width, 16, 7));
    const double expected = reflected(compiled(s), 0);
    expect_estimate(s, expected, 1e-3 * expected, 2e-3);
    std::get<InfiniteLight>(s.lights[0].kind).world_from_light = rotate(120, {1, 2, 3});
    expect_rejected(s, expected);
  }
}

// Catches densities per solid angle that are not those of the pixels' directions. The twin takes the directions of an
// equal-area image from the table of an equirectangular one, and the other way round.
TEST_F(Images, OfOneColourAreTheConstantSky) {
  for (const int width : {8, 16}) {
    const SceneDescription s = scene("reference", write(width, 8, 0, 0.75f));
    expect_estimate(s, 0.375, 0, 1e-3);
    if (sanitized) continue;
    CompiledScene faulty = compiled(s);
    SphereMap& map = faulty.environments[0].map;
    map = map == SphereMap::equal_area ? SphereMap::equirectangular : SphereMap::equal_area;
    const Estimate e = estimate_compiled(std::move(faulty), 300);
    EXPECT_GT(std::abs(e.mean - 0.375), 8 * e.standard_error) << width;
  }
}

// Catches an image whose illuminance is that of another hemisphere or of all directions, or is a sum without the
// cosine: the image is brightest about its top and not black below. The twins are what the last two would show. pbrt's
// sum over pixels' centres is exact to a few thousandths.
TEST_F(Images, AreScaledToTheirIlluminance) {
  Image image{64, 32, {}};
  for (const float band : {0.3f, 0.1f, 0.15f, 0.15f})  // of 45 degrees each
    image.pixels.insert(image.pixels.end(), std::size_t{3} * 64 * 8, band);
  const std::string path = folder_.file("dome.pfm");
  write_image(path, image, {});
  SceneDescription s = scene("reference", path);
  auto& light = std::get<InfiniteLight>(s.lights[0].kind);
  light.world_from_light = rotate(180, {1, 0, 0});  // its +z is where the square faces
  light.illuminance = 5;
  expect_estimate(s, 0.5 * 5 / pi, 3e-3, 1e-3);
  const double unit = pi * (0.5 * 0.3 + 0.5 * 0.1), of_all_directions = unit + pi * 0.15,
               without_cosine = 2 * pi * (0.3 * (1 - std::sqrt(0.5)) + 0.1 * std::sqrt(0.5));
  for (const double faulty : {of_all_directions, without_cosine})
    expect_rejected(s, {{0.5 * 5 / pi * unit / faulty, 3e-3}}, 1e-3);
}

// pbrt's orientation: +z is the middle of an equal-area image and the top of an equirectangular one; +x is to the right
// of the middle and at the left edge, +y below the middle and a quarter to the right.
TEST_F(Images, HaveTheirDirectionsWherePbrtHasThem) {
  const auto pixel_at = [&](int width, int height, kernel::vec3 d) {
    Image image{width, height, {}};
    for (int i = 0; i < 3 * width * height; ++i) image.pixels.push_back(static_cast<float>(i / 3));
    const std::string path = folder_.file("numbers.pfm");
    write_image(path, image, {});
    SceneDescription s = scene("reference", path);
    std::get<InfiniteLight>(s.lights[0].kind).world_from_light = Transform();
    const CompiledScene c = compiled(s);
    const int n = static_cast<int>(environment_radiance(c, c.lights[0], {{0, 0, 0}, d})[0]);
    return std::pair(n % width, n / width);
  };
  EXPECT_EQ(pixel_at(5, 5, {0, 0, 1}), std::pair(2, 2));
  EXPECT_EQ(pixel_at(5, 5, {1, 0, 0}), std::pair(4, 2));
  EXPECT_EQ(pixel_at(5, 5, {0, 1, 0}), std::pair(2, 4));
  EXPECT_EQ(pixel_at(5, 5, {0, -1, 0}), std::pair(2, 0));
  EXPECT_EQ(pixel_at(5, 5, normalize(kernel::vec3(0.5f, 0.5f, -0.9f))), std::pair(4, 4));
  EXPECT_EQ(pixel_at(16, 8, normalize(kernel::vec3(1, 0.1f, 5))), std::pair(0, 0));
  EXPECT_EQ(pixel_at(16, 8, normalize(kernel::vec3(1, 0.1f, 0.1f))), std::pair(0, 3));
  EXPECT_EQ(pixel_at(16, 8, normalize(kernel::vec3(-0.1f, 1, -0.1f))), std::pair(4, 4));
  EXPECT_EQ(pixel_at(16, 8, normalize(kernel::vec3(-0.1f, -0.1f, -1))).second, 7);
}

// Pearson's test of 10^6 directions against the light's own density.
// Catches a table of directions that is not made of the pixels of the image: that of the twin has a fifth of its
// brightest pixel in its darkest.
TEST_F(Images, AreSampledByTheirDensity) {
  for (const int width : {16, 32}) {
    const CompiledScene c = compiled(scene("reference", write(width, 16, 3)));
    CompiledScene other = c;
    const std::size_t bins = static_cast<std::size_t>(width) * 16;
    // Pixel numbers for radiance, with the table that was made for the image.
    for (std::size_t i = 0; i < bins; ++i)
      for (std::size_t k = 0; k < 3; ++k) other.environments[0].pixels[3 * i + k] = static_cast<float>(i + 1);
    std::vector<double> counts(bins), chances(bins);
    const CompiledEnvironment& e = c.environments[0];
    double total = 0;
    for (std::size_t i = 0; i < bins; ++i) {
      chances[i] = static_cast<double>(e.pixels[3 * i] + e.pixels[3 * i + 1] + e.pixels[3 * i + 2]) *
                   static_cast<double>(e.pixel_solid_angle[i / static_cast<std::size_t>(width)]);
      total += chances[i];
    }
    for (double& p : chances) p /= total;
    constexpr int n = 1000000;
    for (int i = 0; i < n; ++i) {
      RandomStream random(other, 0, 0, i);
      const LightSample s = sample_light(other, other.lights[0], {0, 0, 0}, nullptr, random);
      const double number = std::round(static_cast<double>(s.value[0] * s.pdf));
      counts[static_cast<std::size_t>(number) - 1] += 1;
      if (i % 1000 == 0) {
        ASSERT_NEAR(light_pdf(other, other.lights[0], s.ray, nullptr, {}), s.pdf, 1e-4f * s.pdf);
      }
    }
    const double freedom = static_cast<double>(bins) - 1;
    EXPECT_GT(chi_squared_p_value(chi_squared(counts, chances, n), freedom), sidak(0.01, 3));
    std::vector<double> fault = chances;
    const auto bright = std::max_element(fault.begin(), fault.end());
    const double moved = 0.2 * *bright;
    *bright -= moved;
    *std::min_element(fault.begin(), fault.end()) += moved;
    EXPECT_GT(noncentrality(chances, fault, n), 100);
    EXPECT_LT(chi_squared_p_value(chi_squared(counts, fault, n), freedom), 1e-6);
  }
}

// Lights are drawn as often as they say, and nine tenths of it in proportion to power.
// Catches lights that are all drawn alike, as in the twin.
TEST(LightChoices, FollowPower) {
  SceneDescription s = needle_scene();
  for (int i = 1; i <= 150; ++i) s.lights.push_back(point_light({0, 0, 0}, static_cast<float>(i)));
  const CompiledScene c = compiled(s);
  constexpr int n = 1000000;
  std::vector<double> counts(150), chances, even(150, 1.0 / 150);
  for (const CompiledLight& light : c.lights) chances.push_back(static_cast<double>(light.chance));
  EXPECT_NEAR(chances[149], 0.1 / 150 + 0.9 * 150 / (75 * 151), 1e-6);
  for (int i = 0; i < n; ++i) {
    RandomStream random(c, 0, 0, i);
    const LightChoice choice = choose_light(c, random.next());
    ++counts[static_cast<std::size_t>(choice.index)];
  }
  EXPECT_GT(chi_squared_p_value(chi_squared(counts, chances, n), 149), sidak(0.01, 3));
  EXPECT_LT(chi_squared_p_value(chi_squared(counts, even, n), 149), 1e-6);
}

}  // namespace
}  // namespace brume

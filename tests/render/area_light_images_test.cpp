// Area lights with images: what shadow rays find of them is what rays see that meet them, on every kind of shape, and
// their power is that of the image's mean. The faults this catches: a point that is drawn and a point that is hit with
// another (u, v); images upside down or mirrored; a mean of something else. The twins turn the images.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "compile/compile.h"
#include "image/image.h"
#include "image/temporary_folder.h"
#include "render/emitters.h"
#include "render/estimates.h"
#include "render/lights.h"
#include "sanitized.h"

namespace brume {
namespace {

constexpr double pi = std::numbers::pi;
constexpr const char* integrators[] = {"classic", "reference", "volpath"};

CompiledScene compiled(const SceneDescription& scene) {
  std::vector<Diagnostic> warnings;
  return compile(scene, 1, warnings);
}

// What the square sends back, by quadrature over the directions from which light comes to it.
std::vector<Expected> reflected(const CompiledScene& scene) {
  constexpr int rings = 400, sectors = 800;
  const Intersector intersector(scene);
  Spectrum total;
  for (int i = 0; i < rings; ++i) {
    Spectrum ring;
    for (int j = 0; j < sectors; ++j) {
      const double z = -std::sqrt((i + 0.5) / rings), r = std::sqrt(1 - z * z);  // equal steps of the cosine's integral
      const double phi = 2 * pi * (j + 0.5) / sectors;
      const kernel::vec3 d(static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                           static_cast<float>(z));
      SurfaceHit hit;
      if (intersector.nearest_surface({{0, 0, -1e-4f}, d}, hit)) ring = ring + emitted_radiance(scene, hit, d);
    }
    total = total + (0.5f / (rings * sectors)) * ring;
  }
  std::vector<Expected> expected;
  for (int c = 0; c < channel_count; ++c) {
    const auto value = static_cast<double>(total[c]);
    expected.push_back({value, 2e-3 * value});
  }
  return expected;
}

class AreaLightImages : public ::testing::Test {
 protected:
  using Pixel = std::function<Spectrum(int column, int row)>;

  std::string write(int width, int height, const Pixel& pixel) {
    Image image{width, height, {}};
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < width; ++column)
        for (int c = 0; c < channel_count; ++c) image.pixels.push_back(pixel(column, row)[c]);
    const std::string path = folder_.file("lamp" + std::to_string(files_++) + ".pfm");
    write_image(path, image, {});
    return path;
  }

  // Without any symmetry; or that turned upside down.
  std::string write_random(bool turned = false) {
    std::mt19937 random(5);
    std::vector<Spectrum> pixels(20);
    for (Spectrum& p : pixels)
      for (int c = 0; c < channel_count; ++c)
        p[c] = 0.02f + std::pow(static_cast<float>(random() >> 8) * 0x1p-24f, 2.0f);
    return write(5, 4, [&](int column, int row) {
      const int i = 5 * row + column;
      return pixels[static_cast<std::size_t>(turned ? 19 - i : i)];
    });
  }

  static std::vector<Emitters> cases() {
    std::vector<Emitters> all = emitter_cases();
    TriangleMeshShape mesh{{{-1, -0.5, -1}, {1, -1, -1.2}, {0.2, 1, -0.8}, {-0.9, 0.9, -1.5}},
                           {{0, 1, 2}, {0, 2, 3}},
                           {},
                           {{0, 0}, {2, 0.1}, {0.8, 0.9}, {-0.2, 1}}};
    BilinearMeshShape patch{{{-0.9, -0.8, -1.2}, {0.8, -1, -0.4}, {-1, 0.9, -0.3}, {1, 0.7, -1.5}},
                            {{0, 1, 2, 3}},
                            {},
                            {{0.1, 0}, {0.9, 0.2}, {0, 0.7}, {1, 1}}};
    all.push_back({"mesh with uv", {emitter(mesh, Transform(), true)}});
    all.push_back({"patch with uv", {emitter(patch, Transform(), true)}});
    return all;
  }

  static std::vector<ShapeDescription> with_image(std::vector<ShapeDescription> shapes, const std::string& path) {
    for (ShapeDescription& s : shapes) s.light->filename = path;
    return shapes;
  }

  TemporaryFolder folder_;
  int files_ = 0;
};

// A quad of radiance 2 at z = -1; or the same, its image turned.
ShapeDescription lamp(bool turned) {
  ShapeDescription s = emitter(QuadShape{{-0.2, -0.5, -1}, {1.4, 0, 0}, {0, 1.6, 0}}, Transform());
  if (turned) s.kind = QuadShape{{1.2, 1.1, -1}, {-1.4, 0, 0}, {0, -1.6, 0}};
  s.light->radiance = constant_spectrum(2);
  return s;
}

// What the square sends back of its light, where its image has 2 x 2 pixels, between whose centres they mix: in the
// first channel dark ones on the left and bright ones on the right, in the second below and above, then all bright.
std::vector<Expected> reflected_of_lamp() {
  const auto ramp = [](double t) { return std::clamp(2 * t - 0.5, 0.0, 1.0); };
  constexpr int steps = 500;
  std::vector<Expected> expected(3, {0, 0});
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double u = (i + 0.5) / steps, v = (j + 0.5) / steps, x = -0.2 + 1.4 * u, y = -0.5 + 1.6 * v;
      const double squared = x * x + y * y + 1, share = 0.5 / pi * 2 * 1.4 * 1.6 / (squared * squared * steps * steps);
      expected[0].value += share * ramp(u);
      expected[1].value += share * ramp(v);
      expected[2].value += share;
    }
  for (Expected& e : expected) e.rounding = 1e-4 * e.value;
  return expected;
}

TEST_F(AreaLightImages, GiveAQuadItsIrradiance) {
  const std::string path = write(2, 2, [](int column, int row) {
    return Spectrum{{static_cast<float>(column), static_cast<float>(1 - row), 1}};
  });
  const std::vector<Expected> expected = reflected_of_lamp();
  for (const char* integrator : integrators) {
    expect_estimates(lit_square(integrator, with_image({lamp(false)}, path)), expected, 2e-3);
    expect_rejected(lit_square(integrator, with_image({lamp(true)}, path)), expected, 2e-3);
  }
}

// Before black, holes are as good as dark pixels.
TEST_F(AreaLightImages, CutHolesAsDarkAsTheirPixels) {
  ImageTexture image;
  image.wrap = ImageTexture::Wrap::clamp;
  image.filename = write(2, 1, [](int column, int) { return constant_spectrum(static_cast<float>(column)); });
  const std::vector<Expected> expected = {reflected_of_lamp()[0]};
  const auto scene = [&](const char* integrator, bool turned) {
    SceneDescription s = lit_square(integrator, {lamp(turned)});
    s.textures = {{"alpha", true, image, {}}};
    s.shapes[0].alpha.texture = 0;
    return s;
  };
  for (const char* integrator : integrators) {
    expect_estimates(scene(integrator, false), expected, 2e-3);
    expect_rejected(scene(integrator, true), expected, 2e-3);
  }
}

TEST_F(AreaLightImages, LightAsRaysSeeThem) {
  const std::string path = write_random(), turned = write_random(true);
  for (const Emitters& emitters : cases()) {
    std::printf("%s\n", emitters.name);
    const auto scene = [&](const char* integrator, const std::string& image) {
      return lit_square(integrator, with_image(emitters.shapes, image));
    };
    const std::vector<Expected> expected = reflected(compiled(scene("reference", path)));
    for (const char* integrator : integrators) expect_estimates(scene(integrator, path), expected, 2e-3);
    if (!sanitized) expect_rejected(scene("classic", turned), expected, 2e-3);
  }
}

// Sample by sample: the radiance that is drawn is that of the place which the ray to it meets.
TEST_F(AreaLightImages, AreDrawnWhereRaysMeetThem) {
  const std::string path = write_random();
  for (const Emitters& emitters : cases()) {
    const CompiledScene scene = compiled(lit_square("reference", with_image(emitters.shapes, path)));
    const Intersector intersector(scene);
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
      RandomStream random(scene, 0, 0, i);
      const auto picked = static_cast<std::size_t>(i) % scene.lights.size();
      const LightSample s = sample_light(scene, scene.lights[picked], {0.05f, -0.1f, -0.02f}, nullptr, random);
      SurfaceHit hit;
      if (is_zero(s.value) || !intersector.nearest_surface({s.ray.origin, s.ray.direction}, hit)) continue;
      if (scene.shapes[static_cast<std::size_t>(hit.shape)].light != static_cast<int>(picked)) continue;
      // Another part of the light is in front, or the ray grazes it and meets it elsewhere.
      if (std::abs(hit.t - s.ray.t_max) > 1e-3f || std::abs(dot(hit.normal, s.ray.direction)) < 0.2f) continue;
      ++met;
      const Spectrum seen = emitted_radiance(scene, hit, s.ray.direction);
      for (int c = 0; c < channel_count; ++c) EXPECT_NEAR(s.pdf * s.value[c], seen[c], 2e-3f) << emitters.name;
    }
    EXPECT_GT(met, 200) << emitters.name;
  }
}

// The total is that of a lamp of one colour, whatever the image, and the choice among lights follows the image's mean.
TEST_F(AreaLightImages, HavePowerByTheirMean) {
  ShapeDescription bright = emitter(QuadShape{}, translate({0, 0, -1})), dim = bright;
  dim.light->filename = write(4, 1, [](int column, int) { return constant_spectrum(column == 0 ? 1.0f : 0); });
  const CompiledScene chosen = compiled(lit_square("reference", {bright, dim}));
  EXPECT_NEAR(chosen.lights[0].chance, 0.05 + 0.9 * 0.8, 1e-6);
  EXPECT_NEAR(chosen.lights[1].chance, 0.05 + 0.9 * 0.2, 1e-6);
  dim.light->power = 10;
  dim.light->two_sided = true;
  EXPECT_NEAR(compiled(lit_square("reference", {dim})).lights[0].value[0], 10 / (2 * pi * 4 * 0.25), 1e-5);
  dim.light->filename = write(1, 1, [](int, int) { return Spectrum{{0, 0.5f, 0}}; });
  EXPECT_NEAR(compiled(lit_square("reference", {dim})).lights[0].value[0], 10 / (2 * pi * 4 * 0.5 * 0.7152), 1e-3);
  dim.light->filename = write(1, 1, [](int, int) { return Spectrum{}; });
  EXPECT_EQ(compiled(lit_square("reference", {dim})).lights[0].value[0], 1);
}

TEST_F(AreaLightImages, ThatCannotBeUsedAreToldOfOnce) {
  const auto lamps = [](const std::string& path) {
    return lit_square("reference",
                      with_image({emitter(SphereShape{}, Transform()), emitter(DiskShape{}, Transform())}, path));
  };
  const auto error = [&](const std::string& path) { return error_of([&] { compiled(lamps(path)); }); };
  const std::string missing = error(folder_.file("none.exr"));
  EXPECT_NE(missing.find("the image of AreaLightSource \"diffuse\": "), std::string::npos) << missing;
  EXPECT_EQ(missing.find("none.exr"), missing.rfind("none.exr")) << missing;
  const std::string infinite = error(write(1, 1, [](int, int) { return constant_spectrum(INFINITY); }));
  EXPECT_NE(infinite.find("has pixels that are infinite or not a number"), std::string::npos) << infinite;
  const std::string path = write(2, 1, [](int column, int) { return constant_spectrum(column == 0 ? -3.0f : 1); });
  std::vector<Diagnostic> warnings;
  const CompiledScene scene = compile(lamps(path), 1, warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].message, path + " has negative pixels; they are taken as 0");
  EXPECT_NEAR(scene.lights[0].chance, 0.05 + 0.9 * 4 / 5, 1e-3);  // by areas of 4 pi and pi
}

}  // namespace
}  // namespace brume

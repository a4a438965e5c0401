// The picture is a function of the scene and the seed: not of threads, nor of how the samples are split into calls.
#include <gtest/gtest.h>

#include "compile/compile.h"
#include "render/backend.h"
#include "render/scenes.h"

namespace brume {
namespace {

// Surfaces, a homogeneous medium in a sphere, a free grid that overlaps it, all kinds of lights; 40 x 24 pixels.
SceneDescription busy_scene(SamplerDescription::Kind sampler = SamplerDescription::Kind::zsobol) {
  SceneDescription s;
  s.sampler.kind = sampler;
  s.film.width = 40;
  s.film.height = 24;
  s.sampler.seed = 7;
  s.camera.world_from_camera = translate({0, 0.5, -4});
  s.camera.fov = 50;
  s.integrator.max_depth = 2;
  s.integrator.placement = Placement::random;
  s.integrator.step = 0.1;
  std::vector<float> density(8 * 8 * 8);
  for (std::size_t i = 0; i < density.size(); ++i) density[i] = static_cast<float>((i * 37) % 11) / 11;
  s.media = {homogeneous_medium("fog", 0.1f, 0.5f),
             grid_medium("smoke", {-1, -0.5, -1}, {1, 1, 1}, {8, 8, 8}, density, 1, 2)};
  set_phase(s.media[1], "henyey_greenstein", {0.5f});
  s.shapes = {square_facing_y({0, -1, 0}, 6, 0.6f), sphere_shape({0.5, 0, 0}, 0.9, "fog"), free_volume("smoke"),
              square_facing_z({0, 1, 3}, 2, 0.3f)};
  s.shapes[3].material =
      BlinnPhongMaterial{constant_spectrum(0.2f), constant_spectrum(0.3f), constant_spectrum(0.4f), 20};
  s.lights = {sky(0.3f), distant_light({1, 2, -1}, 1), point_light({-1, 1, -1}, 1)};
  return s;
}

constexpr SamplerDescription::Kind samplers[] = {SamplerDescription::Kind::independent,
                                                 SamplerDescription::Kind::zsobol};

TEST(Determinism, AnyNumberOfThreadsGivesTheSameBits) {
  for (const auto sampler : samplers) {
    const Image one = render_film(busy_scene(sampler), 3, 1).image();
    for (const int threads : {2, 3, 8}) {
      const Image many = render_film(busy_scene(sampler), 3, threads).image();
      EXPECT_EQ(many.pixels, one.pixels);
      EXPECT_EQ(many.alpha, one.alpha);
      EXPECT_EQ(many.depth, one.depth);
    }
  }
}

TEST(Determinism, AnySplitOfTheSamplesGivesTheSameBits) {
  for (const auto sampler : samplers) {
    std::vector<Diagnostic> warnings;
    const CompiledScene compiled = compile(busy_scene(sampler), 1, warnings);
    const auto backend = make_cpu_backend();
    backend->prepare(compiled);
    const auto render = [&](const std::vector<int>& ends) {
      Film film(compiled.width, compiled.height);
      int first = 0;
      for (const int last : ends) {
        backend->render(first, last, 2, film, [](double) { return true; });
        first = last;
      }
      return film.image().pixels;
    };
    EXPECT_EQ(render({1, 2, 3, 4, 5}), render({5}));
    EXPECT_EQ(render({2, 5}), render({5}));
  }
}

TEST(Determinism, AnotherSeedGivesAnotherPicture) {
  SceneDescription s = busy_scene();
  const Image one = render_film(s, 1).image();
  s.sampler.seed = 8;
  EXPECT_NE(render_film(s, 1).image().pixels, one.pixels);
}

// The pixels of `box` in the picture of a film.
std::vector<float> part(const Film& film, const PixelBox& box) {
  const Image image = film.image();
  std::vector<float> pixels;
  for (int y = box.y0; y < box.y1; ++y) {
    const auto row = image.pixels.begin() + 3 * (y * image.width + box.x0);
    pixels.insert(pixels.end(), row, row + 3 * box.width());
  }
  return pixels;
}

// Twins: a window that is off by one pixel or row, and random numbers that count the window's pixels.
TEST(Determinism, ACropWindowHasThePixelsOfTheWholePicture) {
  for (const auto sampler : samplers)
    for (const char* integrator : {"classic", "reference", "volpath"}) {
      SceneDescription s = busy_scene(sampler);
      s.integrator.name = integrator;
      const Film whole = render_film(s, 2);
      s.film.crop_window = {0.3, 0.81, 0.25, 0.75};
      const PixelBox window{12, 33, 6, 18};
      EXPECT_EQ(cropped_pixels(s.film), window);
      const std::vector<float> expected = part(whole, window);
      EXPECT_EQ(render_film(s, 2, 2).image().pixels, expected);

      const auto with_fault = [&](auto&& plant) {
        std::vector<Diagnostic> warnings;
        CompiledScene compiled = compile(s, 1, warnings);
        plant(compiled);
        const auto backend = make_cpu_backend();
        backend->prepare(compiled);
        Film film(window.width(), window.height());
        backend->render(0, 2, 1, film, [](double) { return true; });
        return film.image().pixels;
      };
      EXPECT_EQ(with_fault([](CompiledScene&) {}), expected);
      EXPECT_NE(with_fault([](CompiledScene& c) { c.crop.x0 += 1; }), expected);
      EXPECT_NE(with_fault([](CompiledScene& c) { c.crop.y0 += 1; }), expected);
      EXPECT_NE(with_fault([&](CompiledScene& c) { c.width = window.width(); }), expected);
    }
}

TEST(Determinism, CropWindowsThatTileShareNoPixel) {
  FilmDescription film;
  for (const int edge : {1, 2, 3, 7, 49, 640, 65536}) {
    film.width = film.height = edge;
    for (const double cut : {0.0, 0.1, 1.0 / 3, 0.5, 0.6180339887498949, 0.999, 1.0}) {
      film.crop_window = {0, cut, 0, 1};
      const int end = cropped_pixels(film).x1;
      film.crop_window = {cut, 1, 0, 1};
      EXPECT_EQ(cropped_pixels(film).x0, end);
      EXPECT_EQ(cropped_pixels(film).x1, edge);
    }
    // Whole pixels as fractions stay whole pixels.
    for (int x = 0; x <= edge; x += std::max(1, edge / 50)) {
      film.crop_window = {static_cast<double>(x) / edge, 1, 0, 1};
      EXPECT_EQ(cropped_pixels(film).x0, x);
    }
  }
}

TEST(Determinism, AStoppedRenderSaysSo) {
  std::vector<Diagnostic> warnings;
  const CompiledScene compiled = compile(busy_scene(), 1, warnings);
  const auto backend = make_cpu_backend();
  backend->prepare(compiled);
  Film film(compiled.width, compiled.height);
  EXPECT_FALSE(backend->render(0, 1, 1, film, [](double) { return false; }));
  EXPECT_TRUE(backend->render(0, 1, 1, film, [](double) { return true; }));
}

}  // namespace
}  // namespace brume

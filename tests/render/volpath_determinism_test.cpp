// volpath's picture is a function of the scene and the seed alone: not of threads, of how the samples are split into
// calls, nor of the window. Catches sums whose order depends on which paths run beside each other.
#include <gtest/gtest.h>

#include "compile/compile.h"
#include "render/agreement_scenes.h"
#include "render/backend.h"

namespace brume {
namespace {

// Several homogeneous media with lights along them, grids, emission and surfaces: the room for shadow rays runs out in
// the middle of a round.
SceneDescription busy_scene() {
  SceneDescription s;
  for (AgreementScene& a : agreement_scenes())
    if (a.name == "depth_5") s = std::move(a.scene);
  s.film.width = 50;
  s.film.height = 36;
  s.sampler.seed = 5;
  s.media.push_back(homogeneous_medium("haze", 0.05f, 0.1f));
  s.media.push_back(homogeneous_medium("mist", 0.05f, 0.1f));
  s.media.back().emission = constant_spectrum(0.5f);
  s.shapes.push_back(box_shape({-4, -2, -5}, {4, 4, 5}, "haze"));
  s.shapes.push_back(sphere_shape({0, 0, 0}, 3, "mist"));
  s.lights.push_back(point_light({1, 1, -1}, 1));
  s.integrator.name = "volpath";
  return s;
}

CompiledScene compiled(const SceneDescription& scene) {
  std::vector<Diagnostic> warnings;
  return compile(scene, 1, warnings);
}

// After the samples up to each of `ends`, in that many calls.
std::vector<float> pixels(const CompiledScene& scene, const std::vector<int>& ends, int threads) {
  const auto backend = make_cpu_backend();
  backend->prepare(scene);
  Film film(scene.crop.width(), scene.crop.height());
  int first = 0;
  for (const int last : ends) {
    backend->render(first, last, threads, film, [](double) { return true; });
    first = last;
  }
  EXPECT_EQ(film.invalid_samples(), 0);
  EXPECT_EQ(backend->counts().majorant_violations, 0);
  return film.image().pixels;
}

class VolpathDeterminism : public ::testing::TestWithParam<SamplerDescription::Kind> {
 protected:
  SceneDescription scene() const {
    SceneDescription s = busy_scene();
    s.sampler.kind = GetParam();
    return s;
  }
};
INSTANTIATE_TEST_SUITE_P(Samplers, VolpathDeterminism,
                         ::testing::Values(SamplerDescription::Kind::independent, SamplerDescription::Kind::zsobol));

TEST_P(VolpathDeterminism, ThreadsDoNotMatter) {
  const CompiledScene c = compiled(scene());
  const std::vector<float> one = pixels(c, {3}, 1);
  for (const int threads : {2, 3}) EXPECT_EQ(pixels(c, {3}, threads), one);
  SceneDescription other = scene();
  other.sampler.seed = 6;
  EXPECT_NE(pixels(compiled(other), {3}, 1), one);
}

TEST_P(VolpathDeterminism, TheSplitOfTheSamplesDoesNotMatter) {
  const CompiledScene c = compiled(scene());
  const std::vector<float> whole = pixels(c, {3}, 1);
  EXPECT_EQ(pixels(c, {1, 2, 3}, 2), whole);
  EXPECT_EQ(pixels(c, {2, 3}, 1), whole);
}

TEST_P(VolpathDeterminism, ACropWindowHasThePixelsOfTheWholePicture) {
  SceneDescription s = scene();
  const std::vector<float> whole = pixels(compiled(s), {3}, 1);
  s.film.crop_window = {0.3, 0.9, 0.25, 0.8};
  const CompiledScene c = compiled(s);
  const std::vector<float> window = pixels(c, {3}, 2);
  std::vector<float> expected;
  for (int y = c.crop.y0; y < c.crop.y1; ++y)
    expected.insert(expected.end(), whole.begin() + 3 * (y * 50 + c.crop.x0), whole.begin() + 3 * (y * 50 + c.crop.x1));
  EXPECT_EQ(window, expected);
}

}  // namespace
}  // namespace brume

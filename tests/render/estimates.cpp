#include "render/estimates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace brume {

namespace {

constexpr int pilot_samples = 10000;
constexpr double most_samples = 1e9;

// How many samples bring all channels' standard errors to `relative_error` of what is expected, as a pilot says.
int samples_for(const SceneDescription& scene, const std::vector<Expected>& expected, double relative_error) {
  const auto pilot = estimates(scene, pilot_samples);
  double ratio = 0;
  for (std::size_t c = 0; c < expected.size(); ++c)
    ratio = std::max(ratio, pilot[c].standard_error / (relative_error * expected[c].value));
  return static_cast<int>(std::clamp(1.1 * pilot_samples * ratio * ratio, 1.0 * pilot_samples, most_samples));
}

// The pilot must not choose when to stop.
SceneDescription with_another_seed(SceneDescription scene) {
  scene.sampler.seed += 1;
  return scene;
}

}  // namespace

std::array<Estimate, channel_count> estimates(const SceneDescription& scene, int samples) {
  // The pixels of a square film all look through the same needle's eye. Integrators that follow many paths at a time
  // are at their best with several samples a pixel.
  SceneDescription s = scene;
  const int samples_per_pixel = samples < 200000 ? 4 : 64;
  s.film.width = s.film.height = static_cast<int>(std::ceil(std::sqrt(samples / samples_per_pixel)));
  const Image image = render_film(s, samples_per_pixel, 2).image();
  const int n = s.film.width * s.film.height;
  std::array<Estimate, channel_count> result;
  for (std::size_t c = 0; c < result.size(); ++c) {
    double sum = 0, squares = 0;
    for (std::size_t i = c; i < image.pixels.size(); i += channel_count) {
      const auto v = static_cast<double>(image.pixels[i]);
      sum += v;
      squares += v * v;
    }
    const double mean = sum / n;
    result[c] = {mean, n > 1 ? std::sqrt(std::max(0.0, squares / n - mean * mean) / (n - 1)) : 0};
  }
  return result;
}

void expect_estimates(const SceneDescription& scene, const std::vector<Expected>& expected, double relative_error) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  relative_error *= 10;
#endif
  const int samples = samples_for(scene, expected, relative_error);
  const auto found = estimates(with_another_seed(scene), samples);
  for (std::size_t c = 0; c < expected.size(); ++c) {
    const auto& [mean, error] = found[c];
    const auto& [value, rounding] = expected[c];
    const double z = error > 0 ? (mean - value) / error : 0;
    std::printf("mean %.7f, standard error %.7f, expected %.7f, z %+.2f, %d samples\n", mean, error, value, z, samples);
    EXPECT_LE(std::abs(mean - value), 4 * error + rounding + 2e-6 * value) << "channel " << c;
    EXPECT_LE(error, 1.1 * relative_error * value) << "channel " << c;
  }
}

// Few samples first: where a fault is out already at a larger error, it is further out at the one that is asked for.
void expect_rejected(const SceneDescription& scene, const std::vector<Expected>& expected, double relative_error) {
  const int most = samples_for(scene, expected, relative_error);
  double furthest = 0;
  for (int samples = pilot_samples; furthest <= 8; samples = std::min(most, 4 * samples)) {
    const auto found = estimates(with_another_seed(scene), samples);
    for (std::size_t c = 0; c < expected.size(); ++c) {
      const double apart = std::abs(found[c].mean - expected[c].value) - expected[c].rounding;
      furthest = std::max(furthest, apart / std::max(found[c].standard_error, 1e-12));
    }
    if (samples == most) break;
  }
  std::printf("%.1f standard errors out\n", furthest);
  EXPECT_GT(furthest, 8);
}

}  // namespace brume

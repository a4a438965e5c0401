#include "render/estimates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace brume {

Estimate estimate(const SceneDescription& scene, int samples, int channel) {
  // The pixels of a square film all look through the same needle's eye. Integrators that follow many paths at a time
  // are at their best with several samples a pixel.
  SceneDescription s = scene;
  const int samples_per_pixel = samples < 200000 ? 1 : 16;
  s.film.width = s.film.height = static_cast<int>(std::ceil(std::sqrt(samples / samples_per_pixel)));
  const Image image = render_film(s, samples_per_pixel, 2).image();
  double sum = 0, squares = 0;
  const int n = s.film.width * s.film.height;
  for (int i = 0; i < n; ++i) {
    const auto v = static_cast<double>(image.pixels[static_cast<std::size_t>(3 * i + channel)]);
    sum += v;
    squares += v * v;
  }
  const double mean = sum / n;
  return {mean, n > 1 ? std::sqrt(std::max(0.0, squares / n - mean * mean) / (n - 1)) : 0};
}

void expect_estimate(const SceneDescription& scene, double expected, double rounding, double relative_error) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  relative_error *= 10;
#endif
  const int pilot = 10000;
  const Estimate first = estimate(scene, pilot);
  const double ratio = first.standard_error / (relative_error * expected);
  const int samples = static_cast<int>(std::clamp(1.1 * pilot * ratio * ratio, 10000.0, 2e8));
  SceneDescription other = scene;
  other.sampler.seed = scene.sampler.seed + 1;  // the pilot must not choose when to stop
  const Estimate e = estimate(other, samples);
  const double z = e.standard_error > 0 ? (e.mean - expected) / e.standard_error : 0;
  std::printf("mean %.6f, standard error %.6f, expected %.6f, z %+.2f, %d samples\n", e.mean, e.standard_error,
              expected, z, samples);
  EXPECT_LE(std::abs(e.mean - expected), 4 * e.standard_error + rounding + 2e-6 * expected);
  EXPECT_LE(e.standard_error, 1.1 * relative_error * expected);
}

void expect_rejected(const SceneDescription& scene, double expected) {
  const Estimate e = estimate(scene, 400000);
  EXPECT_GT(std::abs(e.mean - expected), 8 * e.standard_error);
}

}  // namespace brume

#include "render/estimates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sanitized.h"

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

namespace {

Estimate mean_of(const std::vector<float>& values, std::size_t first, std::size_t step) {
  double sum = 0, squares = 0;
  const double n = std::ceil(static_cast<double>(values.size() - first) / static_cast<double>(step));
  for (std::size_t i = first; i < values.size(); i += step) {
    const auto v = static_cast<double>(values[i]);
    sum += v;
    squares += v * v;
  }
  const double mean = sum / n;
  return {mean, n > 1 ? std::sqrt(std::max(0.0, squares / n - mean * mean) / (n - 1)) : 0};
}

// The pixels of a square film that all look through the same needle's eye. Integrators that follow many paths at a time
// are at their best with several samples a pixel.
std::vector<float> pixels_of(SceneDescription scene, int samples) {
  const int samples_per_pixel = samples < 200000 ? 4 : 64;
  scene.film.width = scene.film.height = static_cast<int>(std::ceil(std::sqrt(samples / samples_per_pixel)));
  return render_film(scene, samples_per_pixel, 2).image().pixels;
}

double deviation_in_errors(const Estimate& found, const Expected& expected) {
  const double apart = std::abs(found.mean - expected.value) - expected.rounding;
  return apart / std::max(found.standard_error, 1e-12);
}

}  // namespace

Estimates estimates(const SceneDescription& scene, int samples) {
  const std::vector<float> pixels = pixels_of(scene, samples);
  Estimates result;
  for (std::size_t c = 0; c < result.size(); ++c) result[c] = mean_of(pixels, c, channel_count);
  return result;
}

Estimates corrected(const Estimates& of_first, const SceneDescription& first, const std::function<void()>& go_over,
                    const SceneDescription& second, int samples) {
  const std::vector<float> a = pixels_of(first, samples);
  go_over();
  std::vector<float> difference = pixels_of(second, samples);
  for (std::size_t i = 0; i < a.size(); ++i) difference[i] -= a[i];
  Estimates result;
  for (std::size_t c = 0; c < result.size(); ++c) {
    const Estimate d = mean_of(difference, c, channel_count);
    result[c] = {of_first[c].mean + d.mean, std::hypot(of_first[c].standard_error, d.standard_error)};
  }
  return result;
}

void expect_estimates(const Estimates& found, const std::vector<Expected>& expected, double relative_error) {
  for (std::size_t c = 0; c < expected.size(); ++c) {
    const auto& [mean, error] = found[c];
    const auto& [value, rounding] = expected[c];
    const double z = error > 0 ? (mean - value) / error : 0;
    std::printf("mean %.7f, standard error %.7f, expected %.7f, z %+.2f\n", mean, error, value, z);
    EXPECT_LE(std::abs(mean - value), 4 * error + rounding + 2e-6 * value) << "channel " << c;
    EXPECT_LE(error, 1.1 * relative_error * value) << "channel " << c;
  }
}

Estimates expect_estimates(const SceneDescription& scene, const std::vector<Expected>& expected,
                           double relative_error) {
  if (sanitized) relative_error *= 30;
  const int samples = samples_for(scene, expected, relative_error);
  std::printf("%d samples\n", samples);
  const Estimates found = estimates(with_another_seed(scene), samples);
  expect_estimates(found, expected, relative_error);
  return found;
}

// Few samples first: where a fault is out already at a larger error, it is further out at the one that is asked for.
void expect_rejected(const SceneDescription& scene, const std::vector<Expected>& expected, double relative_error) {
  const int most = samples_for(scene, expected, relative_error);
  double furthest = 0;
  for (int samples = pilot_samples; furthest <= 8; samples = std::min(most, 4 * samples)) {
    furthest = std::max(furthest, furthest_out(estimates(with_another_seed(scene), samples), expected));
    if (samples == most) break;
  }
  std::printf("%.1f standard errors out\n", furthest);
  EXPECT_GT(furthest, 8);
}

double furthest_out(const Estimates& found, const std::vector<Expected>& expected) {
  double furthest = 0;
  for (std::size_t c = 0; c < expected.size(); ++c)
    furthest = std::max(furthest, deviation_in_errors(found[c], expected[c]));
  return furthest;
}

}  // namespace brume

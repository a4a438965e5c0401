// Monte Carlo means of scenes of one pixel, judged by their own standard errors.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "render/scenes.h"

namespace brume {

struct Estimate {
  double mean, standard_error;
};

using Estimates = std::array<Estimate, channel_count>;

// The means of `samples` independent samples of the scene's pixel, by channel.
Estimates estimates(const SceneDescription& scene, int samples);
inline Estimate estimate(const SceneDescription& scene, int samples, int channel = 0) {
  return estimates(scene, samples)[static_cast<std::size_t>(channel)];
}

// What a channel must show, and how far the number may be off by its own rounding.
struct Expected {
  double value, rounding;
};

// Estimates for the second of two renderers that follow nearly the same paths, given those of the first: the mean
// difference of `samples` of the same samples by both is added, and its error. `go_over` changes from the first
// renderer to the second. Where hardly a path is another one, few samples are enough.
Estimates corrected(const Estimates& of_first, const SceneDescription& first, const std::function<void()>& go_over,
                    const SceneDescription& second, int samples);

// |mean - expected| <= 4 standard errors + rounding, with as many samples as bring the standard error to
// `relative_error` of the expected value (thirty times that under sanitizers, which look for other faults), in the
// first channels of the scene. Prints mean, error, expected and z.
Estimates expect_estimates(const SceneDescription& scene, const std::vector<Expected>& expected, double relative_error);
void expect_estimates(const Estimates& found, const std::vector<Expected>& expected, double relative_error);
inline void expect_estimate(const SceneDescription& scene, double expected, double rounding, double relative_error) {
  expect_estimates(scene, {{expected, rounding}}, relative_error);
}

// A scene with a planted fault: a mean stands at least 8 standard errors and the rounding from what is expected, at a
// standard error that is no smaller than what is asked for.
void expect_rejected(const SceneDescription& scene, const std::vector<Expected>& expected, double relative_error);
inline void expect_rejected(const SceneDescription& scene, double expected) {
  expect_rejected(scene, {{expected, 0}}, 1e-3);
}

// How many standard errors the worst mean is from what is expected, beyond the rounding.
double furthest_out(const Estimates& found, const std::vector<Expected>& expected);

}  // namespace brume

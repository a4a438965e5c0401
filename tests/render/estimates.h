// Monte Carlo means of scenes of one pixel, judged by their own standard errors.
#pragma once

#include "render/scenes.h"

namespace brume {

struct Estimate {
  double mean, standard_error;
};

// The mean of `samples` independent samples of the scene's pixel, in one channel.
Estimate estimate(const SceneDescription& scene, int samples, int channel = 0);

// |mean - expected| <= 4 standard errors + rounding, with as many samples as bring the standard error to
// `relative_error` of the expected value (ten times that under sanitizers, which look for other faults). Prints mean,
// error, expected and z.
void expect_estimate(const SceneDescription& scene, double expected, double rounding, double relative_error);

// A scene with a planted fault: its mean stands at least 8 standard errors from `expected`.
void expect_rejected(const SceneDescription& scene, double expected);

}  // namespace brume

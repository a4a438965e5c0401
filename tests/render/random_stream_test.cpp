// The samplers as integrators draw from them. Sampler zsobol: the error of a smooth integrand falls faster than that of
// independent points, and over the picture it has little of low frequencies. The fault that both catch, in their twins:
// independent points.
#include "render/random_stream.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace brume {
namespace {

CompiledScene scene_of(SamplerKind sampler, int samples, std::uint32_t seed = 0) {
  CompiledScene scene;
  scene.width = scene.height = 64;
  scene.samples_per_pixel = samples;
  scene.seed = seed;
  scene.sampler = sampler;
  return scene;
}

// A smooth function on the square with integral 1.
double smooth(const RandomStream::Pair& p) {
  const double u = static_cast<double>(p.u), v = static_cast<double>(p.v);
  return (std::exp(u) + 0.5 * std::cos(2 * u + 3 * v)) /
         (std::numbers::e - 1 + 0.5 * (std::cos(2.0) + std::cos(3.0) - 1 - std::cos(5.0)) / 6);
}

// The error of a pixel's estimate from pair number `pair` of its numbers.
double error(const CompiledScene& scene, int x, int y, int pair) {
  double sum = 0;
  for (int s = 0; s < scene.samples_per_pixel; ++s) {
    RandomStream random(scene, x, y, s);
    for (int skipped = 0; skipped < pair; ++skipped) random.next_pair();
    sum += smooth(random.next_pair());
  }
  return sum / scene.samples_per_pixel - 1;
}

double rms_error(SamplerKind sampler, int samples, int pair) {
  double squares = 0;
  constexpr int pixels = 256;
  for (int i = 0; i < pixels; ++i) {
    const double e = error(scene_of(sampler, samples, static_cast<std::uint32_t>(i)), i * 7 % 64, i * 29 % 64, pair);
    squares += e * e;
  }
  return std::sqrt(squares / pixels);
}

// Of log(error) against log(samples), from 4 to 1024.
double slope(SamplerKind sampler, int pair) {
  return std::log(rms_error(sampler, 1024, pair) / rms_error(sampler, 4, pair)) / std::log(256.0);
}

TEST(RandomStream, ErrorFallsFasterThanWithIndependentPoints) {
  for (const int pair : {0, 1, 5, 7}) EXPECT_LT(slope(SamplerKind::zsobol, pair), -1.2) << pair;
}
TEST(RandomStreamTwin, IndependentPointsFallTooSlowly) {
  EXPECT_GT(slope(SamplerKind::independent, 0), -0.6);
  EXPECT_GT(slope(SamplerKind::zsobol, 8), -0.6);  // past the Sobol' dimensions
}

TEST(RandomStream, SampleCountsThatAreNoPowerOfTwoAreGoodToo) {
  for (const int samples : {3, 12, 100})
    EXPECT_LT(rms_error(SamplerKind::zsobol, samples, 0), 0.8 * rms_error(SamplerKind::independent, samples, 0));
}

// The mean power of the low frequencies (up to an eighth of the sampling rate along x and y, without 0) in the errors
// of 64 x 64 pixels, over the mean power of all: 1 for white noise.
double low_frequency_power(SamplerKind sampler, int samples, int pair) {
  constexpr int edge = 64, low = edge / 8;
  double power = 0, total = 0;
  int frequencies = 0;
  const CompiledScene scene = scene_of(sampler, samples, 5);
  std::vector<double> errors;
  for (int i = 0; i < edge * edge; ++i) {
    errors.push_back(error(scene, i % edge, i / edge, pair));
    total += errors.back() * errors.back();
  }
  for (int fy = -low; fy <= low; ++fy)
    for (int fx = 0; fx <= low; ++fx) {
      if (fx == 0 && fy <= 0) continue;
      double re = 0, im = 0;
      for (int i = 0; i < edge * edge; ++i) {
        const int x = i % edge, y = i / edge;
        const double turn = 2 * std::numbers::pi * (fx * x + fy * y) / edge;
        re += errors[static_cast<std::size_t>(i)] * std::cos(turn);
        im += errors[static_cast<std::size_t>(i)] * std::sin(turn);
      }
      power += re * re + im * im;
      ++frequencies;
    }
  return power / frequencies / total;
}

constexpr double little = 1.0 / 3;

TEST(RandomStream, ErrorOverThePictureHasLittleOfLowFrequencies) {
  for (const int samples : {1, 4, 16})
    for (const int pair : {0, 1}) EXPECT_LT(low_frequency_power(SamplerKind::zsobol, samples, pair), little);
}
TEST(RandomStreamTwin, IndependentErrorIsWhite) {
  EXPECT_GT(low_frequency_power(SamplerKind::independent, 4, 0), 2 * little);
}

TEST(RandomStream, IndependentNumbersAreTheHashOfTheirCounters) {
  const CompiledScene scene = scene_of(SamplerKind::independent, 16, 11);
  RandomStream random(scene, 5, 3, 9);
  for (std::uint32_t dimension = 0; dimension < 40;) {
    EXPECT_EQ(random.next(), kernel::random_uniform(11, 3 * 64 + 5, 9, dimension++));
    EXPECT_EQ(random.next_bits(), kernel::random_bits(11, 3 * 64 + 5, 9, dimension++));
    const RandomStream::Pair pair = random.next_pair();
    EXPECT_EQ(pair.u, kernel::random_uniform(11, 3 * 64 + 5, 9, dimension++));
    EXPECT_EQ(pair.v, kernel::random_uniform(11, 3 * 64 + 5, 9, dimension++));
  }
}

TEST(RandomStream, ZsobolGivesPairsAndThenTheHash) {
  const CompiledScene scene = scene_of(SamplerKind::zsobol, 12, 11);
  RandomStream random(scene, 5, 3, 9);
  const auto expect_pair = [&](std::uint32_t pair, float u, float v) {
    std::uint32_t first, second;
    kernel::sobol_pair(11, 5, 3, 16, 9, pair, first, second);
    EXPECT_EQ(u, kernel::uniform_from_bits(first));
    EXPECT_EQ(v, kernel::uniform_from_bits(second));
  };
  const RandomStream::Pair first = random.next_pair();
  expect_pair(0, first.u, first.v);
  EXPECT_EQ(random.next_bits(), kernel::random_bits(11, 3 * 64 + 5, 9, 0));
  const float u = random.next(), v = random.next();
  expect_pair(1, u, v);
  random.next();  // leaves half of pair 2 unused
  const RandomStream::Pair fourth = random.next_pair();
  expect_pair(3, fourth.u, fourth.v);
  for (std::uint32_t pair = 4; pair < RandomStream::sobol_dimensions / 2; ++pair) {
    const RandomStream::Pair p = random.next_pair();
    expect_pair(pair, p.u, p.v);
  }
  EXPECT_EQ(random.next(), kernel::random_uniform(11, 3 * 64 + 5, 9, 1));
}

}  // namespace
}  // namespace brume

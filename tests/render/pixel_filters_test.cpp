// Pixel filters in pictures: a constant radiance stays what it is. The fault this catches: the sign of a filter's
// weight left out, which puts mitchell 14 % and sinc 83 % out.
#include <gtest/gtest.h>

#include <cmath>

#include "render/scenes.h"

namespace brume {
namespace {

// The pixels' mean and the standard deviation of one about it, under a sky of radiance 1.
struct Spread {
  double mean = 0, deviation = 0;
};
Spread constant_picture(PixelFilter::Kind kind, SamplerDescription::Kind sampler, std::uint32_t seed = 0) {
  SceneDescription s;
  s.film.width = s.film.height = 64;
  s.sampler.kind = sampler;
  s.sampler.seed = seed;
  s.filter.kind = kind;
  s.filter.x_radius = s.filter.y_radius = kind == PixelFilter::Kind::sinc ? 4.0f : 2.0f;
  s.lights = {sky(1)};
  const Image image = render_film(s, 16).image();
  double sum = 0, squares = 0;
  for (const float v : image.pixels) {
    sum += static_cast<double>(v);
    squares += static_cast<double>(v) * static_cast<double>(v);
  }
  const double n = static_cast<double>(image.pixels.size()), mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean))};
}

TEST(PixelFilters, AConstantStaysExactlyWhatItIsWithoutNegativeLobes) {
  for (const auto kind : {PixelFilter::Kind::box, PixelFilter::Kind::gaussian, PixelFilter::Kind::triangle}) {
    const Spread s = constant_picture(kind, SamplerDescription::Kind::zsobol);
    EXPECT_EQ(s.mean, 1);
    EXPECT_EQ(s.deviation, 0);
  }
}

// The twin's weights have no sign, which makes them all alike: the root of their mean square, which by the deviation of
// the means of 16 is 1 + 16 deviation^2.
TEST(PixelFilters, AConstantStaysWhatItIsInTheMeanWithNegativeLobes) {
  for (const auto kind : {PixelFilter::Kind::mitchell, PixelFilter::Kind::sinc}) {
    const Spread s = constant_picture(kind, SamplerDescription::Kind::independent);
    EXPECT_GT(s.deviation, 0);
    EXPECT_LE(std::abs(s.mean - 1), 4 * s.deviation / 64);
    const double without_sign = std::sqrt(1 + 16 * s.deviation * s.deviation);
    EXPECT_GT(without_sign - s.mean, 8 * s.deviation / 64);
  }
}

// Catches places in the filter that are not drawn from the sampler's points. The deviations of 4096 independent pixels
// have the relative error 1 / sqrt(2 * 4096), and their ratio 1 / 64: zsobol's stands 8 of these below that of other
// independent points. The twin has such points in its place.
TEST(PixelFilters, ZsobolMakesTheirNoiseLess) {
  for (const auto kind : {PixelFilter::Kind::mitchell, PixelFilter::Kind::sinc}) {
    const double independent = constant_picture(kind, SamplerDescription::Kind::independent).deviation;
    EXPECT_LT(constant_picture(kind, SamplerDescription::Kind::zsobol).deviation, (1 - 8 / 64.0) * independent);
    EXPECT_NEAR(constant_picture(kind, SamplerDescription::Kind::independent, 1).deviation, independent,
                4 / 64.0 * independent);
  }
}

}  // namespace
}  // namespace brume

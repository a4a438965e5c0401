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
Spread constant_picture(PixelFilter::Kind kind, SamplerDescription::Kind sampler) {
  SceneDescription s;
  s.film.width = s.film.height = 64;
  s.sampler.kind = sampler;
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

TEST(PixelFilters, AConstantStaysWhatItIsInTheMeanWithNegativeLobes) {
  for (const auto kind : {PixelFilter::Kind::mitchell, PixelFilter::Kind::sinc}) {
    const Spread s = constant_picture(kind, SamplerDescription::Kind::independent);
    EXPECT_GT(s.deviation, 0);
    EXPECT_LE(std::abs(s.mean - 1), 4 * s.deviation / 64);
    EXPECT_LT(8 * s.deviation / 64, 0.14);  // what weights without their sign would be out at least
  }
}

TEST(PixelFilters, ZsobolMakesTheirNoiseLess) {
  for (const auto kind : {PixelFilter::Kind::mitchell, PixelFilter::Kind::sinc})
    EXPECT_LT(constant_picture(kind, SamplerDescription::Kind::zsobol).deviation,
              0.85 * constant_picture(kind, SamplerDescription::Kind::independent).deviation);
}

}  // namespace
}  // namespace brume

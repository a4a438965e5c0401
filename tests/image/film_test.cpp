#include "image/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace brume {
namespace {

// Values whose sums round differently in different orders.
Spectrum value(int x, int y, int sample) {
  const float v = 1.0f / static_cast<float>(3 + 7 * x + 13 * y + 29 * sample);
  return Spectrum{{v, 1e6f * v, 1e-6f * v}};
}

TEST(Film, MeansOfSamples) {
  Film film(2, 1);
  film.add(0, 0, Spectrum{{1, 2, 3}});
  film.add(0, 0, Spectrum{{3, 2, 1}});
  EXPECT_EQ(film.image().pixels, (std::vector<float>{2, 2, 2, 0, 0, 0}));
  EXPECT_EQ(film.samples_per_pixel(), 0);  // what every pixel has
  film.add(1, 0, Spectrum{{1, 1, 1}});
  EXPECT_EQ(film.samples_per_pixel(), 1);
}

TEST(Film, VariancesOfTheMeans) {
  Film film(3, 1);
  for (const float v : {1.0f, 2.0f, 6.0f}) film.add(0, 0, Spectrum{{v, 0.1f, -v}});
  film.add(0, 0, constant_spectrum(std::numeric_limits<float>::infinity()));  // counts for nothing
  film.add(1, 0, Spectrum{{1, 1, 1}});
  // Deviations -2, -1 and 3 from the mean: 14 / (3 - 1) is the samples' variance, a third of it that of their mean.
  const std::vector<float> variance = film.variance();
  ASSERT_EQ(variance.size(), 9u);
  EXPECT_FLOAT_EQ(variance[0], 7.0f / 3);
  EXPECT_NEAR(variance[1], 0, 1e-17);  // never below 0
  EXPECT_GE(variance[1], 0);
  EXPECT_FLOAT_EQ(variance[2], 7.0f / 3);
  for (std::size_t i = 3; i < 9; ++i) EXPECT_TRUE(std::isnan(variance[i]));  // of one sample and of none
}

// With weights that are negative in places, alpha is the weighted mean, as the colours are, and depth is not weighted.
TEST(Film, AlphaAndDepthOfSamples) {
  Film film(2, 1);
  const Spectrum black;
  film.add(0, 0, black, {1, 3}, 1.5f);
  film.add(0, 0, black, {0.5f, 4}, -0.25f);
  film.add(0, 0, black, {}, 1.75f);
  const Image image = film.image();
  EXPECT_FLOAT_EQ(image.alpha[0], (1.5f - 0.125f) / 3);
  EXPECT_FLOAT_EQ(image.depth[0], 7 / 1.5f);
  EXPECT_EQ(image.alpha[1], 0);
  EXPECT_EQ(image.depth[1], std::numeric_limits<float>::infinity());
}

TEST(Film, TheOrderOfPixelsDoesNotMatter) {
  constexpr int width = 7, height = 5, samples = 9;
  Film by_pixel(width, height), by_sample(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int s = 0; s < samples; ++s) by_pixel.add(x, y, value(x, y, s));
  for (int s = 0; s < samples; ++s)
    for (int x = width - 1; x >= 0; --x)
      for (int y = height - 1; y >= 0; --y) by_sample.add(x, y, value(x, y, s));
  EXPECT_EQ(by_pixel.image().pixels, by_sample.image().pixels);
}

TEST(Film, CountsWhatIsNotFiniteAndLeavesItOut) {
  Film film(1, 1);
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  film.add(0, 0, Spectrum{{1, 1, 1}});
  film.add(0, 0, Spectrum{{nan, 1, 1}});
  film.add(0, 0, Spectrum{{1, infinity, 1}});
  film.add(0, 0, Spectrum{{1, 1, -infinity}});
  EXPECT_EQ(film.invalid_samples(), 3);
  EXPECT_EQ(film.samples_per_pixel(), 4);
  EXPECT_EQ(film.image().pixels, (std::vector<float>{1, 1, 1}));
}

TEST(Film, APixelWithoutValidSamplesIsBlack) {
  Film film(1, 1);
  film.add(0, 0, constant_spectrum(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(film.image().pixels, (std::vector<float>{0, 0, 0}));
}

}  // namespace
}  // namespace brume

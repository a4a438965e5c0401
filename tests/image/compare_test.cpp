// The measures of compare_images on pictures whose answers are known.
#include "image/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "kernel/scalar.h"

namespace brume {
namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

Image constant_image(int width, int height, float value) {
  return {width, height, std::vector<float>(static_cast<std::size_t>(3 * width * height), value)};
}

TEST(Compare, Means) {
  // Pixels of one colour, so that the blur of the denominators changes nothing.
  const Image a{2, 1, {1, 2, 6, 1, 2, 6}}, b{2, 1, {2, 2, 4, 2, 2, 4}};
  const ImageComparison c = compare_images(a, b);
  EXPECT_EQ(c.pixels, 2);
  EXPECT_EQ(c.invalid_pixels, 0);
  EXPECT_DOUBLE_EQ(c.channels[0].mean_a, 1);
  EXPECT_DOUBLE_EQ(c.channels[2].mean_b, 4);
  EXPECT_DOUBLE_EQ(c.channels[0].mean_ratio, 0.5);
  EXPECT_DOUBLE_EQ(c.channels[1].mean_ratio, 1);
  EXPECT_DOUBLE_EQ(c.channels[2].mean_ratio, 1.5);
  EXPECT_DOUBLE_EQ(c.mean_ratio, 9.0 / 8);
  EXPECT_FALSE(c.channels[0].scores);  // neither has variances
  EXPECT_TRUE(std::isnan(compare_images(a, constant_image(2, 1, 0)).mean_ratio));
}

TEST(Compare, ErrorsWithoutReferenceAreOverTheMeanOfBoth) {
  const Image a{2, 1, {1, 2, 6, 1, 2, 6}}, b{2, 1, {2, 2, 4, 2, 2, 4}};
  const ImageComparison c = compare_images(a, b);
  EXPECT_NEAR(c.mse, (1 + 0 + 4) / 6.0, 1e-12);
  EXPECT_NEAR(c.relmse, (0.5 / (1.5 * 1.5 + 0.01) + 2 / (25 + 0.01)) / 3, 1e-12);
}

TEST(Compare, TheReferenceIsBlurredByOnePixelInTheDenominatorOnly) {
  // A reference of one bright pixel in the corner of 4 x 3: the mean around (0, 0) has 4 pixels, around (1, 0) and
  // (0, 1) 6, around (1, 1) 9; the others do not see it.
  Image a = constant_image(4, 3, 0), b = a, reference = a;
  for (std::size_t c = 0; c < 3; ++c) reference.pixels[c] = 36;
  for (std::size_t p = 0; p < 12; ++p) a.pixels[3 * p] = 2;  // only red differs, by 2
  const ImageComparison c = compare_images(a, b, &reference);
  double expected = 8 * 2 / 0.01;
  for (const double blurred : {9.0, 6.0, 6.0, 4.0}) expected += 2 / (blurred * blurred + 0.01);
  EXPECT_NEAR(c.relmse, expected / 36, 1e-9);
  EXPECT_NEAR(c.mse, 2.0 / 3, 1e-12);
}

TEST(Compare, TrimmedLeavesOutAThousandthOfThePixels) {
  Image a = constant_image(50, 60, 1);
  const Image b = a, reference = a;  // 3000 pixels, of which 3 are left out
  for (const std::size_t p : {7u, 1000u, 2999u}) a.pixels[3 * p + 1] = 1e6f;
  EXPECT_GT(compare_images(a, b, &reference).relmse, 1e8);
  EXPECT_EQ(compare_images(a, b, &reference).trimmed_relmse, 0);
  a.pixels[3 * 500] = 3;  // a fourth
  EXPECT_NEAR(compare_images(a, b, &reference).trimmed_relmse, 2 / 1.01 / (3 * 2997), 1e-12);
  const Image small = constant_image(1, 1, 2);
  EXPECT_EQ(compare_images(small, constant_image(1, 1, 1), &small).trimmed_relmse, 0.5 / 4.01);
}

TEST(Compare, PixelsThatAreNotFiniteAreCountedAndLeftOut) {
  Image a = constant_image(4, 1, 1), b = constant_image(4, 1, 2), reference = constant_image(4, 1, 1);
  a.pixels[0] = not_a_number;
  b.pixels[4] = std::numeric_limits<float>::infinity();
  reference.pixels[8] = not_a_number;
  const ImageComparison c = compare_images(a, b, &reference);
  EXPECT_EQ(c.pixels, 1);
  EXPECT_EQ(c.invalid_pixels, 3);
  EXPECT_EQ(c.mean_ratio, 0.5);
  EXPECT_NEAR(c.relmse, 0.5 / 1.01, 1e-12);  // the neighbour that is no number is left out of the blur

  const ImageComparison none = compare_images(constant_image(1, 1, not_a_number), constant_image(1, 1, 1));
  EXPECT_EQ(none.pixels, 0);
  EXPECT_TRUE(std::isnan(none.relmse));
}

TEST(Compare, DifferentSizesAreRefused) {
  const Image a = constant_image(2, 3, 1), b = constant_image(3, 2, 1);
  EXPECT_THROW(compare_images(a, b), std::invalid_argument);
  EXPECT_THROW(compare_images(a, a, &b), std::invalid_argument);
  EXPECT_THROW(compare_images(a, a, nullptr, 0), std::invalid_argument);
}

// A picture of value 0.5 with Gaussian noise of standard deviation `sigma` in each channel. It is multiplied by `bias`,
// and what it says of its variance is `claimed` times the truth.
Image noisy_image(std::uint32_t seed, double sigma, double bias, double claimed) {
  constexpr int width = 256, height = 203;  // the lowest blocks are cut off
  Image image = constant_image(width, height, 0);
  for (std::uint32_t i = 0; i < image.pixels.size(); ++i) {
    const double u = 1 - static_cast<double>(kernel::random_uniform(seed, i, 0, 0));
    const double v = static_cast<double>(kernel::random_uniform(seed, i, 0, 1));
    const double normal = std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);  // Box and Muller
    image.pixels[i] = static_cast<float>(bias * (0.5 + sigma * normal));
  }
  image.variance.assign(image.pixels.size(), static_cast<float>(claimed * bias * bias * sigma * sigma));
  return image;
}

// 832 blocks a channel: the mean of z must be within 0.139 of 0, its deviation within 0.098 of 1.
constexpr int blocks = 32 * 26;

// Noise of 5 % in a pixel is 0.9 % in the difference of two block means.
constexpr double sigma = 0.025;

TEST(Compare, NoiseOfTheVarianceThatThePicturesStateAgrees) {
  const ImageComparison c = compare_images(noisy_image(1, sigma, 1, 1), noisy_image(2, sigma, 1, 1));
  for (const ChannelComparison& channel : c.channels) {
    ASSERT_TRUE(channel.scores);
    EXPECT_EQ(channel.scores->blocks, blocks);
    EXPECT_TRUE(agree(*channel.scores)) << channel.scores->mean << " " << channel.scores->deviation;
  }
  EXPECT_DOUBLE_EQ(mean_limit(*c.channels[0].scores), 4 / std::sqrt(blocks));
  EXPECT_DOUBLE_EQ(deviation_limit(*c.channels[0].scores), 4 / std::sqrt(2.0 * blocks));
  // Each is off by sigma, and so is one of them by the halved square of their difference: its relative standard error
  // over 155,904 values is 0.4 %.
  EXPECT_NEAR(c.mse / (sigma * sigma), 1, 0.016);
}

// The twins: one picture 1 % too bright, which is 32 standard errors of the mean z; a stated variance that is twice the
// true one, which makes the deviation 0.71 instead of 1, 12 standard errors off.
TEST(Compare, ABiasOfOnePercentIsFlagged) {
  const ImageComparison c = compare_images(noisy_image(1, sigma, 1.01, 1), noisy_image(2, sigma, 1, 1));
  for (const ChannelComparison& channel : c.channels) {
    EXPECT_GT(channel.scores->mean, 2 * mean_limit(*channel.scores));
    EXPECT_FALSE(agree(*channel.scores));
  }
}

TEST(Compare, ADoubledVarianceIsFlagged) {
  const ImageComparison c = compare_images(noisy_image(1, sigma, 1, 2), noisy_image(2, sigma, 1, 2));
  for (const ChannelComparison& channel : c.channels) {
    EXPECT_LT(channel.scores->deviation, 1 - 2 * deviation_limit(*channel.scores));
    EXPECT_FALSE(agree(*channel.scores));
  }
}

TEST(Compare, BlockSizesAndWhatTheScoresOfABlockAre) {
  Image a = constant_image(3, 2, 1), b = constant_image(3, 2, 1);
  a.variance.assign(18, 3);
  b.variance.assign(18, 1);
  for (std::size_t p : {0u, 1u, 3u, 4u}) a.pixels[3 * p] = 2;
  a.variance[3 * 5] = not_a_number;
  // Red, blocks of 2 x 2: the first has 4 pixels that differ by 1 with variance 4 each, the second one pixel that does
  // not differ and one whose variance is not known.
  const BlockScores red = *compare_images(a, b, nullptr, 2).channels[0].scores;
  EXPECT_EQ(red.blocks, 2);
  EXPECT_DOUBLE_EQ(red.mean, (1 / std::sqrt(4.0 / 4) + 0) / 2);
  EXPECT_DOUBLE_EQ(red.deviation, std::sqrt(0.5));
  const BlockScores one_block = *compare_images(a, b).channels[1].scores;
  EXPECT_EQ(one_block.blocks, 1);
  EXPECT_EQ(one_block.mean, 0);
  EXPECT_TRUE(std::isnan(one_block.deviation));
  EXPECT_TRUE(agree(one_block));
}

TEST(Compare, BlocksWithoutVarianceMustBeEqual) {
  Image a = constant_image(32, 8, 0.7f), b = a;
  a.variance.assign(a.pixels.size(), 0);
  b.variance = a.variance;
  for (std::size_t p = 0; p < 8; ++p) b.pixels[3 * p] = std::nextafter(0.7f, 1.0f);  // rounding
  b.pixels[1] = 0.71f;                                                               // more than that
  const ImageComparison c = compare_images(a, b);
  EXPECT_EQ(c.channels[0].scores->blocks, 0);
  EXPECT_TRUE(agree(*c.channels[0].scores));
  EXPECT_EQ(c.channels[1].scores->unexplained, 1);
  EXPECT_FALSE(agree(*c.channels[1].scores));
}

}  // namespace
}  // namespace brume

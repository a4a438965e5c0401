#include "image/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace brume {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// Below this part of a value, a difference may be float rounding.
constexpr double float_noise = 1e-6;

using Mask = std::vector<bool>;  // by pixel

bool is_finite(const std::vector<float>& values, std::size_t pixel) {
  return std::all_of(values.begin() + static_cast<std::ptrdiff_t>(3 * pixel),
                     values.begin() + static_cast<std::ptrdiff_t>(3 * pixel + 3),
                     [](float v) { return std::isfinite(v); });
}

Mask finite_pixels(const Image& a, const Image& b, const Image& reference) {
  Mask valid(a.pixels.size() / 3);
  for (std::size_t p = 0; p < valid.size(); ++p)
    valid[p] = is_finite(a.pixels, p) && is_finite(b.pixels, p) && is_finite(reference.pixels, p);
  return valid;
}

Image mean_of(const Image& a, const Image& b) {
  Image mean{a.width, a.height, a.pixels};
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) mean.pixels[i] = 0.5f * a.pixels[i] + 0.5f * b.pixels[i];
  return mean;
}

// The mean of the valid pixels among the 3 x 3 around (x, y), in one channel.
double blurred(const Image& image, const Mask& valid, int x, int y, std::size_t channel) {
  double sum = 0;
  int count = 0;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, image.height - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, image.width - 1); ++i) {
      const auto p = static_cast<std::size_t>(j) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(i);
      if (!valid[p]) continue;
      sum += static_cast<double>(image.pixels[3 * p + channel]);
      ++count;
    }
  return sum / count;
}

void compare_means(const Image& a, const Image& b, const Mask& valid, ImageComparison& result) {
  double total_a = 0, total_b = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    double sum_a = 0, sum_b = 0;
    for (std::size_t p = 0; p < valid.size(); ++p)
      if (valid[p]) {
        sum_a += static_cast<double>(a.pixels[3 * p + c]);
        sum_b += static_cast<double>(b.pixels[3 * p + c]);
      }
    ChannelComparison& channel = result.channels[c];
    const auto count = static_cast<double>(result.pixels);
    channel.mean_a = sum_a / count;
    channel.mean_b = sum_b / count;
    channel.mean_ratio = sum_b != 0 ? sum_a / sum_b : nan;
    total_a += sum_a;
    total_b += sum_b;
  }
  result.mean_ratio = total_b != 0 ? total_a / total_b : nan;
}

void compare_errors(const Image& a, const Image& b, const Image& reference, const Mask& valid,
                    ImageComparison& result) {
  double squares = 0;
  std::vector<double> relative;  // by pixel, summed over the channels
  relative.reserve(static_cast<std::size_t>(result.pixels));
  std::size_t p = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x, ++p) {
      if (!valid[p]) continue;
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double difference = static_cast<double>(a.pixels[3 * p + c]) - static_cast<double>(b.pixels[3 * p + c]);
        const double ref = blurred(reference, valid, x, y, c), square = difference * difference / 2;
        squares += square;
        sum += square / (ref * ref + 0.01);
      }
      relative.push_back(sum);
    }
  const auto mean_of_least = [&](std::size_t kept) {
    return std::accumulate(relative.begin(), relative.begin() + static_cast<std::ptrdiff_t>(kept), 0.0) /
           static_cast<double>(3 * kept);
  };
  result.mse = squares / static_cast<double>(3 * relative.size());
  result.relmse = mean_of_least(relative.size());
  const std::size_t kept = relative.size() - relative.size() / 1000;
  std::nth_element(relative.begin(), relative.begin() + static_cast<std::ptrdiff_t>(kept), relative.end());
  result.trimmed_relmse = mean_of_least(kept);
}

struct Block {
  double sum_a = 0, sum_b = 0, variance = 0;
  int count = 0;
};

// One channel's sums over the blocks, row by row. Pixels whose variance is not known are left out.
std::vector<Block> sum_blocks(const Image& a, const Image& b, const Mask& valid, std::size_t channel, int block_size) {
  const auto size = static_cast<std::size_t>(block_size), width = static_cast<std::size_t>(a.width);
  const std::size_t columns = (width - 1) / size + 1, rows = (static_cast<std::size_t>(a.height) - 1) / size + 1;
  std::vector<Block> blocks(columns * rows);
  for (std::size_t p = 0; p < valid.size(); ++p) {
    const std::size_t i = 3 * p + channel;
    const double variance = static_cast<double>(a.variance[i]) + static_cast<double>(b.variance[i]);
    if (!valid[p] || !std::isfinite(variance)) continue;
    Block& block = blocks[p / width / size * columns + p % width / size];
    block.sum_a += static_cast<double>(a.pixels[i]);
    block.sum_b += static_cast<double>(b.pixels[i]);
    block.variance += variance;
    ++block.count;
  }
  return blocks;
}

BlockScores score(const std::vector<Block>& blocks) {
  BlockScores result;
  std::vector<double> scores;
  for (const Block& block : blocks) {
    // Both sides of every comparison are sums, that is block.count times means.
    const double difference = block.sum_a - block.sum_b, error = std::sqrt(std::max(block.variance, 0.0));
    const double noise = float_noise * std::max(std::abs(block.sum_a), std::abs(block.sum_b));
    if (error > noise)
      scores.push_back(difference / error);
    else if (std::abs(difference) > noise)
      ++result.unexplained;
  }
  const auto n = static_cast<double>(scores.size());
  result.blocks = static_cast<int>(scores.size());
  result.mean = n > 0 ? std::accumulate(scores.begin(), scores.end(), 0.0) / n : nan;
  double squares = 0;
  for (const double z : scores) squares += (z - result.mean) * (z - result.mean);
  result.deviation = n > 1 ? std::sqrt(squares / (n - 1)) : nan;
  return result;
}

bool same_size(const Image& a, const Image& b) { return a.width == b.width && a.height == b.height; }

}  // namespace

double mean_limit(const BlockScores& scores) { return 4 / std::sqrt(scores.blocks); }

double deviation_limit(const BlockScores& scores) { return 4 / std::sqrt(2.0 * scores.blocks); }

bool agree(const BlockScores& scores) {
  // In this form, a NaN exceeds nothing.
  return scores.unexplained == 0 && !(std::abs(scores.mean) > mean_limit(scores)) &&
         !(std::abs(scores.deviation - 1) > deviation_limit(scores));
}

ImageComparison compare_images(const Image& a, const Image& b, const Image* reference, int block_size) {
  if (!same_size(a, b) || (reference && !same_size(a, *reference)))
    throw std::invalid_argument("pictures of different sizes cannot be compared");
  if (block_size < 1) throw std::invalid_argument("a block has at least one pixel");
  const Image mean = reference ? Image{} : mean_of(a, b);
  const Image& ref = reference ? *reference : mean;
  const Mask valid = finite_pixels(a, b, ref);
  ImageComparison result;
  result.pixels = std::count(valid.begin(), valid.end(), true);
  result.invalid_pixels = static_cast<std::int64_t>(valid.size()) - result.pixels;
  compare_means(a, b, valid, result);
  compare_errors(a, b, ref, valid, result);
  if (!a.variance.empty() && !b.variance.empty())
    for (std::size_t c = 0; c < 3; ++c) result.channels[c].scores = score(sum_blocks(a, b, valid, c, block_size));
  return result;
}

}  // namespace brume

// How far two pictures of one scene are apart, and whether their noise explains it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "image/image.h"

namespace brume {

// Z-scores of the means of square blocks in one channel: z = (mean a - mean b) / sqrt(var a + var b), where the
// variance of a block's mean is the sum of its pixels' variances over the square of their number.
struct BlockScores {
  int blocks = 0;        // n, the number of scores
  int unexplained = 0;   // blocks without variance whose means differ all the same
  double mean = 0;       // of the scores; NaN where n = 0
  double deviation = 0;  // their standard deviation, by n - 1; NaN where n < 2
};

// What |mean| and |deviation - 1| of n independent scores must not exceed where both pictures have the same expected
// values and their variances are right: four standard errors, 4 / sqrt(n) and 4 / sqrt(2 n).
double mean_limit(const BlockScores& scores);
double deviation_limit(const BlockScores& scores);
// Whether both hold, as far as they are known, and no block differs without variance.
bool agree(const BlockScores& scores);

struct ChannelComparison {
  double mean_a = 0, mean_b = 0;
  double mean_ratio = 0;              // mean a / mean b; NaN where the latter is 0
  std::optional<BlockScores> scores;  // where both pictures have variances
};

// Every value is over the pixels that are finite in all pictures compared; with none left, all are NaN.
struct ImageComparison {
  std::int64_t pixels = 0;          // compared
  std::int64_t invalid_pixels = 0;  // left out
  double mean_ratio = 0;            // over all channels
  std::array<ChannelComparison, 3> channels;
  // The errors are those of one of two pictures with the same error: a picture without noise in place of the other
  // gives half its error.
  double mse = 0;             // the mean over pixels and channels of (a - b)^2 / 2
  double relmse = 0;          // of (a - b)^2 / 2 / (ref^2 + 0.01)
  double trimmed_relmse = 0;  // the same without the thousandth of the pixels (rounded down) that have most of it
};

// Compares pictures of the same size. ref in relmse is the reference, or where there is none the mean of a and b, in
// both cases averaged over the 3 x 3 pixels around each. Blocks have block_size x block_size pixels, fewer at the right
// and lower edges. A block in which float rounding rules (a standard error below 1e-6 of its mean) has no score; it is
// unexplained where the means differ by more. Throws std::invalid_argument for pictures of different sizes and for
// block_size < 1.
ImageComparison compare_images(const Image& a, const Image& b, const Image* reference = nullptr, int block_size = 8);

}  // namespace brume

// Comparing pictures of one scene.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace brume {

// How far pictures a and b are apart. Every value is over the pixels that are finite in all pictures compared; NaN
// stands for what is not defined.
struct Comparison {
  // How well the differences of block means fit the variances that both pictures state. A block's
  // z = (mean a - mean b) / sqrt(var a + var b), where the variance of its mean is the sum of the variances of its
  // pixels over the square of their number.
  struct Scores {
    int blocks = 0;       // n, the number of scores
    int unexplained = 0;  // blocks without variance whose means differ by more than float rounding
    double mean = 0;      // of the scores; should be within mean_limit, 4 / sqrt(n), of 0
    double mean_limit = 0;
    double deviation = 0;  // their standard deviation; should be within deviation_limit, 4 / sqrt(2 n), of 1
    double deviation_limit = 0;
    bool agree = false;  // both hold, and no block is unexplained
  };
  struct Channel {
    double mean_a = 0, mean_b = 0, mean_ratio = 0;  // the last is a's over b's
    std::optional<Scores> scores;                   // where both pictures have a layer Variance
  };

  int width = 0, height = 0;
  std::int64_t pixels = 0, invalid_pixels = 0;  // compared and left out
  std::array<Channel, 3> channels;              // red, green, blue
  double mean_ratio = 0;                        // over all channels
  // The error of one of two renders with different seeds, as their difference shows it; twice that is the error against
  // a picture without noise.
  double mse = 0;             // the mean over pixels and channels of (a - b)^2 / 2
  double relmse = 0;          // of (a - b)^2 / 2 / (ref^2 + 0.01), ref averaged over the 3 x 3 pixels around
  double trimmed_relmse = 0;  // relmse without the thousandth of the pixels that have most of it
};

// Compares two pictures (.exr, .pfm) of one size. ref is the third, or the mean of the two where its name is empty.
// Blocks have block_size x block_size pixels, >= 1; larger ones suit pictures with outliers. Throws Error for what
// cannot be read or compared.
Comparison compare(const std::string& a, const std::string& b, const std::string& reference = {}, int block_size = 8);

}  // namespace brume

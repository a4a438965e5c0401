// The random stream, along each of its four counters (seed, pixel, sample, dimension) and across each pair of them:
// values are uniform, pairs of neighbours fill the square evenly, and neighbours are not correlated. Significance 0.01
// with Sidak's correction over all tests. The fault this catches: counters that are not mixed, as in a plain linear
// congruential generator.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "kernel/scalar.h"
#include "kernel/statistics.h"

namespace brume {
namespace {

constexpr std::uint32_t values = 1u << 20;
constexpr std::array names{"seed", "pixel", "sample", "dimension"};

using Counters = std::array<std::uint32_t, 4>;
using Stream = std::uint32_t (*)(const Counters& counters);

std::uint32_t brume_stream(const Counters& c) { return kernel::random_bits(c[0], c[1], c[2], c[3]); }

// The twin: one linear congruential step of a sum of the counters.
std::uint32_t unmixed_stream(const Counters& c) {
  return (c[0] * 0x9e3779b9u + c[1] * 0x85ebca6bu + c[2] + c[3] * 0xc2b2ae35u) * 1664525u + 1013904223u;
}

// Step number n along `axis`, and `aside` steps along another, of counters that start where pictures do.
Counters counters(std::size_t axis, std::uint32_t n, std::size_t other, std::uint32_t aside) {
  Counters c{7, 1000, 3, 2};
  c[axis] += n;
  c[other] += aside;
  return c;
}

double uniform_p_value(const std::vector<double>& counts, double total) {
  const std::vector<double> probabilities(counts.size(), 1 / static_cast<double>(counts.size()));
  return chi_squared_p_value(chi_squared(counts, probabilities, total), static_cast<double>(counts.size() - 1));
}

// p-value that ten bits of the values along `axis` are uniform; the stream's floats are made of bits 8 to 31.
double single_p_value(Stream stream, std::size_t axis, int shift) {
  std::vector<double> counts(1024);
  for (std::uint32_t n = 0; n < values; ++n) ++counts[stream(counters(axis, n, 0, 0)) >> shift & 1023];
  return uniform_p_value(counts, values);
}

// Neighbours: at two consecutive steps along `axis` or, where `other` is not `axis`, one step of `other` apart.
template <class Visit>
void for_neighbours(Stream stream, std::size_t axis, std::size_t other, Visit visit) {
  const std::uint32_t stride = other == axis ? 2 : 1;
  for (std::uint32_t n = 0; n < values; ++n)
    visit(stream(counters(axis, stride * n, other, 0)), stream(counters(axis, stride * n, other, 1)));
}

double pair_p_value(Stream stream, std::size_t axis, std::size_t other) {
  std::vector<double> counts(64 * 64);
  for_neighbours(stream, axis, other, [&](std::uint32_t a, std::uint32_t b) { ++counts[(a >> 26) * 64 + (b >> 26)]; });
  return uniform_p_value(counts, values);
}

// Of the correlation coefficient, normal with variance 1 / values where there is none.
double correlation_p_value(Stream stream, std::size_t axis, std::size_t other) {
  double sum = 0;
  for_neighbours(stream, axis, other, [&](std::uint32_t a, std::uint32_t b) {
    sum += (kernel::uniform_from_bits(a) - 0.5) * (kernel::uniform_from_bits(b) - 0.5);
  });
  return normal_p_value(12 * sum / std::sqrt(static_cast<double>(values)));
}

// Word number `word` of a counter's four.
std::uint32_t word_of(const Counters& c, int word) {
  const kernel::RandomWords r = kernel::random_words(c[0], c[1], c[2], c[3]);
  return std::array{r.x, r.y, r.z, r.w}[static_cast<std::size_t>(word)];
}

// p-value that two words of one counter, or of neighbours `aside` steps apart along `axis`, fill the square evenly.
double word_pair_p_value(std::size_t axis, int first, int second, std::uint32_t aside) {
  std::vector<double> counts(64 * 64);
  for (std::uint32_t n = 0; n < values; ++n)
    ++counts[(word_of(counters(axis, n, 0, 0), first) >> 26) * 64 +
             (word_of(counters(axis, n, axis, aside), second) >> 26)];
  return uniform_p_value(counts, values);
}

// 4 axes by 2 groups of bits, 16 pairs of axes by 2 tests, and 4 axes by 22 pairs of words.
const double significance = sidak(0.01, 4 * 2 + 16 * 2 + 4 * 22);

// A counter's four words are four numbers: each uniform, and none a function of another, nor of its neighbour's.
TEST(RandomStream, TheWordsOfACounterAreIndependent) {
  for (std::size_t axis = 0; axis < 4; ++axis)
    for (int first = 0; first < 4; ++first)
      for (int second = 0; second < 4; ++second) {
        if (first < second) {
          EXPECT_GT(word_pair_p_value(axis, first, second, 0), significance)
              << "along " << names[axis] << ", words " << first << " and " << second;
        }
        EXPECT_GT(word_pair_p_value(axis, first, second, 1), significance)
            << "along " << names[axis] << ", words " << first << " and the next one's " << second;
      }
}

TEST(RandomStream, ValuesAreUniform) {
  for (std::size_t axis = 0; axis < 4; ++axis)
    for (const int shift : {22, 8})
      EXPECT_GT(single_p_value(brume_stream, axis, shift), significance) << names[axis] << " " << shift;
}

TEST(RandomStream, PairsOfNeighboursAreUniform) {
  for (std::size_t axis = 0; axis < 4; ++axis)
    for (std::size_t other = 0; other < 4; ++other)
      EXPECT_GT(pair_p_value(brume_stream, axis, other), significance)
          << "along " << names[axis] << " by " << names[other];
}

TEST(RandomStream, NeighboursAreNotCorrelated) {
  for (std::size_t axis = 0; axis < 4; ++axis)
    for (std::size_t other = 0; other < 4; ++other)
      EXPECT_GT(correlation_p_value(brume_stream, axis, other), significance)
          << "along " << names[axis] << " by " << names[other];
}

TEST(RandomStreamTwin, UnmixedCountersAreRejected) {
  for (std::size_t axis = 0; axis < 4; ++axis)
    for (std::size_t other = 0; other < 4; ++other)
      EXPECT_LT(pair_p_value(unmixed_stream, axis, other), significance)
          << "along " << names[axis] << " by " << names[other];
  EXPECT_LT(correlation_p_value(unmixed_stream, 2, 2), significance);
}

TEST(RandomStream, FloatsAreBelowOne) {
  EXPECT_EQ(kernel::uniform_from_bits(0), 0.0f);
  EXPECT_EQ(kernel::uniform_from_bits(0xffffffffu), 1 - 0x1p-24f);
  EXPECT_EQ(kernel::uniform_from_bits(0x80000000u), 0.5f);
}

}  // namespace
}  // namespace brume

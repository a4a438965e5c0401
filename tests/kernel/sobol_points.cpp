// Sobol' points (kernel/sobol.inl): nets within a pixel and over blocks of pixels, uniform values, and pairs that do
// not depend on each other. The fault that the nets catch: points that are merely random.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kernel/scalar.h"
#include "kernel/statistics.h"

namespace brume {
namespace {

struct Point {
  std::uint32_t x, y;
};

struct Counters {
  std::uint32_t seed, x, y, samples, index, pair;
};

using Source = Point (*)(const Counters& c);

Point sobol(const Counters& c) {
  Point p;
  kernel::sobol_pair(c.seed, c.x, c.y, c.samples, c.index, c.pair, p.x, p.y);
  return p;
}

// The twin.
Point independent(const Counters& c) {
  const std::uint32_t pixel = c.y * 1024 + c.x;
  return {kernel::random_bits(c.seed, pixel, c.index, 2 * c.pair),
          kernel::random_bits(c.seed, pixel, c.index, 2 * c.pair + 1)};
}

// Whether each of the boxes of area 1 / 2^bits, 2^wide of them along y and the rest along x, holds one of 2^bits
// points.
bool one_point_a_box(const std::vector<Point>& points, int bits, int wide) {
  std::vector<int> counts(points.size());
  for (const Point& p : points) {
    const std::uint64_t column = std::uint64_t{p.x} >> (32 - (bits - wide)), row = std::uint64_t{p.y} >> (32 - wide);
    if (counts[static_cast<std::size_t>(column << wide | row)]++ > 0) return false;
  }
  return true;
}

bool is_net(const std::vector<Point>& points) {
  int bits = 0;
  while (std::size_t{1} << bits < points.size()) ++bits;
  for (int wide = 0; wide <= bits; ++wide)
    if (!one_point_a_box(points, bits, wide)) return false;
  return true;
}

std::vector<Point> points_of_pixel(Source source, Counters c, std::uint32_t first, std::uint32_t last) {
  std::vector<Point> points;
  for (c.index = first; c.index < last; ++c.index) points.push_back(source(c));
  return points;
}

Counters some_pixel(std::uint32_t n, std::uint32_t samples) {
  return {n % 5, n * 37 % 1920, n * 101 % 1080, samples, 0, n % 8};
}

TEST(SobolPoints, EachPowerOfTwoOfAPixelIsANet) {
  for (std::uint32_t n = 0; n < 64; ++n)
    for (const std::uint32_t samples : {1u, 2u, 8u, 16u, 64u, 512u}) {
      const Counters c = some_pixel(n, samples);
      for (std::uint32_t size = 1; size <= samples; size *= 2) {
        EXPECT_TRUE(is_net(points_of_pixel(sobol, c, 0, size))) << n << " " << samples << " " << size;
        EXPECT_TRUE(is_net(points_of_pixel(sobol, c, samples - size, samples))) << n << " " << samples << " " << size;
        // What comes after a pixel's own share starts another net.
        EXPECT_TRUE(is_net(points_of_pixel(sobol, c, 5 * samples, 5 * samples + size)));
      }
    }
}

TEST(SobolPoints, BlocksOfPixelsAreNets) {
  for (std::uint32_t n = 0; n < 16; ++n)
    for (std::uint32_t edge = 2; edge <= 64; edge *= 2) {
      std::vector<Point> points;
      for (std::uint32_t pixel = 0; pixel < edge * edge; ++pixel) {
        Counters c = some_pixel(n, 4);
        c.x = c.x / edge * edge + pixel % edge;
        c.y = c.y / edge * edge + pixel / edge;
        for (const Point& p : points_of_pixel(sobol, c, 0, 4)) points.push_back(p);
      }
      EXPECT_TRUE(is_net(points)) << edge;
    }
}

TEST(SobolPointsTwin, IndependentPointsAreNoNet) {
  for (std::uint32_t n = 0; n < 64; ++n) EXPECT_FALSE(is_net(points_of_pixel(independent, some_pixel(n, 16), 0, 16)));
}

TEST(SobolPoints, ALargeShareStaysANet) {
  const Counters c{3, 700, 500, 1u << 20, 0, 1};
  EXPECT_TRUE(is_net(points_of_pixel(sobol, c, 0, 1 << 14)));
}

double uniform_p_value(const std::vector<double>& counts, double total) {
  const std::vector<double> probabilities(counts.size(), 1 / static_cast<double>(counts.size()));
  return chi_squared_p_value(chi_squared(counts, probabilities, total), static_cast<double>(counts.size() - 1));
}

// One point of each of many streams: over seeds, what a pixel gets has the density 1. Catches seeds of which a part
// alone makes a difference, and points that are put in another order but not scrambled, whose last bits are 0.
struct OverSeeds {
  double square, low_bits;  // p-values
};

OverSeeds over_seeds(Source source, std::uint32_t index) {
  constexpr std::uint32_t seeds = 1u << 18;
  std::vector<double> square(32 * 32), low_bits(256);
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    const Point p = source({seed, 300, 200, 16, index, 2});
    ++square[(p.x >> 27) * 32 + (p.y >> 27)];
    ++low_bits[p.x >> 8 & 255];
  }
  return {uniform_p_value(square, seeds), uniform_p_value(low_bits, seeds)};
}

TEST(SobolPoints, AreUniformOverSeeds) {
  for (const std::uint32_t index : {0u, 5u}) {
    const OverSeeds p = over_seeds(sobol, index);
    EXPECT_GT(p.square, sidak(0.01, 4)) << index;
    EXPECT_GT(p.low_bits, sidak(0.01, 4)) << index;
  }
}

Point of_half_a_seed(const Counters& c) { return sobol({c.seed & 0xffff, c.x, c.y, c.samples, c.index, c.pair}); }

// The point of the sequence whose place is drawn anew for each seed.
Point unscrambled(const Counters& c) {
  const std::uint32_t place = independent(c).x % (4096 * c.samples);
  return {kernel::reverse_bits(place), kernel::reverse_bits(kernel::sobol_second_reversed(place))};
}

TEST(SobolPointsTwin, HalfASeedAndUnscrambledPointsAreRejected) {
  for (const std::uint32_t index : {0u, 5u}) {
    EXPECT_LT(over_seeds(of_half_a_seed, index).square, 1e-6);
    EXPECT_LT(over_seeds(of_half_a_seed, index).low_bits, 1e-6);
    EXPECT_LT(over_seeds(unscrambled, index).low_bits, 1e-6);
  }
}

// A number of one pair against one of another, over the points of many pixels: the 4-dimensional point that they make
// is spread evenly. The fault: all pairs in one order, which ties each to the next.
double pairs_p_value(bool same_order) {
  std::vector<double> counts(16 * 16);
  constexpr std::uint32_t pixels = 4096;
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel)
    for (std::uint32_t index = 0; index < 16; ++index) {
      const Counters a{9, pixel % 64, pixel / 64, 16, index, 0};
      Counters b = a;
      b.pair = same_order ? 0 : 1;
      ++counts[(sobol(a).x >> 28) * 16 + (sobol(b).x >> 28)];
    }
  return uniform_p_value(counts, 16 * pixels);
}

TEST(SobolPoints, PairsAreIndependentOfEachOther) { EXPECT_GT(pairs_p_value(false), 0.01); }
TEST(SobolPointsTwin, PairsInOneOrderAreRejected) { EXPECT_LT(pairs_p_value(true), 1e-6); }

// The second dimension against its definition: direction numbers v_0 = 1/2, v_{j+1} = v_j xor v_j / 2.
TEST(SobolPoints, TheSecondDimensionIsSobols) {
  for (std::uint32_t n = 0; n < 4096; ++n) {
    const std::uint32_t index = kernel::hash_word(n);
    std::uint32_t v = 0x80000000u, expected = 0;
    for (int j = 0; j < 32; ++j, v ^= v >> 1)
      if (index >> j & 1) expected ^= v;
    EXPECT_EQ(kernel::reverse_bits(kernel::sobol_second_reversed(index)), expected);
  }
}

// How alike the 24 permutations of digits are that random bits draw, which `bits` passes on.
double permutations_p_value(std::uint32_t (*bits)(std::uint32_t)) {
  constexpr std::uint32_t draws = 240'000;
  std::vector<double> counts(256);
  for (std::uint32_t n = 0; n < draws; ++n) {
    std::uint32_t permutation = 0;
    for (std::uint32_t digit = 0; digit < 4; ++digit)
      permutation = permutation << 2 | kernel::permute_digit(digit, bits(kernel::hash_word(n)));
    ++counts[permutation];
  }
  std::vector<double> permutations;
  double total = 0;
  for (std::uint32_t i = 0; i < 256; ++i) {
    const std::uint32_t images = 1u << (i & 3) | 1u << (i >> 2 & 3) | 1u << (i >> 4 & 3) | 1u << (i >> 6);
    if (images == 15) permutations.push_back(counts[i]), total += counts[i];
  }
  EXPECT_EQ(permutations.size(), 24u);
  EXPECT_EQ(total, draws);  // each draw is a permutation
  return uniform_p_value(permutations, draws);
}

// Catches one of the six matrices drawn as the remainder of a number from 0 to 7, which takes two of them twice as
// often, and digits that are shifted by the bits that draw their matrix too. The twins are these.
TEST(SobolPoints, DigitsAreShuffledByAll24PermutationsAlike) {
  EXPECT_GT(permutations_p_value([](std::uint32_t random) { return random; }), 0.01);
}

TEST(SobolPointsTwin, RemaindersAndSharedBitsAreRejected) {
  // Bits for which the matrix is that of the remainder.
  const auto remainder = [](std::uint32_t random) {
    return (random & 0xffff0000u) | ((random & 7) % 6 * 65536 + 5) / 6;
  };
  EXPECT_LT(permutations_p_value(remainder), 1e-6);
  EXPECT_LT(permutations_p_value([](std::uint32_t random) { return random << 16 | (random & 0xffffu); }), 1e-6);
}

}  // namespace
}  // namespace brume

// Points on the disk are spread evenly over it: Pearson's chi-squared test of 10^6 of them over rings and sectors of
// equal area. The faults this catches, in its twins: a radius that is uniform, and a square.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "kernel/scalar.h"
#include "kernel/statistics.h"

namespace brume {
namespace {

constexpr int samples = 1000000, rings = 16, sectors = 24;

using Point = std::pair<float, float>;
using Map = Point (*)(float u, float v);

Point concentric(float u, float v) {
  float x, y;
  kernel::disk_point(u, v, x, y);
  return {x, y};
}

// What is outside of the disk is counted with the outermost ring.
double p_value(Map map) {
  std::vector<double> counts(rings * sectors);
  for (std::uint32_t i = 0; i < samples; ++i) {
    const auto [x, y] = map(kernel::random_uniform(3, 1, i, 0), kernel::random_uniform(3, 1, i, 1));
    const double area = static_cast<double>(x * x + y * y);
    const double turn = std::atan2(static_cast<double>(y), static_cast<double>(x)) / (2 * std::numbers::pi) + 0.5;
    const auto cell = [](double share, int n) {
      return std::min(static_cast<std::size_t>(share * n), static_cast<std::size_t>(n - 1));
    };
    ++counts[cell(area, rings) * sectors + cell(turn, sectors)];
  }
  const std::vector<double> chances(counts.size(), 1.0 / static_cast<double>(counts.size()));
  return chi_squared_p_value(chi_squared(counts, chances, samples), static_cast<double>(counts.size() - 1));
}

TEST(Disk, IsCoveredEvenly) { EXPECT_GT(p_value(concentric), 0.01); }
TEST(DiskTwin, AUniformRadiusIsRejected) {
  EXPECT_LT(p_value([](float u, float v) {
              float sine, cosine;
              kernel::sincos_turns(v, sine, cosine);
              return Point(u * cosine, u * sine);
            }),
            1e-6);
}
TEST(DiskTwin, ASquareIsRejected) {
  EXPECT_LT(p_value([](float u, float v) { return Point(2 * u - 1, 2 * v - 1); }), 1e-6);
}

// Squares about the middle become circles: u and v at a distance of d from the nearest edge lie 1 - 2d from the centre.
TEST(Disk, SquaresBecomeCircles) {
  for (const float edge : {0.0f, 0.1f, 0.49f})
    for (const float along : {0.5f, 0.51f, 0.3f, 0.9f})
      for (const Point& on :
           {Point(edge, std::clamp(along, edge, 1 - edge)), Point(std::clamp(along, edge, 1 - edge), 1 - edge)}) {
        const auto [x, y] = concentric(on.first, on.second);
        EXPECT_NEAR(std::hypot(x, y), 1 - 2 * edge, 3e-7);
      }
  EXPECT_EQ(concentric(0.5f, 0.5f), Point(0, 0));
}

}  // namespace
}  // namespace brume

// Integrals of density along rays, in lanes of every instruction set of the machine, against quadrature in double
// precision of an interpolation written down a second time.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lanes/instruction_set.h"
#include "render/density.h"
#include "volume/brick_borders.h"
#include "volume/kernel_view.h"

namespace brume {
namespace {

constexpr std::array<int, 3> resolution{11, 19, 26};

struct Field {
  std::vector<float> values;
  double voxel(int x, int y, int z) const {
    if (x < 0 || y < 0 || z < 0 || x >= resolution[0] || y >= resolution[1] || z >= resolution[2]) return 0;
    return static_cast<double>(values[static_cast<std::size_t>((z * resolution[1] + y) * resolution[0] + x)]);
  }
  double nearest(double x, double y, double z) const {
    return voxel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)), static_cast<int>(std::floor(z)));
  }
  double linear(double x, double y, double z) const {
    double sum = 0;
    const double fx = std::floor(x - 0.5), fy = std::floor(y - 0.5), fz = std::floor(z - 0.5);
    for (int corner = 0; corner < 8; ++corner) {
      const int cx = corner & 1, cy = corner >> 1 & 1, cz = corner >> 2;
      const double wx = x - 0.5 - fx, wy = y - 0.5 - fy, wz = z - 0.5 - fz;
      sum += (cx ? wx : 1 - wx) * (cy ? wy : 1 - wy) * (cz ? wz : 1 - wz) *
             voxel(static_cast<int>(fx) + cx, static_cast<int>(fy) + cy, static_cast<int>(fz) + cz);
    }
    return sum;
  }
};

// Empty but for a corner of one brick, from which interpolation reaches into seven empty ones.
Field corner_field() {
  Field f;
  f.values.resize(11 * 19 * 26);
  for (int z = 8; z < 11; ++z)
    for (int y = 8; y < 12; ++y)
      for (int x = 8; x < 11; ++x) f.values[static_cast<std::size_t>((z * resolution[1] + y) * resolution[0] + x)] = 1;
  return f;
}

Field random_field() {
  std::mt19937 rng(3);
  std::uniform_real_distribution<float> uniform(0, 1);
  Field f;
  f.values.resize(11 * 19 * 26);
  for (float& v : f.values) v = uniform(rng) < 0.3f ? 0 : uniform(rng);
  return f;
}

// Stretches between random points of the grid's bounds, some along axes, some in the planes between voxels.
DensityStretches random_stretches(int count) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<float> uniform(0, 1);
  DensityStretches s;
  for (int i = 0; i < count; ++i) {
    float a[3], b[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto n = static_cast<float>(resolution[axis]);
      a[axis] = -0.5f + uniform(rng) * (n + 1);
      b[axis] = -0.5f + uniform(rng) * (n + 1);
      if (i % 5 == 1 && axis != static_cast<std::size_t>(i / 5 % 3)) b[axis] = a[axis];
      if (i % 5 == 2 && axis == 0) a[0] = b[0] = std::floor(a[0]) + 0.5f;
    }
    const float d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    // World units of half a voxel: the direction need not have unit length in index space.
    const float length = 2 * std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    s.add({a[0], a[1], a[2]}, {d[0] / length, d[1] / length, d[2] / length}, length, static_cast<std::uint32_t>(i + 1));
  }
  return s;
}

double oracle(const Field& field, const DensityStretches& s, std::size_t i, bool linear, int steps = 40000) {
  double sum = 0;
  const auto length = static_cast<double>(s.length[i]);
  for (int k = 0; k < steps; ++k) {
    const double t = (k + 0.5) * length / steps;
    const double x = static_cast<double>(s.entry_x[i]) + t * static_cast<double>(s.direction_x[i]);
    const double y = static_cast<double>(s.entry_y[i]) + t * static_cast<double>(s.direction_y[i]);
    const double z = static_cast<double>(s.entry_z[i]) + t * static_cast<double>(s.direction_z[i]);
    sum += linear ? field.linear(x, y, z) : field.nearest(x, y, z);
  }
  return sum * length / steps;
}

// With plain bricks and with bordered ones.
class DensityIntegral : public ::testing::TestWithParam<bool> {
 protected:
  static BrickGrid make_grid(const Field& field) {
    BrickGrid grid = make_brick_grid(resolution, field.values, Storage::f32);
    return GetParam() ? add_borders(std::move(grid), 1) : std::move(grid);
  }
  std::vector<float> integrate(const DensityQuadrature& q, DensityStretches s) {
    std::vector<float> integral;
    integrate_density(kernel_view(grid), q, s, integral);
    return integral;
  }
  std::vector<float> by_dda(bool linear) { return integrate({linear, true, 0, 0, 0, 1e9f}, stretches); }
  // By how much marching in steps of 0.01 is away from `exact` at most.
  float worst_of_marching(bool linear, float base, float spread, const std::vector<float>& exact) {
    const auto marched = integrate({linear, false, 0.01f, base, spread, 1e9f}, stretches);
    float worst = 0;
    for (std::size_t i = 0; i < stretches.size(); ++i) worst = std::max(worst, std::abs(marched[i] - exact[i]));
    return worst;
  }
  void TearDown() override { use_instruction_set(""); }

  Field field = random_field();
  BrickGrid grid = make_grid(field);
  DensityStretches stretches = random_stretches(100);
};

INSTANTIATE_TEST_SUITE_P(Bricks, DensityIntegral, testing::Bool(),
                         [](const auto& bordered) { return bordered.param ? "bordered" : "plain"; });

TEST_P(DensityIntegral, DdaIsExact) {
  for (const bool linear : {false, true}) {
    std::vector<double> expected;
    for (std::size_t i = 0; i < stretches.size(); ++i) expected.push_back(oracle(field, stretches, i, linear));
    for (const InstructionSet& set : available_instruction_sets()) {
      ASSERT_TRUE(use_instruction_set(set.name));
      const auto integral = integrate({linear, true, 0, 0, 0, 1e9f}, stretches);
      for (std::size_t i = 0; i < stretches.size(); ++i) {
        // The oracle itself sees the jumps of nearest interpolation only to one of its steps.
        const double oracle_error = linear ? 1e-6 : static_cast<double>(stretches.length[i]) * 60 / 40000 * 0.1;
        EXPECT_NEAR(integral[i], expected[i], 2e-5 * expected[i] + oracle_error) << set.name << " " << i;
      }
    }
  }
}

// Catches quadrature over voxels where the interpolant is smooth only within dual cells.
TEST_P(DensityIntegral, LinearOverPrimalVoxelsWouldBeWrong) {
  double worst = 0;
  const auto nearest = integrate({false, true, 0, 0, 0, 1e9f}, stretches);
  for (std::size_t i = 0; i < stretches.size(); ++i)
    worst = std::max(worst, std::abs(static_cast<double>(nearest[i]) - oracle(field, stretches, i, true, 4000)));
  EXPECT_GT(worst, 0.05);
}

TEST_P(DensityIntegral, MarchingConvergesToTheDda) {
  for (const InstructionSet& set : available_instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set.name));
    const auto exact = integrate({true, true, 0, 0, 0, 1e9f}, stretches);
    const auto fine = integrate({true, false, 0.01f, 0.5f, 0, 1e9f}, stretches);
    const auto coarse = integrate({true, false, 4.0f, 0.5f, 0, 1e9f}, stretches);
    double fine_error = 0, coarse_error = 0;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      EXPECT_NEAR(fine[i], exact[i], 1e-3 * static_cast<double>(exact[i]) + 1e-3) << set.name;
      fine_error += std::abs(static_cast<double>(fine[i] - exact[i]));
      coarse_error += std::abs(static_cast<double>(coarse[i] - exact[i]));
    }
    EXPECT_LT(fine_error, 0.01 * coarse_error) << set.name;
  }
}

// Catches steps over an empty brick that go too far, or over one into which a neighbour's values reach.
TEST_P(DensityIntegral, MarchingStepsOverWhatIsEmptyOnly) {
  grid = make_grid(corner_field());
  stretches = random_stretches(1000);
  const std::vector<float> linear = by_dda(true), nearest = by_dda(false);
  for (const InstructionSet& set : available_instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set.name));
    for (const auto& [base, spread] : {std::pair{0.5f, 0.0f}, {0.0f, 1.0f}, {0.25f, 0.5f}}) {
      EXPECT_LT(worst_of_marching(true, base, spread, linear), 2e-3f) << set.name << " " << base;
      EXPECT_LT(worst_of_marching(false, base, spread, nearest), 2e-2f) << set.name << " " << base;
    }
  }
  // The twin: all bricks without a value of their own are taken for empty, as if their neighbours were empty too.
  const BrickGrid plain = make_brick_grid(resolution, corner_field().values, Storage::f32);
  for (std::size_t i = 0; i < grid.table.size(); i += 2)
    if (plain.table[i] == 0) grid.table[i] = 0, grid.table[i + 1] = gap_steps;
  EXPECT_GT(worst_of_marching(true, 0.5f, 0, linear), 0.1f);
}

// The z-score of marching with coarse steps at one random place each, over many streams, against the exact integral.
double placement_z(const std::vector<float>& samples, double expected) {
  double sum = 0, squares = 0;
  const auto n = static_cast<double>(samples.size());
  for (const float s : samples) {
    sum += static_cast<double>(s);
    squares += static_cast<double>(s) * static_cast<double>(s);
  }
  const double mean = sum / n, variance = (squares / n - mean * mean) / (n - 1);
  return (mean - expected) / std::sqrt(variance);
}

TEST_P(DensityIntegral, RandomPlacementIsUnbiased) {
  DensityStretches many;
  for (std::uint32_t key = 0; key < 65536; ++key)
    many.add({1.3f, 2.2f, 0.4f}, {0.2f, 0.3f, 0.45f}, 50, key * 2654435761u);
  const double expected = static_cast<double>(integrate({true, true, 0, 0, 0, 1e9f}, many)[0]);
  for (const InstructionSet& set : available_instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set.name));
    EXPECT_LT(std::abs(placement_z(integrate({true, false, 5, 0, 1, 1e9f}, many), expected)), 4) << set.name;
    // Its twin, with the fault that the place is drawn from half of the step only, is rejected.
    EXPECT_GT(std::abs(placement_z(integrate({true, false, 5, 0, 0.5f, 1e9f}, many), expected)), 8) << set.name;
  }
}

TEST_P(DensityIntegral, AResultDoesNotDependOnItsNeighbours) {
  const auto all = integrate({true, false, 0.7f, 0, 1, 1e9f}, stretches);
  for (const std::size_t i : {std::size_t{0}, std::size_t{17}, std::size_t{99}}) {
    DensityStretches one;
    one.add({stretches.entry_x[i], stretches.entry_y[i], stretches.entry_z[i]},
            {stretches.direction_x[i], stretches.direction_y[i], stretches.direction_z[i]}, stretches.length[i],
            stretches.random_key[i]);
    EXPECT_EQ(integrate({true, false, 0.7f, 0, 1, 1e9f}, one)[0], all[i]);
  }
}

TEST_P(DensityIntegral, EnoughEndsEarlyAndNotTooEarly) {
  const auto all = integrate({true, false, 0.7f, 0.5f, 0, 1e9f}, stretches);
  const auto some = integrate({true, false, 0.7f, 0.5f, 0, 2.0f}, stretches);
  for (std::size_t i = 0; i < stretches.size(); ++i)
    EXPECT_TRUE(some[i] == all[i] || (some[i] > 2 && some[i] < all[i]));
}

}  // namespace
}  // namespace brume

// The walk through cells of majorants, and the one tap that stands for an interpolant: points of a ray lie in the cell
// that the walk says, or at most 1e-5 of the walk's length outside it; cells are within the border; a tap's mean over
// its random bits is the interpolant.
#include <gtest/gtest.h>

#include "kernel/statistics.h"
#include "kernel/test_grids.h"
#include "kernel/walk.h"

namespace brume {
namespace {

constexpr int cells = 12;  // without the border
constexpr kernel::uint row = cells + 2, layer = row * row;

// How far p lies outside the cube of edge `edge` at `corner`.
double outside(const std::array<double, 3>& p, const std::array<int, 3>& cell, double edge) {
  double worst = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    worst = std::max({worst, cell[axis] * edge - p[axis], p[axis] - (cell[axis] + 1) * edge});
  return worst;
}

struct Faults {
  int outside = 0, beyond_border = 0, walked = 0;
};

// Walks rays through voxels [-shift, cells edge + shift]^3, in cells of `edge` voxels; the walk takes its cells to be
// of `believed_edge`.
Faults walk_rays(int edge, double believed_edge, float shift) {
  Faults faults;
  const kernel::MajorantGrid grid{nullptr, row, layer, static_cast<float>(1 / believed_edge)};
  const auto lo = -shift, hi = static_cast<float>(cells * edge) + shift;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const TestRay ray = make_ray(i, lo, hi, i % 3 == 0 ? 1000.0f : 2.0f);
    const kernel::BoxSpan span = kernel::box_span(ray.origin, ray.direction, {lo, lo, lo}, {hi, hi, hi}, 0.0f, 1e30f);
    const std::array<double, 3> o = to_array(span.entry), d = to_array(ray.direction);
    const double speed = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
    if (span.t_length <= 0 || speed < 1e-20) continue;  // no ray of a picture is that slow
    ++faults.walked;
    const double tolerance = 1e-5 * (speed * static_cast<double>(span.t_length) + cells * edge);
    kernel::MajorantWalk walk = kernel::majorant_start(grid, span.entry, ray.direction);
    int steps = 0;
    for (float t = 0; t < span.t_length && steps < 4 * cells; ++steps) {
      const float leave = kernel::min(kernel::majorant_cell_exit(walk), span.t_length);
      const std::array<int, 3> cell{walk.cell % static_cast<int>(row) - 1,
                                    walk.cell / static_cast<int>(row) % static_cast<int>(row) - 1,
                                    walk.cell / static_cast<int>(layer) - 1};
      const bool is_in_grid = walk.cell >= 0 && walk.cell < static_cast<int>(layer * row);
      faults.beyond_border += !is_in_grid;
      for (const double at : {0.01, 0.5, 0.99}) {
        const double s = static_cast<double>(t) + at * (static_cast<double>(leave) - static_cast<double>(t));
        const std::array<double, 3> p{o[0] + s * d[0], o[1] + s * d[1], o[2] + s * d[2]};
        faults.outside += outside(p, cell, edge) > tolerance;
      }
      t = leave;
      kernel::majorant_step(walk, true);
    }
    faults.beyond_border += steps == 4 * cells;
  }
  return faults;
}

TEST(MajorantWalk, PointsLieInTheirCells) {
  for (const int edge : {1, 4, 7, 50}) {
    const Faults faults = walk_rays(edge, edge, 0.5f);
    EXPECT_GT(faults.walked, 10000);
    EXPECT_EQ(faults.outside, 0) << edge;
    EXPECT_EQ(faults.beyond_border, 0) << edge;
  }
}

// Cells that are believed to be 1 % larger than they are.
TEST(MajorantWalkTwin, OtherCellsAreRejected) { EXPECT_GT(walk_rays(4, 4.04, 0.5f).outside, 1000); }

// The chi-squared of the eight neighbours that a tap takes, over all its 48 bits, at points of a cell of eight values.
double tap_p_value(kernel::vec3 fraction, kernel::vec3 believed) {
  std::vector<float> values(8 * 8 * 8, 0);
  for (int corner = 0; corner < 8; ++corner)
    values[static_cast<std::size_t>(3 + (corner & 1) + 8 * (3 + (corner >> 1 & 1)) + 64 * (3 + (corner >> 2)))] =
        static_cast<float>(corner + 1);
  const BrickGrid grid = make_brick_grid({8, 8, 8}, values, Storage::f32);
  const kernel::BrickGrid view = kernel_view(grid);
  std::vector<double> counts(8), chances(8);
  constexpr std::uint32_t taps = 1u << 20;
  for (std::uint32_t i = 0; i < taps; ++i) {
    const kernel::RandomWords r = kernel::random_words(17, 3, 5, i);
    const float v = kernel::grid_stochastic(view, fraction + kernel::vec3(3.5f, 3.5f, 3.5f), r.x, r.y);
    if (v < 1) return 0;
    ++counts[static_cast<std::size_t>(v) - 1];
  }
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const auto weight = [&](unsigned bit, float f) { return static_cast<double>(corner >> bit & 1 ? f : 1 - f); };
    chances[corner] = weight(0, believed.x) * weight(1, believed.y) * weight(2, believed.z);
  }
  return chi_squared_p_value(chi_squared(counts, chances, taps), 7);
}

// Catches bits that are shared between axes, and a tap that is not where the interpolant is.
TEST(StochasticTap, ChoosesNeighboursWithTheInterpolantsWeights) {
  const double significance = sidak(0.01, 3);
  EXPECT_GT(tap_p_value({0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f}), significance);
  EXPECT_GT(tap_p_value({0.1f, 0.7f, 0.35f}, {0.1f, 0.7f, 0.35f}), significance);
  EXPECT_GT(tap_p_value({0.9f, 0.25f, 0.6f}, {0.9f, 0.25f, 0.6f}), significance);
  // Its twin, a hundredth of a voxel away.
  EXPECT_LT(tap_p_value({0.11f, 0.7f, 0.35f}, {0.1f, 0.7f, 0.35f}), 1e-10);
}

}  // namespace
}  // namespace brume

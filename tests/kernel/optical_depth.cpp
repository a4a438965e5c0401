// Optical depth by the DDA, in float, against quadrature in double: to 1e-5 relative, with nearest density over the
// voxels and with linear density over the dual cells (mean of the interpolant times chord). The faults this catches:
// linear density integrated over voxels, where the interpolant is no polynomial; t accumulated from a distant origin.
#include <gtest/gtest.h>

#include "kernel/test_grids.h"
#include "kernel/walk.h"
#include "sanitized.h"

namespace brume {
namespace {

constexpr int edge = 24;

constexpr std::uint32_t rays = sanitized ? 4000 : 100000;

// Noise in a brick grid of 16-bit values, and the same values as doubles.
struct Noise {
  BrickGrid grid = make_brick_grid({edge, edge, edge}, noise_values({edge, edge, edge}, 0.05f), Storage::u16);
  kernel::BrickGrid view = kernel_view(grid);

  // In double, at a point in index coordinates.
  double voxel(int x, int y, int z) const { return kernel::grid_voxel(view, x, y, z); }
  double nearest(const std::array<double, 3>& p) const {
    return voxel(static_cast<int>(std::floor(p[0])), static_cast<int>(std::floor(p[1])),
                 static_cast<int>(std::floor(p[2])));
  }
  double linear(const std::array<double, 3>& p) const {
    std::array<int, 3> i;
    std::array<double, 3> f;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double at = p[axis] - 0.5;
      i[axis] = static_cast<int>(std::floor(at));
      f[axis] = at - std::floor(at);
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
      sum +=
          (x ? f[0] : 1 - f[0]) * (y ? f[1] : 1 - f[1]) * (z ? f[2] : 1 - f[2]) * voxel(i[0] + x, i[1] + y, i[2] + z);
    }
    return sum;
  }
};

// Adaptive Simpson quadrature of f over [a, b].
template <class Function>
double simpson(Function f, double a, double b, double fa, double fm, double fb, double tolerance, int depth) {
  const double m = 0.5 * (a + b), h = b - a;
  const double fl = f(0.5 * (a + m)), fr = f(0.5 * (m + b));
  const double whole = h / 6 * (fa + 4 * fm + fb), halves = h / 12 * (fa + 4 * fl + 2 * fm + 4 * fr + fb);
  if (depth == 0 || std::abs(halves - whole) <= 15 * tolerance) return halves + (halves - whole) / 15;
  return simpson(f, a, m, fa, fl, fm, tolerance / 2, depth - 1) +
         simpson(f, m, b, fm, fr, fb, tolerance / 2, depth - 1);
}

// The integral of a density along a ray, cell by cell of the lattice on which it is smooth.
template <class Density>
double quadrature(const std::array<double, 3>& origin, const std::array<double, 3>& direction, double length,
                  double shift, Density density) {
  const std::array shifted{origin[0] - shift, origin[1] - shift, origin[2] - shift};
  double sum = 0;
  for (const Visit& v : oracle_walk(shifted, direction, length)) {
    const double inset = 1e-9 * v.chord(), a = v.t_in + inset, b = v.t_out - inset;  // not on the cell's faces
    const auto f = [&](double t) {
      return density({origin[0] + t * direction[0], origin[1] + t * direction[1], origin[2] + t * direction[2]});
    };
    sum += simpson(f, a, b, f(a), f(0.5 * (a + b)), f(b), 1e-9 * v.chord(), 10);
  }
  return sum;
}

kernel::vec3 shifted(kernel::vec3 p, float by) { return p - kernel::vec3(by, by, by); }

double dda_nearest(const Noise& noise, const TestRay& ray, const kernel::BoxSpan& span) {
  float sum = 0;
  for (const Visit& v : kernel_walk(span.entry, ray.direction, span.t_length))
    sum += kernel::grid_voxel(noise.view, v.cell[0], v.cell[1], v.cell[2]) * static_cast<float>(v.chord());
  return sum;
}

double dda_linear(const Noise& noise, const TestRay& ray, const kernel::BoxSpan& span) {
  const kernel::vec3 origin = shifted(span.entry, 0.5f);
  float sum = 0;
  for (const Visit& v : kernel_walk(origin, ray.direction, span.t_length)) {
    const auto [x, y, z] = v.cell;
    const float t_in = static_cast<float>(v.t_in), t_out = static_cast<float>(v.t_out);
    const kernel::Cell cell = kernel::grid_cell(noise.view, x, y, z);
    sum += (t_out - t_in) * kernel::cell_mean_linear(cell, x, y, z, origin, ray.direction, t_in, t_out);
  }
  return sum;
}

// Twin: two-point Gauss-Legendre quadrature over voxels.
double voxels_linear(const Noise& noise, const TestRay& ray, const kernel::BoxSpan& span) {
  double sum = 0;
  for (const Visit& v : kernel_walk(span.entry, ray.direction, span.t_length)) {
    const auto middle = static_cast<float>(0.5 * (v.t_in + v.t_out)),
               reach = static_cast<float>(0.288675135 * v.chord());
    sum += 0.5 * v.chord() *
           (kernel::grid_linear(noise.view, span.entry + (middle - reach) * ray.direction) +
            kernel::grid_linear(noise.view, span.entry + (middle + reach) * ray.direction));
  }
  return sum;
}

// Twin: t is the distant origin's own.
double distant_linear(const Noise& noise, const TestRay& ray, const kernel::BoxSpan& span) {
  const kernel::vec3 origin = shifted(ray.origin, 0.5f);
  float sum = 0, t = span.t_enter;
  for (const Visit& v : kernel_walk(shifted(span.entry, 0.5f), ray.direction, span.t_length)) {
    const auto [x, y, z] = v.cell;
    const float next = t + static_cast<float>(v.chord());
    const kernel::Cell cell = kernel::grid_cell(noise.view, x, y, z);
    sum += (next - t) * kernel::cell_mean_linear(cell, x, y, z, origin, ray.direction, t, next);
    t = next;
  }
  return sum;
}

double nearest_truth(const Noise& noise, const TestRay& ray, const kernel::BoxSpan& span) {
  return quadrature(to_array(span.entry), to_array(ray.direction), span.t_length, 0,
                    [&](const std::array<double, 3>& p) { return noise.nearest(p); });
}

double linear_truth(const Noise& noise, const TestRay& ray, const kernel::BoxSpan& span) {
  return quadrature(to_array(span.entry), to_array(ray.direction), span.t_length, 0.5,
                    [&](const std::array<double, 3>& p) { return noise.linear(p); });
}

// Of the ray as given, before its entry was rounded.
double given_ray_truth(const Noise& noise, const TestRay& ray, const kernel::BoxSpan& span) {
  std::array<double, 3> entry = to_array(ray.origin);
  for (std::size_t axis = 0; axis < 3; ++axis) entry[axis] += to_array(ray.direction)[axis] * span.t_enter;
  return quadrature(entry, to_array(ray.direction), span.t_length, 0.5,
                    [&](const std::array<double, 3>& p) { return noise.linear(p); });
}

using OpticalDepthOf = double (*)(const Noise& noise, const TestRay& ray, const kernel::BoxSpan& span);

// Rays at the box [lo, hi]^3, a third of them from up to a thousand boxes away: how many of the approximate optical
// depths are more than 1e-5 of the exact one off, and the worst error also as a part of (|entry distance| + chord).
struct Verdict {
  int walked = 0, wrong = 0;
  double worst = 0, worst_of_distance = 0;
};
Verdict judge(float lo, float hi, std::uint32_t count, OpticalDepthOf approximate, OpticalDepthOf exact) {
  const Noise noise;
  Verdict verdict;
  for (std::uint32_t i = 0; i < count; ++i) {
    const TestRay ray = make_ray(i, lo, hi, i % 3 == 0 ? 1000.0f : 1.5f);
    const kernel::BoxSpan span = kernel::box_span(ray.origin, ray.direction, {lo, lo, lo}, {hi, hi, hi}, 0.0f, 1e30f);
    if (span.t_length <= 0) continue;
    const double expected = exact(noise, ray, span), error = std::abs(approximate(noise, ray, span) - expected);
    ++verdict.walked;
    verdict.wrong += error > 1e-5 * expected;
    verdict.worst = std::max(verdict.worst, error / expected);
    verdict.worst_of_distance = std::max(verdict.worst_of_distance, error / (span.t_enter + span.t_length));
  }
  return verdict;
}

TEST(OpticalDepth, NearestByVoxels) {
  const Verdict verdict = judge(0, edge, rays, dda_nearest, nearest_truth);
  EXPECT_EQ(verdict.wrong, 0) << "worst " << verdict.worst;
  EXPECT_GT(verdict.walked, static_cast<int>(rays) / 2);
}

TEST(OpticalDepth, LinearByDualCells) {
  const Verdict verdict = judge(0, edge, rays, dda_linear, linear_truth);
  EXPECT_EQ(verdict.wrong, 0) << "worst " << verdict.worst;
  EXPECT_GT(verdict.walked, static_cast<int>(rays) / 2);
}

// With the fade to 0 beyond the array; a corner of it can hold next to nothing, so the error is a part of the distance.
TEST(OpticalDepth, LinearOverAllOfTheSupport) {
  const Verdict verdict = judge(-0.5f, edge + 0.5f, rays / 4, dda_linear, linear_truth);
  EXPECT_LE(verdict.worst_of_distance, 1e-6);
}

TEST(OpticalDepth, LinearAlongTheRayAsGiven) {
  EXPECT_LE(judge(0, edge, rays / 4, dda_linear, given_ray_truth).worst_of_distance, 1e-5);
}

TEST(OpticalDepthTwin, LinearByVoxelsIsRejected) {
  const Verdict verdict = judge(0, edge, rays / 10, voxels_linear, linear_truth);
  EXPECT_GT(verdict.wrong, verdict.walked / 2);
  EXPECT_GT(verdict.worst, 1e-2);
}

TEST(OpticalDepthTwin, DistantTIsRejected) {
  const Verdict verdict = judge(0, edge, rays / 10, distant_linear, linear_truth);
  EXPECT_GT(verdict.wrong, verdict.walked / 10);
}

}  // namespace
}  // namespace brume

// Light of a point light placed along flights through grids: single scattering along a ray, as in the homogeneous
// medium that the grid is there. Source: quadrature.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lanes/instruction_set.h"
#include "render/estimates.h"
#include "sanitized.h"

namespace brume {
namespace {

// The ray is at x = y = 0 from z = 0 to 4, the lamp at (1, 0, 2). A voxel in a corner, where no light comes by, may be
// denser, which makes light be placed nearer to the lamp alone.
SceneDescription lamp_in_a_grid(float density, float corner, float sigma_a, float sigma_s, float g, bool linear) {
  SceneDescription s = needle_scene({0, 0, -1});
  s.integrator.name = "volpath";
  s.integrator.max_depth = 1;
  std::vector<float> values(std::size_t{8} * 8 * 8, density);
  values[0] = corner;
  s.media = {grid_medium("smoke", {-2, -2, 0}, {2, 2, 4}, {8, 8, 8}, values, sigma_a, sigma_s)};
  s.media[0].linear_interpolation = linear;
  if (g != 0) set_phase(s.media[0], "henyey_greenstein", {g});
  s.shapes = {free_volume("smoke")};
  s.lights = {point_light({1, 0, 2}, 1)};
  return s;
}

// What the ray's part [begin, end] gives where the extinction is 0.4.
double single_scattering(double sigma_s, double g, double begin, double end) {
  constexpr int steps = 4000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = begin + (end - begin) * (i + 0.5) / steps, squared = 1 + (t - 2) * (t - 2), r = std::sqrt(squared);
    const double phase = (1 - g * g) / std::pow(1 + g * g - 2 * g * (2 - t) / r, 1.5) / (4 * std::numbers::pi);
    sum += sigma_s * phase * std::exp(-0.4 * (t + r)) / squared;
  }
  return sum * (end - begin) / steps;
}

// The grid's density is 2. By the corner's, light is placed everywhere, as far as 2.5 from the lamp, on the half of the
// ray that is within 1.41 of it, or nowhere.
// Catches a density left out, light that is gathered twice where it is placed, places that are counted from where the
// ray begins, for which the lamp is a unit further on, and a cosine to the lamp whose sign is turned. The twins are so.
TEST(LightPlacement, InAnEvenGridIsThatInAHomogeneousMedium) {
  struct Part {
    float corner;
    double half;
  };
  for (const auto& [corner, half] : {Part{2, 2}, Part{3.54f, 1}, Part{80, 0}}) {
    std::printf("corner %.2f\n", static_cast<double>(corner));
    const SceneDescription even = lamp_in_a_grid(2, corner, 0, 0.2f, 0, false);
    const SceneDescription forwards = lamp_in_a_grid(2, corner, 0.1f, 0.1f, 0.6f, false);
    const double all = single_scattering(0.4, 0, 0, 4);
    expect_estimate(even, all, 0, 2e-3);
    expect_estimate(forwards, single_scattering(0.2, 0.6, 0, 4), 0, 2e-3);
    expect_rejected(forwards, {{single_scattering(0.2, -0.6, 0, 4), 0}}, 2e-3);
    if (half == 0) continue;
    const double placed = single_scattering(0.4, 0, 2 - half, 2 + half);
    expect_rejected(even, {{all - placed / 2, 0}}, 2e-3);
    expect_rejected(even, {{all + placed, 0}}, 2e-3);
    SceneDescription further = even;
    further.lights = {point_light({1, 0, 3}, 1)};
    expect_rejected(further, {{all, 0}}, 2e-3);
  }
}

// Linear interpolation is 1 in the inside, and fades at both ends of the ray, at one of which the lamp is.
// Catches places that are counted from where the ray begins and not from where it meets the grid, for which the lamp is
// as far away, and light that is placed by the density of the nearest voxel. The twins are so.
TEST(LightPlacement, EveryInstructionSetAndBothInterpolations) {
  SceneDescription near = lamp_in_a_grid(1, 1, 0, 0.5f, 0, false);
  for (const InstructionSet& set : available_instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set.name));
    expect_estimate(near, 0.01857249, 5e-9, 2e-3);
  }
  use_instruction_set("");
  near.lights = {point_light({1, 0, 3}, 1)};
  expect_rejected(near, {{0.01857249, 5e-9}}, 2e-3);

  SceneDescription placed = lamp_in_a_grid(1, 1, 0, 0.5f, 0, true), collided = lamp_in_a_grid(1, 40, 0, 0.5f, 0, true);
  placed.lights = collided.lights = {point_light({0.5, 0, 0}, 1)};
  collided.sampler.seed = 7;
  const Estimate a = estimate(placed, 400000), b = estimate(collided, 2000000);
  const double error = std::hypot(a.standard_error, b.standard_error);
  std::printf("placed %.6f, collided %.6f, error %.6f\n", a.mean, b.mean, error);
  EXPECT_LE(std::abs(a.mean - b.mean), 4 * error);
  EXPECT_LT(error, 4e-3 * a.mean);
  if (sanitized) return;
  placed.media[0].linear_interpolation = false;
  const Estimate nearest = estimate(placed, 400000);
  std::printf("by the nearest voxel %.6f\n", nearest.mean);
  EXPECT_GT(std::abs(nearest.mean - b.mean), 8 * error);
}

}  // namespace
}  // namespace brume

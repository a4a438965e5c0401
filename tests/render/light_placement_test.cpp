// Light of a point light placed along flights through grids: single scattering along a ray, as closed_forms_test.cpp
// has it for homogeneous media, where the grid is one there. Source: quadrature.
#include <gtest/gtest.h>

#include <cmath>

#include "lanes/instruction_set.h"
#include "render/estimates.h"
#include "sanitized.h"

namespace brume {
namespace {

// The ray is at x = y = 0 from z = 0 to 4, the lamp at (1, 0, 2). A voxel in a corner, where no light comes by, is
// denser, which makes light be placed nearer to the lamp alone: everywhere, on a half of the ray, nowhere.
SceneDescription lamp_in_a_grid(float density, float corner, float sigma_a, float g, bool linear) {
  SceneDescription s = needle_scene({0, 0, -1});
  s.integrator.name = "volpath";
  s.integrator.max_depth = 1;
  std::vector<float> values(std::size_t{8} * 8 * 8, density);
  values[0] = corner;
  s.media = {grid_medium("smoke", {-2, -2, 0}, {2, 2, 4}, {8, 8, 8}, values, sigma_a, 0.5f)};
  s.media[0].linear_interpolation = linear;
  if (g != 0) set_phase(s.media[0], "henyey_greenstein", {g});
  s.shapes = {free_volume("smoke")};
  s.lights = {point_light({1, 0, 2}, 1)};
  return s;
}

// Catches a density left out, a place at the wrong t, and light that is gathered twice or never where the placed part
// ends.
TEST(LightPlacement, InAGridOfOnesIsThatInAHomogeneousMedium) {
  for (const float corner : {1.0f, 2.0f, 40.0f}) {
    std::printf("corner %.0f\n", static_cast<double>(corner));
    expect_estimate(lamp_in_a_grid(1, corner, 0, 0, false), 0.01857249, 5e-9, 1e-3);
    expect_estimate(lamp_in_a_grid(1, corner, 0, 0.6f, false), 0.02007662, 5e-9, 1e-3);
    expect_estimate(lamp_in_a_grid(1, corner, 0.5f, 0, false), 0.00446067, 5e-9, 1e-3);
    // Twins: a density 5 % off, and an anisotropy.
    expect_rejected(lamp_in_a_grid(0.95f, corner, 0.5f, 0, false), 0.00446067);
    expect_rejected(lamp_in_a_grid(1, corner, 0, 0.5f, false), 0.02007662);
  }
}

// Linear interpolation is 1 in the inside, and fades at both ends of the ray, at one of which the lamp is.
// Catches places that are counted from where the ray begins and not from where it meets the grid, for which the lamp is
// as far away, and light that is placed by the density of the nearest voxel. The twins are so.
TEST(LightPlacement, EveryInstructionSetAndBothInterpolations) {
  SceneDescription near = lamp_in_a_grid(1, 1, 0, 0, false);
  for (const InstructionSet& set : available_instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set.name));
    expect_estimate(near, 0.01857249, 5e-9, 2e-3);
  }
  use_instruction_set("");
  near.lights = {point_light({1, 0, 3}, 1)};
  expect_rejected(near, {{0.01857249, 5e-9}}, 2e-3);

  SceneDescription placed = lamp_in_a_grid(1, 1, 0, 0, true), collided = lamp_in_a_grid(1, 40, 0, 0, true);
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

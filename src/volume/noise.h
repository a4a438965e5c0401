// Lattice noises over three-dimensional space, with a period beyond any use of them: functions of seed and place
// only.
#pragma once

#include <cstdint>

namespace brume {

struct NoisePoint {
  float x = 0, y = 0, z = 0;
};

// Gradient noise: continuous, zero at the lattice's points, about [-1, 1], features of about one unit.
// Source: K. Perlin, "Improving Noise", SIGGRAPH 2002, with gradients drawn by hash from its twelve.
float perlin_noise(std::uint32_t seed, NoisePoint p);

// Values drawn by hash at the lattice's points and interpolated with zero slope there: continuous, [0, 1].
float value_noise(std::uint32_t seed, NoisePoint p);

// The distance to the nearest of points strewn one to each unit cube: 0 at a point, seldom above 1, never above
// sqrt(3).
// Source: S. Worley, "A Cellular Texture Basis Function", SIGGRAPH 1996 (F1).
float worley_noise(std::uint32_t seed, NoisePoint p);

}  // namespace brume

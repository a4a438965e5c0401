// Lattice noises over three-dimensional space, with a period beyond any use of them: functions of seed and place
// only.
#pragma once

#include <algorithm>
#include <cstdint>

namespace brume {

struct NoisePoint {
  float x = 0, y = 0, z = 0;
};

inline NoisePoint operator+(NoisePoint a, NoisePoint b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline NoisePoint operator-(NoisePoint a, NoisePoint b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline NoisePoint scaled(NoisePoint p, float s) { return {p.x * s, p.y * s, p.z * s}; }

// 0 below lo, 1 above hi (or the other way round where hi < lo), smooth between.
inline float smooth_step(float lo, float hi, float x) {
  const float t = std::clamp((x - lo) / (hi - lo), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

// Gradient noise: continuous, zero at the lattice's points, about [-1, 1], features of about one unit.
// Source: K. Perlin, "Improving Noise", SIGGRAPH 2002, with gradients drawn by hash from its twelve.
float perlin_noise(std::uint32_t seed, NoisePoint p);

// Its gradient with respect to the place.
NoisePoint perlin_gradient(std::uint32_t seed, NoisePoint p);

// Octaves of gradient noise, each twice as fine and half as strong as the one before: about [-1, 1].
float fractal_noise(std::uint32_t seed, NoisePoint p, int octaves);

// A flow without sources or sinks, with eddies of about one unit and speeds of about 1: the cross product of the
// gradients of two noises.
// Source: I. DeWolf, "Divergence-Free Noise", 2005.
NoisePoint curl_noise(std::uint32_t seed, NoisePoint p);

// Values drawn by hash at the lattice's points and interpolated with zero slope there: continuous, [0, 1].
float value_noise(std::uint32_t seed, NoisePoint p);

// The distance to the nearest of points strewn one to each unit cube: 0 at a point, seldom above 1, never above
// sqrt(3).
// Source: S. Worley, "A Cellular Texture Basis Function", SIGGRAPH 1996 (F1).
float worley_noise(std::uint32_t seed, NoisePoint p);

}  // namespace brume

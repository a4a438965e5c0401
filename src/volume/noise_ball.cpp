// A flattened ball of noise, torn at its edge: dense regions beside empty ones, features of all sizes.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "volume/noise.h"
#include "volume/procedural.h"

namespace brume {
namespace {

constexpr int octaves = 5;

// At a place in [-1, 1]^3.
float density_at(NoisePoint p) {
  const float radius = std::sqrt(p.x * p.x + 2 * p.y * p.y + p.z * p.z);
  const float needed = (0.25f + 0.85f * radius) / 1.6f;  // the noise above which there is something
  float noise = 0, amplitude = 0.5f, frequency = 4;
  for (std::uint32_t octave = 0; octave < octaves; ++octave) {
    if (noise + 2 * amplitude <= needed) return 0;  // what is left cannot bring it there
    noise += amplitude * value_noise(octave, {frequency * p.x, frequency * p.y, frequency * p.z});
    amplitude *= 0.5f;
    frequency *= 2.03f;
  }
  return std::clamp(3 * 1.6f * (noise - needed), 0.0f, 1.0f);
}

}  // namespace

VolumeGrid noise_ball(int size, Storage storage, int threads) {
  const auto row = static_cast<std::size_t>(size);
  std::vector<float> values(row * row * row);
  const auto place = [&](int i) { return (2 * static_cast<float>(i) + 1) / static_cast<float>(size) - 1; };
  parallel_for(size, threads, [&](int z, int) {
    float* value = &values[static_cast<std::size_t>(z) * row * row];
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) *value++ = density_at({place(x), place(y), place(z)});
  });
  VolumeGrid grid;
  grid.name = "density";
  grid.bricks = make_brick_grid({size, size, size}, values, storage);
  const double voxel = 2.0 / size;
  grid.medium_from_index = translate({-1, -1, -1}) * scale({voxel, voxel, voxel});
  return grid;
}

}  // namespace brume

// pbrt's noise cloud: a place is moved along the slope of noise, which makes wisps, then octaves of noise are added up
// and cut off at 0; below y = 1/2 the cloud is filled up, above it thins out.
// Source: M. Pharr, W. Jakob and G. Humphreys, Physically Based Rendering, 4th ed. 2023, section 11.4.6.
#include <algorithm>
#include <cmath>

#include "volume/lattice.h"
#include "volume/noise.h"
#include "volume/procedural.h"

namespace brume {
namespace {

float density_at(const NoiseCloud& cloud, Vector3 p) {
  const auto f = static_cast<float>(cloud.frequency);
  NoisePoint q = scaled({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}, f);
  float reach = 0.05f * static_cast<float>(cloud.wispiness), frequency = 10;
  for (int wisp = 0; wisp < 2 && reach > 0; ++wisp) {
    q = q + scaled(perlin_gradient(0, scaled(q, frequency)), reach);
    reach *= 0.5f;
    frequency *= 1.99f;
  }
  float sum = 0, amplitude = 0.5f;
  frequency = 1;
  for (int octave = 0; octave < 5; ++octave) {
    sum += amplitude * perlin_noise(0, scaled(q, frequency));
    amplitude *= 0.5f;
    frequency *= 1.99f;
  }
  const auto y = static_cast<float>(p.y);
  const float billows = std::clamp((1 - y) * 4.5f * static_cast<float>(cloud.density) * sum, 0.0f, 1.0f);
  return std::clamp(billows + 2 * std::max(0.0f, 0.5f - y), 0.0f, 1.0f);
}

}  // namespace

VolumeGrid make_noise_cloud(const NoiseCloud& cloud, Storage storage, int threads) {
  const Vector3 size = cloud.p1 - cloud.p0;
  const double longest = std::max({size.x, size.y, size.z});
  Lattice lattice({size.x / longest, size.y / longest, size.z / longest}, cloud.size);
  Vector3 voxel;
  for (int axis = 0; axis < 3; ++axis) voxel[axis] = size[axis] / lattice.voxels[static_cast<std::size_t>(axis)];
  const Transform medium_from_index = translate(cloud.p0) * scale(voxel);
  VolumeGrid grid = fill_bricks("density", lattice, storage, threads, [&](std::array<int, 3> brick, auto& values) {
    bool any = false;
    for (int i = 0; i < brick_voxels; ++i) {
      const Vector3 middle{8 * brick[0] + (i & 7) + 0.5, 8 * brick[1] + (i >> 3 & 7) + 0.5,
                           8 * brick[2] + (i >> 6) + 0.5};
      const float density = density_at(cloud, medium_from_index.point(middle));
      values[static_cast<std::size_t>(i)] = density;
      any = any || density != 0;
    }
    return any;
  });
  grid.medium_from_index = medium_from_index;
  grid.support = Support::cut;
  return grid;
}

}  // namespace brume

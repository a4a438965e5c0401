#include "volume/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/scalar.h"

namespace brume {
namespace {

std::uint32_t lattice_bits(std::uint32_t seed, int x, int y, int z) {
  return kernel::random_bits(seed, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                             static_cast<std::uint32_t>(z));
}

// The product of the offset with one of the twelve directions to the middles of a cube's edges; four come twice.
float gradient_product(std::uint32_t bits, float x, float y, float z) {
  const std::uint32_t h = bits >> 28;
  const float u = h < 8 ? x : y;
  const float v = h < 4 ? y : h == 12 || h == 14 ? x : z;
  return ((h & 1) != 0 ? -u : u) + ((h & 2) != 0 ? -v : v);
}

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
float mix(float a, float b, float t) { return a + (b - a) * t; }

}  // namespace

float perlin_noise(std::uint32_t seed, NoisePoint p) {
  const float fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy), iz = static_cast<int>(fz);
  const float x = p.x - fx, y = p.y - fy, z = p.z - fz;
  std::array<float, 8> corner;
  for (int i = 0; i < 8; ++i) {
    const int dx = i & 1, dy = (i >> 1) & 1, dz = i >> 2;
    corner[static_cast<std::size_t>(i)] =
        gradient_product(lattice_bits(seed, ix + dx, iy + dy, iz + dz), x - static_cast<float>(dx),
                         y - static_cast<float>(dy), z - static_cast<float>(dz));
  }
  const float u = fade(x), v = fade(y), w = fade(z);
  return mix(mix(mix(corner[0], corner[1], u), mix(corner[2], corner[3], u), v),
             mix(mix(corner[4], corner[5], u), mix(corner[6], corner[7], u), v), w);
}

float worley_noise(std::uint32_t seed, NoisePoint p) {
  const float fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy), iz = static_cast<int>(fz);
  const float x = p.x - fx, y = p.y - fy, z = p.z - fz;
  float nearest = 3;  // squared
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const std::uint32_t bits = lattice_bits(seed, ix + dx, iy + dy, iz + dz);
        const float px = static_cast<float>(dx) + static_cast<float>(bits >> 22) * 0x1p-10f - x;
        const float py = static_cast<float>(dy) + static_cast<float>((bits >> 12) & 1023u) * 0x1p-10f - y;
        const float pz = static_cast<float>(dz) + static_cast<float>((bits >> 2) & 1023u) * 0x1p-10f - z;
        nearest = std::min(nearest, px * px + py * py + pz * pz);
      }
    }
  }
  return std::sqrt(nearest);
}

}  // namespace brume

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

// The unit cube that holds a point; corner i is at (i & 1, i >> 1 & 1, i >> 2) from its lowest.
struct Cell {
  int ix, iy, iz;
  float x, y, z;  // the point in the cube

  explicit Cell(NoisePoint p) {
    const float fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
    ix = static_cast<int>(fx), iy = static_cast<int>(fy), iz = static_cast<int>(fz);
    x = p.x - fx, y = p.y - fy, z = p.z - fz;
  }
  std::uint32_t bits(std::uint32_t seed, int i) const {
    return lattice_bits(seed, ix + (i & 1), iy + (i >> 1 & 1), iz + (i >> 2));
  }
  float interpolate(const std::array<float, 8>& corner) const {
    const float u = fade(x), v = fade(y), w = fade(z);
    return mix(mix(mix(corner[0], corner[1], u), mix(corner[2], corner[3], u), v),
               mix(mix(corner[4], corner[5], u), mix(corner[6], corner[7], u), v), w);
  }
};

}  // namespace

float value_noise(std::uint32_t seed, NoisePoint p) {
  const Cell cell(p);
  std::array<float, 8> corner;
  for (int i = 0; i < 8; ++i)
    corner[static_cast<std::size_t>(i)] = static_cast<float>(cell.bits(seed, i) >> 8) * 0x1p-24f;
  return cell.interpolate(corner);
}

float perlin_noise(std::uint32_t seed, NoisePoint p) {
  const Cell cell(p);
  std::array<float, 8> corner;
  for (int i = 0; i < 8; ++i)
    corner[static_cast<std::size_t>(i)] =
        gradient_product(cell.bits(seed, i), cell.x - static_cast<float>(i & 1),
                         cell.y - static_cast<float>(i >> 1 & 1), cell.z - static_cast<float>(i >> 2));
  return cell.interpolate(corner);
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

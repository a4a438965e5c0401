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

// One of the twelve directions to the middles of a cube's edges; four come twice.
NoisePoint lattice_gradient(std::uint32_t bits) {
  const std::uint32_t h = bits >> 28;
  const float u = (h & 1) != 0 ? -1.0f : 1.0f, v = (h & 2) != 0 ? -1.0f : 1.0f;
  NoisePoint g;
  (h < 8 ? g.x : g.y) = u;
  (h < 4 ? g.y : h == 12 || h == 14 ? g.x : g.z) = v;
  return g;
}

// The product of the offset with that direction.
float gradient_product(std::uint32_t bits, float x, float y, float z) {
  const std::uint32_t h = bits >> 28;
  const float u = h < 8 ? x : y;
  const float v = h < 4 ? y : h == 12 || h == 14 ? x : z;
  return ((h & 1) != 0 ? -u : u) + ((h & 2) != 0 ? -v : v);
}

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
float fade_slope(float t) { return 30 * t * t * (t - 1) * (t - 1); }
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

NoisePoint perlin_gradient(std::uint32_t seed, NoisePoint p) {
  const Cell cell(p);
  std::array<float, 8> product, gx, gy, gz;
  for (int i = 0; i < 8; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const NoisePoint g = lattice_gradient(cell.bits(seed, i));
    product[at] = g.x * (cell.x - static_cast<float>(i & 1)) + g.y * (cell.y - static_cast<float>(i >> 1 & 1)) +
                  g.z * (cell.z - static_cast<float>(i >> 2));
    gx[at] = g.x, gy[at] = g.y, gz[at] = g.z;
  }
  const float u = fade(cell.x), v = fade(cell.y), w = fade(cell.z);
  const auto across = [&](std::size_t a, std::size_t b, std::size_t c, float s,
                          float t) {  // mean difference along an axis
    const auto step = [&](std::size_t corner) { return product[corner + a] - product[corner]; };
    return mix(mix(step(0), step(b), s), mix(step(c), step(b + c), s), t);
  };
  return {cell.interpolate(gx) + fade_slope(cell.x) * across(1, 2, 4, v, w),
          cell.interpolate(gy) + fade_slope(cell.y) * across(2, 1, 4, u, w),
          cell.interpolate(gz) + fade_slope(cell.z) * across(4, 1, 2, u, v)};
}

float fractal_noise(std::uint32_t seed, NoisePoint p, int octaves) {
  float sum = 0, amplitude = 0.6f, frequency = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += amplitude * perlin_noise(seed + static_cast<std::uint32_t>(octave), scaled(p, frequency));
    amplitude *= 0.5f;
    frequency *= 2.03f;  // so that the lattices' points, where noise is 0, do not fall together
  }
  return sum;
}

NoisePoint curl_noise(std::uint32_t seed, NoisePoint p) {
  const NoisePoint a = perlin_gradient(seed, p), b = perlin_gradient(seed + 0x9e3779b9u, p);
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
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

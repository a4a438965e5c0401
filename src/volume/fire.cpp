// A flame: a column of burning gas that narrows into tongues. As in smoke.cpp a place is followed backwards through the
// eddies that tear the flame, here stretched upwards because hot gas is fast. What it finds is how hotly gas burns
// there, from about 1 in the flame's heart to 0 where it has gone out. Density and temperature are functions of that:
// soot is thick in the flame's outer parts and thin in its heart, and gas cools as it burns out.
//
// Source: D. Q. Nguyen, R. Fedkiw and H. W. Jensen, "Physically Based Modeling and Animation of Fire", SIGGRAPH 2002
// (temperature as a profile over the time since gas passed the flame's front).
#include <algorithm>
#include <cmath>

#include "volume/lattice.h"
#include "volume/noise.h"
#include "volume/procedural.h"

namespace brume {
namespace {

constexpr float ground = -0.95f, tip = 1.0f;
constexpr float side = 0.5f;  // half the width of the box

struct Flame {
  std::uint32_t seed;
  float turbulence;
};

float rise(float y) { return std::clamp((y - ground) / (tip - ground), 0.0f, 1.3f); }

NoisePoint before_eddies(const Flame& flame, NoisePoint p) {
  float frequency = 9, reach = 0.02f * flame.turbulence;
  for (std::uint32_t size = 0; size < 3; ++size) {
    for (int step = 0; step < 3; ++step) {
      const float grown = 0.15f + 0.85f * std::min(rise(p.y), 1.0f);
      const NoisePoint v =
          curl_noise(flame.seed + 10 * size, {frequency * p.x, 0.45f * frequency * p.y, frequency * p.z});
      p = p - scaled({v.x, 2 * v.y, v.z}, reach * grown);
    }
    frequency *= 0.5f;
    reach *= 1.9f;
  }
  return p;
}

// About 1 at the hottest, 0 and below outside of the flame.
float burning_at(const Flame& flame, NoisePoint p) {
  const NoisePoint q = before_eddies(flame, p);
  const float t = rise(q.y);
  const float radius = 0.85f * std::pow(t + 0.015f, 0.55f) * std::pow(std::max(0.0f, 1 - t), 1.25f) + 0.004f;
  const float sway = 0.25f * t;
  const float x = q.x - sway * perlin_noise(flame.seed + 42, {1.6f * q.y, 0.5f, 0});
  const float z = q.z - sway * perlin_noise(flame.seed + 43, {1.6f * q.y, 0.5f, 0});
  const float from_axis = std::sqrt(x * x + z * z) / radius;
  const float tongues = 0.5f - worley_noise(flame.seed + 40, {4.5f * q.x, 0.9f * q.y, 4.5f * q.z});
  const float flicker = fractal_noise(flame.seed + 41, {9 * q.x, 3 * q.y, 9 * q.z}, 4);
  return 0.8f - from_axis + (0.3f + 2.2f * t) * (tongues + 0.3f * flicker);
}

float soot(float burning) { return smooth_step(0, 0.4f, burning) * (1 - 0.7f * smooth_step(0.5f, 0.95f, burning)); }

float window(NoisePoint p) {
  const float inside = std::min({side - std::fabs(p.x), side - std::fabs(p.z), 1 - std::fabs(p.y)});
  return smooth_step(0.02f, 0.06f, inside) * smooth_step(-0.98f, ground + 0.03f, p.y);
}

}  // namespace

VolumeGrid make_fire(const Procedural& procedural, Storage storage, int threads) {
  const Flame flame{procedural.seed, procedural.values[0]};
  return fill_voxels("density", Lattice({side, 1, side}, procedural.size), storage, threads, [&](NoisePoint p) {
    const float w = window(p);
    return w == 0 ? 0 : w * soot(burning_at(flame, p));
  });
}

VolumeGrid make_fire_temperature(const Procedural& procedural, Storage storage, int threads) {
  const Flame flame{procedural.seed, procedural.values[0]};
  const float hottest = procedural.values[1];
  return fill_voxels("temperature", Lattice({side, 1, side}, procedural.size), storage, threads, [&](NoisePoint p) {
    const float w = window(p);
    if (w == 0) return 0.0f;
    const float b = burning_at(flame, p);
    return b <= 0 ? 0 : w * hottest * (0.55f + 0.45f * smooth_step(0, 0.8f, b)) * smooth_step(0, 0.1f, b);
  });
}

}  // namespace brume

// A plume of smoke. A place is followed backwards through the motions that smoke goes through as it rises, the latest
// first: eddies of three sizes (curl noise), then the vortex rings into which a plume rolls up, then its meandering. It
// ends in a plain column that widens upwards, whose density it takes.
//
// Sources: R. Bridson, J. Hourihan and M. Nordenstam, "Curl-Noise for Procedural Fluid Flow", SIGGRAPH 2007; J. S.
// Turner, "Buoyant Plumes and Thermals", Annual Review of Fluid Mechanics 1, 1969 (a plume's width grows with height).
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "kernel/scalar.h"
#include "volume/lattice.h"
#include "volume/noise.h"
#include "volume/procedural.h"

namespace brume {
namespace {

constexpr float source_height = -0.93f, highest = 0.95f;
constexpr float side = 0.5f;  // half the width of the box

// A vortex ring about the plume's axis: what is near its core was turned about the core by up to `turn` radians.
struct Ring {
  float height, radius, core, turn, x, z;
};

struct Plume {
  std::uint32_t seed;
  float turbulence;
  float widening;  // from the source to the top
  float top;       // of the column; the rings and eddies carry smoke higher
  std::vector<Ring> rings;

  // How far up a height is, 0 to 1.
  float rise(float y) const { return std::clamp((y - source_height) / (top - source_height), 0.0f, 1.0f); }

  float radius(float t) const { return 0.045f + widening * std::pow(t, 0.85f); }
};

Plume make_plume(const Procedural& smoke) {
  const float turbulence = smoke.values[0], widening = 0.1f + 0.2f * smoke.values[1];
  Plume plume{smoke.seed, turbulence, widening, highest - 0.7f * widening - 0.15f * turbulence, {}};
  std::uint32_t counter = 0;
  const auto between = [&](float lo, float hi) {
    return lo + (hi - lo) * kernel::random_uniform(smoke.seed, 1, 0, counter++);
  };
  for (float y = source_height + 0.12f; y < plume.top;) {
    const float radius = plume.radius(plume.rise(y));
    plume.rings.push_back({y, radius * between(0.7f, 0.95f), radius * between(0.5f, 0.75f), between(1.5f, 3.2f),
                           radius * between(-0.25f, 0.25f), radius * between(-0.25f, 0.25f)});
    y += radius * between(0.9f, 1.5f);
  }
  return plume;
}

// Where what is at p was before the eddies came, the finest last.
NoisePoint before_eddies(const Plume& plume, NoisePoint p) {
  const float grown = 0.25f + 0.75f * plume.rise(p.y);  // eddies have had less time low down
  float frequency = 14, reach = 0.022f * plume.turbulence * grown;
  for (std::uint32_t size = 0; size < 3; ++size) {
    for (int step = 0; step < 3; ++step)
      p = p - scaled(curl_noise(plume.seed + 10 * size, scaled(p, frequency)), reach);
    frequency *= 0.45f;
    reach *= 2.0f;
  }
  return p;
}

NoisePoint before_ring(const Ring& ring, NoisePoint p) {
  const float x = p.x - ring.x, z = p.z - ring.z, r = std::sqrt(x * x + z * z) + 1e-6f;
  const float out = r - ring.radius, up = p.y - ring.height;
  const float turn = ring.turn * std::exp(-(out * out + up * up) / (ring.core * ring.core));
  if (turn < 0.01f) return p;
  const float s = std::sin(turn), c = std::cos(turn);
  const float stretched = (ring.radius + c * out - s * up) / r;
  return {ring.x + x * stretched, ring.height + s * out + c * up, ring.z + z * stretched};
}

float density_at(const Plume& plume, NoisePoint p) {
  const float widest = 1.7f * plume.radius(plume.rise(p.y + 0.2f)) + 0.2f * plume.turbulence;
  if (p.x * p.x + p.z * p.z > widest * widest) return 0;
  NoisePoint q = before_eddies(plume, p);
  for (const Ring& ring : plume.rings) q = before_ring(ring, q);
  const float t = plume.rise(q.y);
  const float sway = 0.16f * t;
  q.x -= sway * perlin_noise(plume.seed + 50, {1.3f * q.y, 0.5f, 0});
  q.z -= sway * perlin_noise(plume.seed + 51, {1.3f * q.y, 0.5f, 0});

  const float cap = std::max(0.0f, (t - 0.6f) / 0.4f);  // the plume's head is round
  const float from_axis =
      std::sqrt(q.x * q.x + q.z * q.z) / (plume.radius(t) * std::sqrt(std::max(1e-4f, 1 - cap * cap)));
  const float streaks = fractal_noise(plume.seed + 60, {7 * q.x, 4 * q.y, 7 * q.z}, 4);
  float density = smooth_step(1, 0.6f, from_axis + 0.35f * streaks);
  density *= std::clamp(0.75f + 0.8f * streaks, 0.0f, 1.0f) * (1 - 0.65f * t);
  density *= smooth_step(source_height, source_height + 0.05f, q.y);
  const float inside = std::min({side - std::fabs(p.x), side - std::fabs(p.z), 1 - std::fabs(p.y)});
  return density * smooth_step(0.02f, 0.08f, inside);
}

}  // namespace

VolumeGrid make_smoke(const Procedural& procedural, Storage storage, int threads) {
  const Plume plume = make_plume(procedural);
  return fill_voxels("density", Lattice({side, 1, side}, procedural.size), storage, threads,
                     [&](NoisePoint p) { return density_at(plume, p); });
}

}  // namespace brume

// A layer of fog: density falls exponentially with height over the ground, as that of air that settled does, and soft
// noise, flattened and stirred, makes banks and clearings that grow with height. Towards the sides of its box it thins
// out, so that seen from outside it has no walls.
#include <algorithm>
#include <cmath>

#include "volume/lattice.h"
#include "volume/noise.h"
#include "volume/procedural.h"

namespace brume {
namespace {

constexpr float half_height = 0.2f;

struct Fog {
  std::uint32_t seed;
  float height;  // of the box, in which density falls to 1/e
  float patchiness;
};

float density_at(const Fog& fog, NoisePoint p) {
  const float up = (p.y + half_height) / (2 * half_height);  // 0 to 1
  NoisePoint q{2.2f * p.x, 5.5f * p.y, 2.2f * p.z};
  for (const float frequency : {2.1f, 1.0f})
    q = q - scaled(curl_noise(fog.seed, scaled(q, frequency)), 0.22f / frequency);
  const float banks = fractal_noise(fog.seed + 30, q, 5);
  // Banks lift the fog's surface: the same noise thins it to nothing high up and hardly at the ground.
  const float lifted = up - fog.patchiness * 1.1f * banks;
  const float layer = std::exp(-std::max(lifted, 0.0f) / fog.height);
  const float patches =
      1 - fog.patchiness * (0.4f + 0.6f * smooth_step(0, 0.6f, up)) * smooth_step(0.25f, -0.35f, banks);
  const float from_edge = 1 - std::max(std::fabs(p.x), std::fabs(p.z));
  return layer * patches * smooth_step(1, 0.55f, up + 0.25f * fog.patchiness * banks) *
         smooth_step(0, 0.25f, from_edge + 0.06f * banks) * smooth_step(1, 0.9f, up) *
         smooth_step(0.02f, 0.05f, from_edge);
}

}  // namespace

VolumeGrid make_fog(const Procedural& procedural, Storage storage, int threads) {
  const Fog fog{procedural.seed, procedural.values[0], procedural.values[1]};
  return fill_voxels("density", Lattice({1, static_cast<double>(half_height), 1}, procedural.size), storage, threads,
                     [&](NoisePoint p) { return density_at(fog, p); });
}

}  // namespace brume

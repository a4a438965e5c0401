// A cumulus cloud. Its form is a heap of spheres: towers that stand on one base, with smaller spheres grown on the
// upper sides of larger ones, blended to one surface. Inverted cellular noise of several octaves swells the surface
// into billows; gradient noise wears the flat base to wisps.
//
// Sources: G. Y. Gardner, "Visual Simulation of Clouds", SIGGRAPH 1985 (clouds as ellipsoids with textured edges);
// A. Bouthors and F. Neyret, "Modeling Clouds Shape", Eurographics 2004 (spheres grown on spheres); A. Schneider and
// N. Vos, "The Real-Time Volumetric Cloudscapes of Horizon: Zero Dawn", SIGGRAPH courses 2015 (inverted Worley noise
// for billows, Perlin noise for wisps, detail eroded from the edges).
#include "volume/procedural.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernel/scalar.h"
#include "volume/lattice.h"
#include "volume/noise.h"

namespace brume {
namespace {

constexpr float base_height = -0.42f;   // of the flat underside
constexpr float blend_width = 0.025f;   // over which spheres flow into one another
constexpr float most_outwards = 0.09f;  // bounds on how far noise moves the surface: see swell and cloud_density
constexpr float most_inwards = 0.2f;
constexpr float billow_edge = 0.02f;  // from no density to all of it
constexpr float negligible = 9;       // exp(-9) of a sphere is left out of a blend

struct Sphere {
  float x, y, z, radius;
};

// Uniform numbers by counter, so that spheres depend on the seed alone.
class Numbers {
 public:
  explicit Numbers(std::uint32_t seed) : seed_(seed) {}
  float next() { return kernel::random_uniform(seed_, 0, 0, counter_++); }
  float between(float lo, float hi) { return lo + (hi - lo) * next(); }

 private:
  std::uint32_t seed_, counter_ = 0;
};

// A column of spheres that narrow upwards. Places are in the box's units, `height` above the base.
struct Tower {
  float x, z, radius, height;
};
constexpr Tower towers[] = {
    {-0.08f, 0.02f, 0.25f, 0.80f},  {0.24f, -0.08f, 0.22f, 0.58f},  {-0.36f, 0.10f, 0.20f, 0.52f},
    {0.10f, 0.30f, 0.19f, 0.42f},   {-0.14f, -0.32f, 0.19f, 0.38f}, {0.48f, 0.12f, 0.17f, 0.34f},
    {-0.58f, -0.08f, 0.16f, 0.28f}, {0.36f, -0.38f, 0.15f, 0.24f},  {-0.38f, 0.42f, 0.14f, 0.24f},
    {0.70f, -0.10f, 0.11f, 0.18f},  {-0.77f, 0.14f, 0.10f, 0.15f},  {0.40f, 0.46f, 0.12f, 0.18f}};

std::vector<Sphere> make_towers(Numbers& numbers) {
  std::vector<Sphere> spheres;
  for (const Tower& tower : towers) {
    const float top = tower.height * numbers.between(0.85f, 1.0f);
    float radius = tower.radius * numbers.between(0.85f, 1.0f);
    float x = tower.x + numbers.between(-0.05f, 0.05f), z = tower.z + numbers.between(-0.05f, 0.05f);
    for (float y = 0; y + 0.9f * radius < top; y += 0.7f * radius, radius *= 0.9f) {
      spheres.push_back({x, base_height + y, z, radius});
      x += numbers.between(-0.25f, 0.25f) * radius;
      z += numbers.between(-0.25f, 0.25f) * radius;
    }
  }
  return spheres;
}

// Spheres on the surfaces of those from `first` on, most of them on the upper sides.
void grow(std::vector<Sphere>& spheres, std::size_t first, int children, Numbers& numbers) {
  const std::size_t end = spheres.size();
  for (std::size_t i = first; i < end; ++i) {
    const Sphere parent = spheres[i];
    for (int c = 0; c < children; ++c) {
      const float up = numbers.between(-0.35f, 1), around = numbers.between(0, 2 * std::numbers::pi_v<float>);
      const float across = std::sqrt(std::max(0.0f, 1 - up * up)),
                  radius = parent.radius * numbers.between(0.32f, 0.58f);
      const float away = parent.radius * numbers.between(0.8f, 1.0f);
      const Sphere child{parent.x + away * across * std::cos(around), parent.y + away * up,
                         parent.z + away * across * std::sin(around), radius};
      if (child.y > base_height) spheres.push_back(child);
    }
  }
}

std::vector<Sphere> make_form(std::uint32_t seed) {
  Numbers numbers(seed);
  std::vector<Sphere> spheres = make_towers(numbers);
  const std::size_t stems = spheres.size();
  grow(spheres, 0, 9, numbers);
  grow(spheres, stems, 5, numbers);
  return spheres;
}

float distance_to(const Sphere& s, float x, float y, float z) {
  return std::sqrt((x - s.x) * (x - s.x) + (y - s.y) * (y - s.y) + (z - s.z) * (z - s.z)) - s.radius;
}

// Signed distance, negative inside, to the blended surface: a smooth minimum -k log(sum of exp(-d / k)).
float form_distance(const std::vector<Sphere>& spheres, NoisePoint p) {
  float nearest = distance_to(spheres[0], p.x, p.y, p.z), sum = 1;  // of exp((nearest - d) / k)
  for (std::size_t i = 1; i < spheres.size(); ++i) {
    const float further = (distance_to(spheres[i], p.x, p.y, p.z) - nearest) / blend_width;
    if (further > negligible) continue;
    if (further >= 0) {
      sum += std::exp(-further);
    } else {
      sum = sum * std::exp(further) + 1;
      nearest += further * blend_width;
    }
  }
  return nearest - blend_width * std::log(sum);
}

// How far the billows move the surface outwards: bumps with creases between them, each octave on the last one's flanks.
// The amplitudes' sum is below 0.16, so that the result lies in 0.16 [0.55 - sqrt 3, 0.55].
float swell(std::uint32_t seed, NoisePoint p) {
  float sum = 0, amplitude = 0.085f, frequency = 5.5f;
  for (std::uint32_t octave = 0; octave < 4; ++octave) {
    sum += amplitude * (0.55f - worley_noise(seed + octave, scaled(p, frequency)));
    amplitude *= 0.5f;
    frequency *= 2.1f;
  }
  return sum;
}

float wisps(std::uint32_t seed, NoisePoint p) {
  float sum = 0, amplitude = 0.5f, frequency = 6;
  for (std::uint32_t octave = 0; octave < 4; ++octave) {
    sum += amplitude * perlin_noise(seed + octave, scaled(p, frequency));
    amplitude *= 0.55f;
    frequency *= 2.1f;
  }
  return sum;
}

struct Look {
  std::uint32_t seed;
  float billows;  // 0 to 1
};

// `spheres` are those that matter near p.
float cloud_density(const std::vector<Sphere>& spheres, const Look& look, NoisePoint p) {
  const float distance = form_distance(spheres, p);
  if (distance > most_outwards) return 0;
  const float above_base = p.y - base_height;
  const float low = 1 - smooth_step(0, 0.12f, above_base);  // 1 at the base, 0 in the billows
  if (distance < -most_inwards - billow_edge && low == 0) return 1;
  const float wisp = wisps(look.seed + 100, p);
  const NoisePoint warped{p.x + 0.02f * wisp, p.y - 0.02f * wisp, p.z + 0.015f * wisp};
  const float surface = distance - look.billows * swell(look.seed, warped) * (1 - 0.6f * low) - 0.05f * low * wisp;
  const float edge = billow_edge + 0.04f * low;
  float density = smooth_step(0, edge, -surface);
  density *= smooth_step(-0.01f, 0.04f, above_base + 0.03f * wisp);
  return density * (1 - 0.45f * low);
}

// Of `spheres`, those that matter within `reach` of a place; none where all there is surely empty.
std::vector<Sphere> spheres_near(const std::vector<Sphere>& spheres, NoisePoint p, float reach) {
  float nearest = 4;
  for (const Sphere& s : spheres) nearest = std::min(nearest, distance_to(s, p.x, p.y, p.z));
  const float most_blend = blend_width * std::log(static_cast<float>(spheres.size()));
  std::vector<Sphere> near;
  if (nearest > reach + most_outwards + most_blend) return near;
  for (const Sphere& s : spheres) {
    if (distance_to(s, p.x, p.y, p.z) < nearest + 2 * reach + negligible * blend_width) near.push_back(s);
  }
  return near;
}

// The values of a brick, by its eight 4^3 blocks, each with its own few spheres; false where all are 0.
bool fill_brick(const std::vector<Sphere>& form, const Look& look, const Lattice& lattice, std::array<int, 3> brick,
                std::array<float, brick_voxels>& values) {
  const float x = static_cast<float>(brick[0] * 8), y = static_cast<float>(brick[1] * 8),
              z = static_cast<float>(brick[2] * 8);
  const float corner = 4 * std::numbers::sqrt3_v<float> * lattice.voxel;  // from the brick's middle
  const std::vector<Sphere> near = spheres_near(form, lattice.place(x + 4, y + 4, z + 4), corner);
  if (near.empty()) return false;
  values.fill(0);
  for (int block = 0; block < 8; ++block) {
    const int bx = 4 * (block & 1), by = 4 * ((block >> 1) & 1), bz = 4 * (block >> 2);
    const NoisePoint middle =
        lattice.place(x + static_cast<float>(bx + 2), y + static_cast<float>(by + 2), z + static_cast<float>(bz + 2));
    const std::vector<Sphere> nearer = spheres_near(near, middle, 0.5f * corner);
    if (nearer.empty()) continue;
    for (int i = 0; i < 64; ++i) {
      const int vx = bx + (i & 3), vy = by + ((i >> 2) & 3), vz = bz + (i >> 4);
      const NoisePoint p = lattice.place(x + static_cast<float>(vx) + 0.5f, y + static_cast<float>(vy) + 0.5f,
                                         z + static_cast<float>(vz) + 0.5f);
      values[static_cast<std::size_t>(vz * 64 + vy * 8 + vx)] = cloud_density(nearer, look, p);
    }
  }
  return true;
}

}  // namespace

VolumeGrid make_cloud(const Procedural& procedural, Storage storage, int threads) {
  const Lattice lattice({1, 0.6, 1}, procedural.size);
  const std::vector<Sphere> form = make_form(procedural.seed);
  const Look look{procedural.seed, procedural.values[0]};
  return fill_bricks("density", lattice, storage, threads,
                     [&](std::array<int, 3> brick, std::array<float, brick_voxels>& values) {
                       return fill_brick(form, look, lattice, brick, values);
                     });
}

}  // namespace brume

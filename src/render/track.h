// Null-collision tracking through one grid, for many rays at a time: the stream.
//
// A worker keeps a few vectors of tracks in flight. Four phases run over them: steps through the grid of majorants;
// tentative collisions are located in memory, which is asked for their densities; the round after, these decide what
// the collisions are; and tracks end and new ones start. A phase runs for a vector once enough of its lanes wait for
// it, so that lanes are seldom idle although tracks differ in everything. Source of tracking: E. Woodcock et al., 1965;
// of its weights: B. Miller, I. Georgiev and W. Jarosz, "A Null-Scattering Path Integral Formulation of Light
// Transport", TOG 38(4), 2019; of ratio tracking: J. Novák et al., "Residual Ratio Tracking for Estimating Attenuation
// in Participating Media", TOG 33(6), 2014.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compiled/compiled_scene.h"

namespace brume {

// A medium's grid as tracking sees it.
struct TrackedGrid {
  TrackedGrid(const CompiledGrid& grid, const CompiledMedium& medium);
  kernel::BrickGrid density;
  kernel::MajorantGrid majorants;
  bool linear;           // else nearest
  float sigma_t[3];      // at density 1, per world unit
  float sigma_majorant;  // the largest of them
  bool chromatic;        // they differ
  float index_from_world[3][4];
};

// Stretches of rays through one medium, as columns. Stretch i is entry + t direction in index coordinates for t in
// [0, length], t in world units, all within the grid's bounds.
struct TrackColumns {
  float* entry[3] = {};
  float* direction[3] = {};
  float* length = nullptr;
  float* optical_depth = nullptr;  // to the first tentative collision, exponentially distributed
  // The stream of the stretch's random numbers: words (key, pixel, sample, counter) of kernel/random.inl.
  std::uint32_t* key = nullptr;
  std::uint32_t* pixel = nullptr;
  std::uint32_t* sample = nullptr;
  std::uint32_t* hero = nullptr;  // the channel whose extinction decides about collisions, where they differ
  // For the caller: whose stretch it is, and at which t of that ray it begins.
  std::uint32_t* ray = nullptr;
  float* t_begin = nullptr;

  // Results. Of track_collisions: the t of the first collision, or a negative number where there is none. Of
  // track_transmittance: an unbiased estimate of the transmittance, of the first channel where they differ.
  float* result = nullptr;
  // Where channels differ: of track_collisions, by how much null collisions change the path's weight in each channel;
  // of track_transmittance, the estimates of each channel.
  float* weight[3] = {};
};

class TrackTasks {
 public:
  std::uint32_t count = 0;
  TrackColumns columns;

  // Makes room for `more` stretches beyond `count`. Columns move.
  void make_room(std::uint32_t more);

  // Adds stretch i of another's, without results.
  void append(const TrackTasks& from, std::uint32_t i);

 private:
  std::uint32_t room_ = 0;
  std::array<std::vector<float>, 13> floats_;
  std::array<std::vector<std::uint32_t>, 5> words_;
};

// What was done, for benchmarks and for the report of violations.
struct TrackCounts {
  std::int64_t steps = 0, look_ups = 0;
  std::int64_t majorant_violations = 0;  // densities above their bound: a fault of ours, and a bias
};

// Results depend on their own stretch and the instruction set, not on the other stretches. No exceptions.
void track_collisions(const TrackedGrid& grid, TrackTasks& tasks, TrackCounts& counts);
// Grey grids. A track is not ended by its first collision with some chance, but split at every tentative collision in
// that proportion: weight[0] = an unbiased estimate of the transmittance, and `result` is where the rest collides,
// chosen among all collisions in proportion to their weights; negative where nothing collides.
void track_split(const TrackedGrid& grid, TrackTasks& tasks, TrackCounts& counts);
void track_transmittance(const TrackedGrid& grid, TrackTasks& tasks, TrackCounts& counts);

}  // namespace brume

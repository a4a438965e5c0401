#include "render/track.h"

#include <algorithm>

#include "render/ray_batch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/track.cpp"
#include <hwy/foreach_target.h>

#include "render/column_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brume {
namespace HWY_NAMESPACE {

// Vectors in flight: enough for their latencies to overlap, no more, since they run half empty at the end of a call.
constexpr int vector_count = 3;
constexpr int steps_a_round = 3;
// The least survival before roulette ends tracks that carry little transmittance.
constexpr float roulette_below = 0.1f;
// The least weight that a track is split at.
constexpr float split_above = 0.05f;

// One vector of tracks.
struct Tracks {
  vec3 origin, direction;
  MajorantWalk walk;
  F t, t_end;
  F optical_depth;  // left to the next tentative collision
  F majorant;       // extinction's, in the current cell
  U key, pixel, sample, counter;
  F weight[3];  // transmittance; or the null collisions' weights
  F hero_sigma;
  F chosen;          // the t of a split track's collision; negative where there is none
  VoxelPlace place;  // of the tentative collision, with what will decide about it
  U decision, next_distance;
  B stepping, waiting, located, done;
  HWY_ALIGN std::uint32_t task[HWY_MAX_BYTES / sizeof(std::uint32_t)];
};

enum class Tracking { collision, split, transmittance };

// What a track is followed for, and whether extinction differs between channels (never so for split ones).
template <Tracking tracking, bool is_chromatic>
struct Stream {
  static constexpr bool is_ratio = tracking == Tracking::transmittance, is_split = tracking == Tracking::split;
  static constexpr int weight_count = is_chromatic ? 3 : is_ratio || is_split ? 1 : 0;

  const BrickGrid density;
  const MajorantGrid majorants;
  const TrackedGrid& grid;
  const TrackColumns& tasks;
  const std::uint32_t task_count;
  TrackCounts& counts;
  std::uint32_t next_task = 0;
  Tracks vectors[vector_count];

  // Steps lanes to their next tentative collision, cell by cell.
  HWY_INLINE void step(Tracks& v) {
    const F exit = min(majorant_cell_exit(v.walk), v.t_end);
    const F needed = v.majorant * (exit - v.t);
    const B collides = both(v.stepping, v.optical_depth < needed);
    const B moves = both(v.stepping, v.optical_depth >= needed);
    v.waiting = either(v.waiting, collides);
    v.optical_depth = select(moves, v.optical_depth - needed, v.optical_depth);
    v.t = select(moves, exit, v.t);
    const B ends = both(moves, exit >= v.t_end);
    v.done = either(v.done, ends);
    v.stepping = both(moves, exit < v.t_end);
    majorant_step(v.walk, v.stepping);
    v.majorant = select(v.stepping, majorant_at(majorants, v.walk.cell) * grid.sigma_majorant, v.majorant);
    counts.steps += static_cast<std::int64_t>(count_lanes(moves));
  }

  // Finds where in memory the densities at tentative collisions are, and asks for them.
  HWY_INLINE void locate(Tracks& v) {
    const B here = v.waiting;
    counts.look_ups += static_cast<std::int64_t>(count_lanes(here));
    v.t = select(here, min(v.t + v.optical_depth / v.majorant, v.t_end), v.t);
    // Idle lanes look where memory is near, the border's corner, for their loads cost as much as the others'.
    const vec3 nowhere(0.0f, 0.0f, 0.0f);
    const vec3 p = select3(here, v.origin + v.t * v.direction, nowhere);
    const RandomWords r = random_words(v.key, v.pixel, v.sample, v.counter);
    v.counter = select(here, v.counter + U(1u), v.counter);
    v.place = grid.linear ? grid_stochastic_place(density, p, r.x, r.y) : grid_nearest_place(density, p);
    v.decision = r.z;
    v.next_distance = r.w;
    prefetch(density.bricks, v.place.word);
    v.located = here;
    v.waiting = no_lanes();
  }

  // Looks up the densities at tentative collisions and decides what these are.
  HWY_INLINE void decide(Tracks& v) {
    const B here = v.located;
    const F d = grid_value(density, v.place);
    const B violates = both(here, d * grid.sigma_majorant > v.majorant * 1.00001f);
    if (any(violates)) counts.majorant_violations += static_cast<std::int64_t>(count_lanes(violates));
    v.optical_depth = select(here, -log_natural(1.0f - uniform_from_bits(v.next_distance)), v.optical_depth);
    const F u = uniform_from_bits(v.decision);
    B ends;
    if (is_ratio) {
      F largest = 0.0f;
      for (int c = 0; c < weight_count; ++c) {
        const F passed = max(1.0f - d * grid.sigma_t[c] / v.majorant, F(0.0f));
        v.weight[c] = select(here, v.weight[c] * passed, v.weight[c]);
        largest = max(largest, v.weight[c]);
      }
      const F survival = min(largest * (1 / roulette_below), F(1.0f));
      ends = both(here, u >= survival);
      for (int c = 0; c < weight_count; ++c)
        v.weight[c] = select(ends, F(0.0f), select(here, v.weight[c] / max(survival, F(1e-30f)), v.weight[c]));
    } else if (is_split) {
      ends = split(v, here, d * F(grid.sigma_majorant) / v.majorant, u);
    } else {
      const F real = d * (is_chromatic ? v.hero_sigma : F(grid.sigma_majorant));
      ends = both(here, u * v.majorant < real);
      const B null = both(here, negate(ends));
      for (int c = 0; c < weight_count; ++c) {
        const F ratio = max(v.majorant - d * grid.sigma_t[c], F(0.0f)) / max(v.majorant - real, F(1e-30f));
        v.weight[c] = select(null, v.weight[c] * ratio, v.weight[c]);
      }
      // Elsewhere t says that there was no collision.
      v.t_end = select(ends, F(-1.0f), v.t_end);
    }
    v.done = either(v.done, ends);
    v.stepping = either(v.stepping, both(here, negate(ends)));
    v.located = no_lanes();
  }

  // A tentative collision of which the share `real` is one: splits what is left of the path's weight. Of the parts that
  // collided one is kept, by a reservoir: in proportion to their weights. Where little is left, it is not split any
  // more: all of it collides or none. Returns the lanes that have nothing left.
  HWY_INLINE B split(Tracks& v, B here, F real, F u) {
    const F left = v.weight[0];
    const B is_whole = left < split_above;
    const F collided = select(is_whole, select(u < real, left, F(0.0f)), left * real);
    const F rest = left - collided;
    const F chance = select(is_whole, real * left, collided / max(1.0f - rest, F(1e-30f)));
    v.chosen = select(both(here, u < chance), v.t, v.chosen);
    v.weight[0] = select(here, rest, v.weight[0]);
    return both(here, rest <= 0.0f);
  }

  // Writes the results of the lanes that are done and starts new tasks in them, while there are any.
  HWY_INLINE void finish(Tracks& v) {
    HWY_ALIGN float result[HWY_MAX_BYTES / sizeof(float)];
    HWY_ALIGN float weight[3][HWY_MAX_BYTES / sizeof(float)];
    store_lanes(is_ratio ? v.weight[0] : is_split ? v.chosen : select(v.t_end < 0.0f, v.t, F(-1.0f)), result);
    if (is_split) store_lanes(v.weight[0], weight[0]);
    if (is_chromatic)
      for (int c = 0; c < 3; ++c) store_lanes(v.weight[c], weight[c]);
    const std::uint32_t first = next_task;
    std::uint32_t started = 0;
    for (std::uint32_t left = lane_bits(v.done); left != 0; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      const std::uint32_t task = v.task[lane];
      tasks.result[task] = result[lane];
      for (int c = 0; c < weight_count && !(is_ratio && !is_chromatic); ++c) tasks.weight[c][task] = weight[c][lane];
      if (next_task == task_count) continue;
      v.task[lane] = next_task++;
      started |= 1u << lane;
    }
    v.done = no_lanes();
    if (started != 0) start(v, started, first);
  }

  // Starts tasks `first` and those after it in `lanes`, in order. Reads columns up to a vector beyond the last task.
  HWY_INLINE void start(Tracks& v, std::uint32_t lanes, std::uint32_t first) {
    const B m = lanes_of_bits(lanes);
    const Spreading spreading = spreading_of(lanes);
    v.origin = select3(m, spread3(tasks.entry, first, spreading), v.origin);
    v.direction = select3(m, spread3(tasks.direction, first, spreading), v.direction);
    v.t = select(m, F(0.0f), v.t);
    v.t_end = select(m, spread(tasks.length + first, spreading), v.t_end);
    v.optical_depth = select(m, spread(tasks.optical_depth + first, spreading), v.optical_depth);
    v.key = select(m, spread(tasks.key + first, spreading), v.key);
    v.pixel = select(m, spread(tasks.pixel + first, spreading), v.pixel);
    v.sample = select(m, spread(tasks.sample + first, spreading), v.sample);
    v.counter = select(m, U(0u), v.counter);
    v.chosen = select(m, F(-1.0f), v.chosen);
    for (int c = 0; c < weight_count; ++c) v.weight[c] = select(m, F(1.0f), v.weight[c]);
    if (is_chromatic && tracking == Tracking::collision) {
      const I hero = as_int(spread(tasks.hero + first, spreading));
      const F sigma =
          select(hero == I(0), F(grid.sigma_t[0]), select(hero == I(1), F(grid.sigma_t[1]), F(grid.sigma_t[2])));
      v.hero_sigma = select(m, sigma, v.hero_sigma);
    }
    const MajorantWalk w = majorant_start(majorants, v.origin, v.direction);
    v.walk.t_next = select3(m, w.t_next, v.walk.t_next);
    v.walk.t_cell = select3(m, w.t_cell, v.walk.t_cell);
    v.walk.cell = select(m, w.cell, v.walk.cell);
    v.walk.step_x = select(m, w.step_x, v.walk.step_x);
    v.walk.step_y = select(m, w.step_y, v.walk.step_y);
    v.walk.step_z = select(m, w.step_z, v.walk.step_z);
    v.majorant = select(m, majorant_at(majorants, v.walk.cell) * grid.sigma_majorant, v.majorant);
    v.stepping = either(v.stepping, m);
  }

  // Lanes that never had a task stay at a harmless place, the first task's.
  void run() {
    const std::size_t lanes = static_cast<std::size_t>(lane_count());
    const std::size_t enough = (3 * lanes + 7) / 8;
    for (Tracks& v : vectors) {
      const std::uint32_t first = next_task;
      std::uint32_t started = 0;
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        v.task[lane] = next_task < task_count ? next_task : 0;
        if (next_task == task_count) continue;
        ++next_task;
        started |= 1u << lane;
      }
      v.stepping = v.waiting = v.located = v.done = no_lanes();
      start_all(v);
      start(v, started, first);
    }
    for (bool busy = true; busy;) {
      busy = false;
      // What one round locates the next decides about: the memory has that long to answer.
      for (Tracks& v : vectors)
        if (any(v.located)) decide(v);
      for (int round = 0; round < steps_a_round; ++round)
        for (Tracks& v : vectors) step(v);
      for (Tracks& v : vectors) {
        const std::size_t waiting = count_lanes(v.waiting);
        if (waiting >= enough || (waiting > 0 && !any(v.stepping))) locate(v);
      }
      for (Tracks& v : vectors) {
        const std::size_t done = count_lanes(v.done);
        if (done >= enough || (done > 0 && !any(v.stepping) && !any(v.waiting) && !any(v.located))) finish(v);
        busy = busy || any(v.stepping) || any(v.waiting) || any(v.located) || any(v.done);
      }
    }
  }

  // Gives every lane numbers to compute with.
  HWY_INLINE void start_all(Tracks& v) {
    v.origin = v.direction = vec3(0.0f, 0.0f, 0.0f);
    v.t = v.t_end = v.optical_depth = v.hero_sigma = v.chosen = 0.0f;
    v.majorant = 1.0f;
    v.key = v.pixel = v.sample = v.counter = U(0u);
    for (F& w : v.weight) w = 0.0f;
    v.walk = majorant_start(majorants, v.origin, v.direction);
  }
};

template <Tracking tracking, bool is_chromatic>
void run_stream(const TrackedGrid& g, const TrackColumns& tasks, std::uint32_t count, TrackCounts& counts) {
  const kernel::MajorantGrid& m = g.majorants;
  Stream<tracking, is_chromatic> stream{
      lanes_of(g.density), {m.cells, m.row, m.layer, m.cells_per_voxel}, g, tasks, count, counts, 0, {}};
  stream.run();
}

void collide_lanes(const TrackedGrid& grid, const TrackColumns& tasks, std::uint32_t count, TrackCounts& counts) {
  grid.chromatic ? run_stream<Tracking::collision, true>(grid, tasks, count, counts)
                 : run_stream<Tracking::collision, false>(grid, tasks, count, counts);
}
void split_lanes(const TrackedGrid& grid, const TrackColumns& tasks, std::uint32_t count, TrackCounts& counts) {
  run_stream<Tracking::split, false>(grid, tasks, count, counts);
}
void transmit_lanes(const TrackedGrid& grid, const TrackColumns& tasks, std::uint32_t count, TrackCounts& counts) {
  grid.chromatic ? run_stream<Tracking::transmittance, true>(grid, tasks, count, counts)
                 : run_stream<Tracking::transmittance, false>(grid, tasks, count, counts);
}

}  // namespace HWY_NAMESPACE
}  // namespace brume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brume {

HWY_EXPORT(collide_lanes);
HWY_EXPORT(split_lanes);
HWY_EXPORT(transmit_lanes);

TrackedGrid::TrackedGrid(const CompiledGrid& grid, const CompiledMedium& medium)
    : density(grid.view()),
      majorants(grid.majorant_view()),
      linear(medium.linear),
      sigma_t{medium.sigma_t[0], medium.sigma_t[1], medium.sigma_t[2]},
      sigma_majorant(max_value(medium.sigma_t)),
      chromatic(!(medium.sigma_t == constant_spectrum(medium.sigma_t[0]))),
      index_from_world{} {
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t i = 0; i < 4; ++i)
      index_from_world[row][i] = static_cast<float>(medium.index_from_world.m[row][i]);
}

void TrackTasks::make_room(std::uint32_t more) {
  const std::uint32_t needed = count + more + widest_vector;
  if (needed <= room_) return;
  room_ = std::max(needed, 2 * room_);
  for (auto& column : floats_) column.resize(room_);
  for (auto& column : words_) column.resize(room_);
  auto f = floats_.begin();
  for (auto* triple : {&columns.entry, &columns.direction, &columns.weight})
    for (float*& column : *triple) column = (f++)->data();
  for (auto* column : {&columns.length, &columns.optical_depth, &columns.t_begin, &columns.result})
    *column = (f++)->data();
  auto w = words_.begin();
  for (auto* column : {&columns.key, &columns.pixel, &columns.sample, &columns.hero, &columns.ray})
    *column = (w++)->data();
}

void TrackTasks::append(const TrackTasks& from, std::uint32_t i) {
  make_room(1);
  const TrackColumns &f = from.columns, &t = columns;
  const std::uint32_t at = count++;
  for (int axis = 0; axis < 3; ++axis) {
    t.entry[axis][at] = f.entry[axis][i];
    t.direction[axis][at] = f.direction[axis][i];
  }
  t.length[at] = f.length[i];
  t.t_begin[at] = f.t_begin[i];
  t.optical_depth[at] = f.optical_depth[i];
  t.key[at] = f.key[i];
  t.pixel[at] = f.pixel[i];
  t.sample[at] = f.sample[i];
  t.hero[at] = f.hero[i];
  t.ray[at] = f.ray[i];
}

void track_collisions(const TrackedGrid& grid, TrackTasks& tasks, TrackCounts& counts) {
  if (tasks.count > 0) HWY_DYNAMIC_DISPATCH(collide_lanes)(grid, tasks.columns, tasks.count, counts);
}
void track_split(const TrackedGrid& grid, TrackTasks& tasks, TrackCounts& counts) {
  if (tasks.count > 0) HWY_DYNAMIC_DISPATCH(split_lanes)(grid, tasks.columns, tasks.count, counts);
}
void track_transmittance(const TrackedGrid& grid, TrackTasks& tasks, TrackCounts& counts) {
  if (tasks.count > 0) HWY_DYNAMIC_DISPATCH(transmit_lanes)(grid, tasks.columns, tasks.count, counts);
}

}  // namespace brume
#endif

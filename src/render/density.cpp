#include "render/density.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/density.cpp"
#include <hwy/foreach_target.h>

#include "render/column_lanes-inl.h"

// What crosses from baseline code to code compiled for one instruction set: plain pointers, no containers.
#ifndef BRUME_STRETCH_ARRAYS
#define BRUME_STRETCH_ARRAYS
namespace brume {
struct StretchArrays {
  const float* entry[3];
  const float* direction[3];
  const float* length;
  const std::uint32_t* random_key;
  std::int32_t size, padded_size;  // padded to whole vectors
};
}  // namespace brume
#endif

HWY_BEFORE_NAMESPACE();
namespace brume {
namespace HWY_NAMESPACE {

struct Stretch {
  vec3 entry, direction;
  F length;
  U key;
};

HWY_INLINE F density_at(const BrickGrid& grid, bool linear, vec3 p_index) {
  return linear ? grid_linear(grid, p_index) : grid_nearest(grid, p_index);
}

// ceil(length / step), at least 1; steps so many that their number has no meaning any more are cut at 2^20.
HWY_INLINE F step_count(F length, F step) {
  const F n = floor(length / step);
  return min(max(select(n * step < length, n + 1.0f, n), 1.0f), 1048576.0f);
}

// The stretches `index`.
HWY_INLINE Stretch load_stretches(const StretchArrays& a, I index) {
  const auto key = U(hn::GatherIndex(uint_tag, a.random_key, index.v));
  return {gather3(a.entry, index), gather3(a.direction, index), gather(a.length, index), key};
}

// Which stretches are being marched.
struct Marchers {
  static constexpr std::int32_t none = -1;
  HWY_ALIGN std::int32_t stretch[HWY_MAX_BYTES / sizeof(std::int32_t)];  // the lane's, or none
  std::int32_t next = 0;

  Marchers() { std::fill(std::begin(stretch), std::end(stretch), none); }

  // Writes down what the lanes `waiting` have found and gives them the next stretches, while there are any.
  HWY_INLINE void take_next(const StretchArrays& a, std::uint32_t waiting, F found, float* integral) {
    HWY_ALIGN float value[HWY_MAX_BYTES / sizeof(float)];
    store_lanes(found, value);
    for (; waiting != 0; waiting &= waiting - 1) {
      const int lane = __builtin_ctz(waiting);
      if (stretch[lane] != none) integral[stretch[lane]] = value[lane];
      stretch[lane] = next < a.size ? next++ : none;
    }
  }
};

// How far a ray stays in the brick that begins at `lo`, as far as one axis goes.
HWY_INLINE F brick_exit(F origin, F direction, I lo) {
  const F wall = to_float(lo) + select(direction > F(0.0f), F(8.0f), F(0.0f));
  return select(direction == F(0.0f), F(1e30f), (wall - origin) / direction);
}

// Marches along the stretches, each lane along its own. Lanes that are done wait until a quarter of them are, and then
// go on to the next stretches together. A quarter of lanes in empty bricks, too, goes over them in one step.
void march_lanes(const BrickGrid& grid, const DensityQuadrature& q, const StretchArrays& a, float* integral) {
  Marchers marchers;
  const F shift = q.linear ? 0.5f : 0.0f;  // look-ups with linear interpolation are in bricks of dual cells
  Stretch s{};
  F count = 0.0f, step = 0.0f, i = 0.0f, sum = 0.0f;
  for (;;) {
    // The integral so far is sum * step; a lane is done after its last step or once it has enough.
    const B waiting = either(i >= count, sum * step > F(q.enough));
    const int waiting_count = static_cast<int>(count_lanes(waiting));
    if (waiting_count == lane_count() || (4 * waiting_count >= lane_count() && marchers.next < a.size)) {
      marchers.take_next(a, lane_bits(waiting), sum * step, integral);
      const I stretch = load_lanes(marchers.stretch);
      const B idle = stretch < I(0);
      if (!any(negate(idle))) return;
      s = load_stretches(a, max(stretch, I(0)));
      const F steps = step_count(s.length, F(q.step));
      step = s.length / steps;
      count = select(idle, F(0.0f), steps);
      i = select(waiting, F(0.0f), i);
      sum = select(waiting, F(0.0f), sum);
      continue;
    }
    const F u = q.placement_spread > 0 ? random_uniform(s.key, U(0u), U(0u), as_uint(to_int(i))) : F(0.0f);
    const F t = min(march_position(F(0.0f), step, to_int(i), F(q.placement_base), F(q.placement_spread), u), s.length);
    const vec3 p = s.entry + t * s.direction - vec3(shift, shift, shift);
    const I x = floor_to_int(p.x), y = floor_to_int(p.y), z = floor_to_int(p.z);
    const Brick brick = grid_brick(grid, x, y, z);
    const B empty = brick_is_empty(brick, q.linear);
    const F density = q.linear ? cell_linear(brick_cell(grid, brick, x, y, z), p.x - to_float(x), p.y - to_float(y),
                                             p.z - to_float(z))
                               : grid_voxel(grid, x, y, z);
    sum = sum + select(waiting, F(0.0f), density);
    i = i + 1.0f;
    if (4 * static_cast<int>(count_lanes(empty)) >= lane_count()) {
      const F exit = min(min(brick_exit(s.entry.x - shift, s.direction.x, x & -8),
                             brick_exit(s.entry.y - shift, s.direction.y, y & -8)),
                         brick_exit(s.entry.z - shift, s.direction.z, z & -8));
      // The first step whose point can lie beyond; not a number in a stretch without length.
      const F beyond = floor(exit / step - F(q.placement_base + q.placement_spread)) + 1.0f;
      i = select(both(empty, beyond > i), beyond, i);
    }
  }
}

HWY_INLINE void advance(B where, Dda& walk) {
  Dda next = walk;
  dda_step(next);
  walk.cell_x = select(where, next.cell_x, walk.cell_x);
  walk.cell_y = select(where, next.cell_y, walk.cell_y);
  walk.cell_z = select(where, next.cell_z, walk.cell_z);
  walk.t_next.x = select(where, next.t_next.x, walk.t_next.x);
  walk.t_next.y = select(where, next.t_next.y, walk.t_next.y);
  walk.t_next.z = select(where, next.t_next.z, walk.t_next.z);
}

HWY_INLINE F walk_cells(const BrickGrid& grid, const DensityQuadrature& q, const Stretch& s) {
  const F shift = q.linear ? 0.5f : 0.0f;
  const vec3 origin = s.entry - vec3(shift, shift, shift);
  Dda walk = dda_start(origin, s.direction);
  F t = 0.0f, sum = 0.0f;
  for (;;) {
    const B active = both(t < s.length, sum <= F(q.enough));
    if (!any(active)) break;
    const F t_exit = min(dda_cell_exit(walk), s.length);
    F mean;
    if (q.linear) {
      const Cell cell = grid_cell(grid, walk.cell_x, walk.cell_y, walk.cell_z);
      mean = cell_mean_linear(cell, walk.cell_x, walk.cell_y, walk.cell_z, origin, s.direction, t, t_exit);
    } else {
      mean = grid_voxel(grid, walk.cell_x, walk.cell_y, walk.cell_z);
    }
    sum = sum + select(active, mean * (t_exit - t), F(0.0f));
    t = select(active, t_exit, t);
    advance(both(active, t < s.length), walk);
  }
  return sum;
}

void integrate_lanes(const kernel::BrickGrid& host_grid, const DensityQuadrature& q, const StretchArrays& a,
                     float* integral) {
  const BrickGrid grid = lanes_of(host_grid);
  if (!q.dda) return march_lanes(grid, q, a, integral);
  for (std::int32_t i = 0; i < a.padded_size; i += lane_count())
    store_lanes(walk_cells(grid, q, load_stretches(a, I(i) + lane_index())), integral + i);
}

void sample_lanes(const kernel::BrickGrid& host_grid, bool linear, const float* entry, const float* direction,
                  float t_entry, const float* t, std::size_t count, float* density) {
  const BrickGrid grid = lanes_of(host_grid);
  const vec3 origin(entry[0], entry[1], entry[2]), d(direction[0], direction[1], direction[2]);
  const std::size_t lanes = static_cast<std::size_t>(lane_count()), whole = count / lanes * lanes;
  for (std::size_t i = 0; i < whole; i += lanes)
    store_lanes(density_at(grid, linear, origin + (load_lanes(t + i) - t_entry) * d), density + i);
  if (whole == count) return;
  HWY_ALIGN float rest[HWY_MAX_BYTES / sizeof(float)];
  for (std::size_t i = 0; i < lanes; ++i) rest[i] = t[whole + i < count ? whole + i : whole];
  store_lanes(density_at(grid, linear, origin + (load_lanes(rest) - t_entry) * d), rest);
  for (std::size_t i = whole; i < count; ++i) density[i] = rest[i - whole];
}

}  // namespace HWY_NAMESPACE
}  // namespace brume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brume {

HWY_EXPORT(integrate_lanes);
HWY_EXPORT(sample_lanes);

void sample_density(const kernel::BrickGrid& grid, bool linear, kernel::vec3 entry, kernel::vec3 direction,
                    float t_entry, std::span<const float> t, std::span<float> density) {
  const float o[3] = {entry.x, entry.y, entry.z}, d[3] = {direction.x, direction.y, direction.z};
  HWY_DYNAMIC_DISPATCH(sample_lanes)(grid, linear, o, d, t_entry, t.data(), t.size(), density.data());
}

void DensityStretches::clear() {
  for (auto* v : {&entry_x, &entry_y, &entry_z, &direction_x, &direction_y, &direction_z, &length}) v->clear();
  random_key.clear();
}

void DensityStretches::add(kernel::vec3 entry, kernel::vec3 direction, float length_world, std::uint32_t key) {
  entry_x.push_back(entry.x);
  entry_y.push_back(entry.y);
  entry_z.push_back(entry.z);
  direction_x.push_back(direction.x);
  direction_y.push_back(direction.y);
  direction_z.push_back(direction.z);
  length.push_back(length_world);
  random_key.push_back(key);
}

void integrate_density(const kernel::BrickGrid& grid, const DensityQuadrature& quadrature, DensityStretches& s,
                       std::vector<float>& integral) {
  constexpr std::size_t widest = 16;
  if (s.size() == 0) return;
  // Padding is stretches of no length, from a place that is within the grid.
  const auto size = static_cast<std::int32_t>(s.size());
  const kernel::vec3 inside(s.entry_x[0], s.entry_y[0], s.entry_z[0]);
  while (s.size() % widest != 0) s.add(inside, kernel::vec3(1, 0, 0), 0, 0);
  integral.resize(s.size());
  const StretchArrays arrays{{s.entry_x.data(), s.entry_y.data(), s.entry_z.data()},
                             {s.direction_x.data(), s.direction_y.data(), s.direction_z.data()},
                             s.length.data(),
                             s.random_key.data(),
                             size,
                             static_cast<std::int32_t>(s.size())};
  HWY_DYNAMIC_DISPATCH(integrate_lanes)(grid, quadrature, arrays, integral.data());
}

}  // namespace brume
#endif

#include "render/medium_tasks.h"

#include "render/random_keys.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/medium_tasks.cpp"
#include <hwy/foreach_target.h>

#include "render/column_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brume {
namespace HWY_NAMESPACE {

HWY_INLINE BoxSpan span_in(const RegionFrame& region, vec3 o, vec3 d, F t_begin, F t_end, vec3& direction) {
  const vec3 origin = rows_times(region.matrix, o);
  direction = vec3(row_times(region.matrix[0], d), row_times(region.matrix[1], d), row_times(region.matrix[2], d));
  if (region.is_ball) return ball_span(origin, direction, t_begin, t_end);
  return box_span(origin, direction, vec3(region.lo[0], region.lo[1], region.lo[2]),
                  vec3(region.hi[0], region.hi[1], region.hi[2]), t_begin, t_end);
}

// Adds the stretches of rays within a volume to the tasks that begin at `at`; returns how many.
std::uint32_t clip_lanes(const VolumeFrame& volume, const RayColumns& rays, std::uint32_t count,
                         const TrackColumns& out, std::uint32_t at) {
  const std::uint32_t first = at;
  for (std::uint32_t i = 0; i < count; i += static_cast<std::uint32_t>(lane_count())) {
    const I index = lane_index() + I(static_cast<std::int32_t>(i));
    const vec3 o = load3(rays.origin, i), d = load3(rays.direction, i);
    vec3 direction;
    const BoxSpan span = span_in(volume.region, o, d, F(0.0f), load_lanes(rays.t_max + i), direction);
    const B crosses = both(span.t_length > 0.0f, index < I(static_cast<std::int32_t>(count)));
    if (!any(crosses)) continue;
    const auto add = [&](B there, vec3 entry, F t_begin, F length, std::uint32_t ordinal) {
      if (!any(there)) return;
      const Packing packing = packing_of(there);
      const U key =
          hash_word((load_lanes(rays.key + i) ^ U(random_keys::stretch)) + U(ordinal * random_keys::stretch_step));
      const U pixel = load_lanes(rays.pixel + i), sample = load_lanes(rays.sample + i);
      const F u = ordinal == 0 ? load_lanes(rays.distance_u + i)
                               : random_uniform(key, pixel, sample, U(random_keys::first_distance));
      append3(entry, packing, out.entry, at);
      append3(direction, packing, out.direction, at);
      append(length, packing, out.length + at);
      append(t_begin, packing, out.t_begin + at);
      append(-log_natural(1.0f - u), packing, out.optical_depth + at);
      append(key, packing, out.key + at);
      append(pixel, packing, out.pixel + at);
      append(sample, packing, out.sample + at);
      append(load_lanes(rays.hero + i), packing, out.hero + at);
      append(as_uint(index), packing, out.ray + at);
      at += packing.count;
    };
    if (!volume.has_hole) {
      add(crosses, span.entry, span.t_enter, span.t_length, volume.ordinal);
      continue;
    }
    vec3 unused;
    const F t_exit = span.t_enter + span.t_length;
    const BoxSpan gap = span_in(volume.hole, o, d, span.t_enter, t_exit, unused);
    const B cut = gap.t_length > 0.0f;
    const F before = select(cut, gap.t_enter - span.t_enter, span.t_length);
    const F from = select(cut, gap.t_enter + gap.t_length, t_exit), after = t_exit - from;
    add(both(crosses, before > 0.0f), span.entry, span.t_enter, before, volume.ordinal);
    add(both(crosses, after > 0.0f), span.entry + (from - span.t_enter) * direction, from, after, volume.ordinal + 1);
  }
  return at - first;
}

}  // namespace HWY_NAMESPACE
}  // namespace brume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <algorithm>
#include <cmath>

namespace brume {

HWY_EXPORT(clip_lanes);

namespace {

RegionFrame make_frame(const CompiledRegion& region) {
  RegionFrame frame;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t i = 0; i < 4; ++i) frame.matrix[row][i] = static_cast<float>(region.local_from_world.m[row][i]);
    frame.lo[row] = region.lo[row];
    frame.hi[row] = region.hi[row];
  }
  frame.is_ball = region.kind == CompiledRegion::Kind::ball;
  return frame;
}

}  // namespace

MediumTasks::MediumTasks(const CompiledScene& scene, const Intersector& intersector, const MediaAlongRay& media)
    : scene_(scene), intersector_(intersector), media_(media), tasks_(scene.media.size()) {
  for (const CompiledMedium& medium : scene.media) {
    is_chromatic_ = is_chromatic_ || !(medium.sigma_t == constant_spectrum(medium.sigma_t[0]));
    grids_.emplace_back();
    if (medium.grid >= 0) grids_.back().emplace(scene.grids[static_cast<std::size_t>(medium.grid)], medium);
  }
  for (const CompiledVolume& volume : scene.volumes) {
    VolumeFrame frame{make_frame(volume.region), {}, volume.hole >= 0, volume.medium, ordinal_count_};
    if (frame.has_hole) frame.hole = make_frame(scene.holes[static_cast<std::size_t>(volume.hole)]);
    ordinal_count_ += frame.has_hole ? 2 : 1;
    volumes_.push_back(frame);
  }
}

void MediumTasks::find_stretches(const RayColumns& rays, std::uint32_t count) {
  for (TrackTasks& tasks : tasks_) tasks.count = 0;
  for (const VolumeFrame& volume : volumes_) {
    TrackTasks& tasks = tasks_[static_cast<std::size_t>(volume.medium)];
    tasks.make_room(volume.has_hole ? 2 * count : count);
    tasks.count += HWY_DYNAMIC_DISPATCH(clip_lanes)(volume, rays, count, tasks.columns, tasks.count);
  }
  if (intersector_.has_boundaries() || media_.has_surrounding_medium()) add_bounded_media(rays, count);
}

// The stretches in media with a boundary of shapes, and in the one around all.
void MediumTasks::add_bounded_media(const RayColumns& rays, std::uint32_t count) {
  rays_.clear();
  ray_of_span_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!(rays.t_max[i] > 0)) continue;
    rays_.push_back({{rays.origin[0][i], rays.origin[1][i], rays.origin[2][i]},
                     {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]},
                     rays.t_max[i]});
    ray_of_span_.push_back(i);
  }
  if (const auto place = media_.find_bounded(rays_, spans_, crossings_)) too_many_media_ = place;
  std::uint32_t ordinal = 0;
  for (std::size_t s = 0; s < spans_.size(); ++s) {
    const MediumSpan& span = spans_[s];
    ordinal = s > 0 && spans_[s - 1].ray == span.ray ? ordinal : ordinal_count_;
    const std::uint32_t ray = ray_of_span_[static_cast<std::size_t>(span.ray)];
    TrackTasks& tasks = tasks_[static_cast<std::size_t>(span.medium)];
    // A medium that is there twice collides twice as often.
    for (int i = 0; i < span.count; ++i, ++ordinal) {
      tasks.make_room(1);
      const TrackColumns& c = tasks.columns;
      const std::uint32_t at = tasks.count++;
      const float entry[3] = {span.entry_index.x, span.entry_index.y, span.entry_index.z};
      const float direction[3] = {span.direction_index.x, span.direction_index.y, span.direction_index.z};
      for (int axis = 0; axis < 3; ++axis) {
        c.entry[axis][at] = entry[axis];
        c.direction[axis][at] = direction[axis];
      }
      c.length[at] = span.t_end - span.t_begin;
      c.t_begin[at] = span.t_begin;
      c.key[at] = kernel::hash_word((rays.key[ray] ^ random_keys::stretch) + ordinal * random_keys::stretch_step);
      c.pixel[at] = rays.pixel[ray];
      c.sample[at] = rays.sample[ray];
      const float u = ordinal == 0
                          ? rays.distance_u[ray]
                          : kernel::random_uniform(c.key[at], c.pixel[at], c.sample[at], random_keys::first_distance);
      c.optical_depth[at] = -kernel::log_natural(1 - u);
      c.hero[at] = rays.hero[ray];
      c.ray[at] = ray;
    }
  }
}

// Shortens stretches to the nearest collision found so far.
void MediumTasks::cut_to_nearest(TrackTasks& tasks, const FlightColumns& flights) const {
  const TrackColumns& c = tasks.columns;
  for (std::uint32_t i = 0; i < tasks.count; ++i)
    c.length[i] = std::clamp(flights.t[c.ray[i]] - c.t_begin[i], 0.0f, c.length[i]);
}

// Splits the flights of paths that have not been scattered yet and cross nothing but this medium; their stretches are
// left with no length.
void MediumTasks::split_first_flights(std::size_t medium, const FlightColumns& flights) {
  TrackTasks& tasks = tasks_[medium];
  again_.count = 0;
  for (std::uint32_t i = 0; i < tasks.count; ++i) {
    const std::uint32_t ray = tasks.columns.ray[i];
    if (flights.depth[ray] != 0 || stretch_counts_[ray] != 1) continue;
    again_.append(tasks, i);
    tasks.columns.length[i] = 0;
  }
  track_split(*grids_[medium], again_, counts_);
  const TrackColumns& c = again_.columns;
  for (std::uint32_t i = 0; i < again_.count; ++i) {
    if (c.result[i] < 0) continue;
    flights.t[c.ray[i]] = c.t_begin[i] + c.result[i];
    flights.medium[c.ray[i]] = static_cast<std::int32_t>(medium);
    flights.passed[c.ray[i]] = c.weight[0][i];
  }
}

// The first collision of each stretch with its medium.
void MediumTasks::collide(std::size_t medium, TrackTasks& tasks) {
  if (grids_[medium]) return track_collisions(*grids_[medium], tasks, counts_);
  const Spectrum& sigma_t = scene_.media[medium].sigma_t;
  const TrackColumns& c = tasks.columns;
  for (std::uint32_t i = 0; i < tasks.count; ++i) {
    const auto hero = static_cast<int>(c.hero[i]);
    const float sigma = sigma_t[hero], t = c.optical_depth[i] / std::max(sigma, 1e-30f);
    const bool collides = t < c.length[i];
    c.result[i] = collides ? t : -1;
    if (!is_chromatic_) continue;
    const float flown = std::max(collides ? t : c.length[i], 0.0f);
    for (int k = 0; k < 3; ++k) c.weight[k][i] = kernel::exp_natural((sigma - sigma_t[k]) * flown);
  }
}

void MediumTasks::find_collisions(const RayColumns& rays, std::uint32_t count, const FlightColumns& flights) {
  std::copy_n(rays.t_max, count, flights.t);
  std::fill_n(flights.medium, count, no_medium);
  std::fill_n(flights.passed, count, 0.0f);
  stretch_counts_.assign(count, 0);
  for (const TrackTasks& tasks : tasks_)
    for (std::uint32_t i = 0; i < tasks.count; ++i)
      if (std::uint8_t& n = stretch_counts_[tasks.columns.ray[i]]; n < 2) ++n;
  bool is_first = true;
  for (std::size_t medium = 0; medium < tasks_.size(); ++medium) {
    TrackTasks& tasks = tasks_[medium];
    if (tasks.count == 0) continue;
    if (!is_first) cut_to_nearest(tasks, flights);
    is_first = false;
    if (grids_[medium] && !is_chromatic_) split_first_flights(medium, flights);
    collide(medium, tasks);
    const TrackColumns& c = tasks.columns;
    for (std::uint32_t i = 0; i < tasks.count; ++i) {
      const float t = c.t_begin[i] + c.result[i];
      const std::uint32_t ray = c.ray[i];
      if (c.result[i] < 0 || t >= flights.t[ray]) continue;
      flights.t[ray] = t;
      flights.medium[ray] = static_cast<std::int32_t>(medium);
    }
  }
  if (!is_chromatic_) return;
  for (float* weight : flights.weight) std::fill_n(weight, count, 1.0f);
  for (std::size_t medium = 0; medium < tasks_.size(); ++medium) weigh_flights(medium, flights);
}

// Multiplies the weights of flights by those of their stretches through a medium, up to where the flight ended. A
// stretch that was followed further is tracked again up to there: the same random numbers make the same flight.
void MediumTasks::weigh_flights(std::size_t medium, const FlightColumns& flights) {
  const TrackColumns& c = tasks_[medium].columns;
  again_.count = 0;
  for (std::uint32_t i = 0; i < tasks_[medium].count; ++i) {
    const float end = flights.t[c.ray[i]] - c.t_begin[i];
    if (!(end > 0)) continue;
    const float followed = c.result[i] < 0 ? c.length[i] : c.result[i];
    if (followed <= end) {
      const bool weighed = !grids_[medium] || grids_[medium]->chromatic;
      for (int k = 0; weighed && k < 3; ++k) flights.weight[k][c.ray[i]] *= c.weight[k][i];
      continue;
    }
    again_.append(tasks_[medium], i);
    again_.columns.length[again_.count - 1] = end;
  }
  if (again_.count == 0 || (grids_[medium] && !grids_[medium]->chromatic)) return;
  collide(medium, again_);
  const TrackColumns& a = again_.columns;
  for (std::uint32_t i = 0; i < again_.count; ++i)
    for (int k = 0; k < 3; ++k) flights.weight[k][a.ray[i]] *= a.weight[k][i];
}

void MediumTasks::find_transmittance(std::uint32_t count, float* const (&transmittance)[3]) {
  const int channels = is_chromatic_ ? 3 : 1;
  for (int k = 0; k < channels; ++k) std::fill_n(transmittance[k], count, 1.0f);
  for (std::size_t medium = 0; medium < tasks_.size(); ++medium) {
    TrackTasks& tasks = tasks_[medium];
    const TrackColumns& c = tasks.columns;
    if (!grids_[medium]) {
      const Spectrum& sigma_t = scene_.media[medium].sigma_t;
      for (std::uint32_t i = 0; i < tasks.count; ++i)
        for (int k = 0; k < channels; ++k) transmittance[k][c.ray[i]] *= kernel::beer_lambert(sigma_t[k] * c.length[i]);
      continue;
    }
    track_transmittance(*grids_[medium], tasks, counts_);
    for (std::uint32_t i = 0; i < tasks.count; ++i)
      for (int k = 0; k < channels; ++k)
        transmittance[k][c.ray[i]] *= grids_[medium]->chromatic ? c.weight[k][i] : c.result[i];
  }
}

}  // namespace brume
#endif

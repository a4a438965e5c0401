#include "render/emission_placement.h"

#include "render/random_keys.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/emission_placement.cpp"
#include <hwy/foreach_target.h>

#include "render/column_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brume {
namespace HWY_NAMESPACE {

struct StretchWalk {
  MajorantWalk walk;
  F t, optical_depth;
};

// The current cell: where the stretch leaves it and what a unit of its length is chosen with.
struct StretchCell {
  F exit, weight, majorant;
};

HWY_INLINE StretchCell cell_of(const MajorantGrid& majorants, const MajorantGrid& emission, F sigma,
                               const StretchWalk& s, F length) {
  StretchCell cell;
  cell.exit = max(min(majorant_cell_exit(s.walk), length), s.t);
  cell.majorant = majorant_at(majorants, s.walk.cell) * sigma;
  const F depth = s.optical_depth + 1.0f;
  cell.weight = majorant_at(emission, s.walk.cell) / (depth * depth);
  return cell;
}

// Goes on to the next cell where `moves`.
HWY_INLINE void advance(StretchWalk& s, const StretchCell& cell, B moves) {
  s.optical_depth = select(moves, fma(cell.majorant, cell.exit - s.t, s.optical_depth), s.optical_depth);
  s.t = select(moves, cell.exit, s.t);
  majorant_step(s.walk, moves);
}

struct ChosenPlace {
  F t, density;  // density: per unit of length; 0 where there is nothing to choose
  F majorant;    // of the extinction there
};

// A place on the stretch entry + t direction, t in [0, length], by its cells' weights.
HWY_INLINE ChosenPlace choose_place(const EmissionJob& job, vec3 entry, vec3 direction, F length, F u) {
  const MajorantGrid majorants = lanes_of(job.grid->majorants);
  MajorantGrid emission = majorants;
  emission.cells = job.cells;
  const F sigma = job.grid->sigma_majorant;
  const StretchWalk start{majorant_start(majorants, entry, direction), 0.0f, 0.0f};
  F total = 0.0f;
  StretchWalk s = start;
  for (B active = s.t < length; any(active); active = s.t < length) {
    const StretchCell cell = cell_of(majorants, emission, sigma, s, length);
    total = select(active, fma(cell.weight, cell.exit - s.t, total), total);
    advance(s, cell, both(active, cell.exit < length));
    s.t = select(active, cell.exit, s.t);
  }
  // Once more, to the cell in which the sum reaches u of the whole.
  F left = u * total;
  ChosenPlace place{0.0f, 0.0f, 0.0f};
  s = start;
  for (B active = total > 0.0f; any(active); active = both(active, s.t < length)) {
    const StretchCell cell = cell_of(majorants, emission, sigma, s, length);
    const F here = cell.weight * (cell.exit - s.t);
    const B reached = both(both(active, left <= here), here > 0.0f);
    place.t = select(reached, min(s.t + left / max(cell.weight, F(1e-30f)), cell.exit), place.t);
    place.density = select(reached, cell.weight / total, place.density);
    place.majorant = select(reached, cell.majorant, place.majorant);
    left = left - here;
    active = both(active, negate(reached));
    advance(s, cell, both(active, cell.exit < length));
    s.t = select(active, cell.exit, s.t);
  }
  return place;
}

void place_lanes(const EmissionJob& job, const PathColumns& paths, const TrackColumns& stretches, std::uint32_t first,
                 std::uint32_t last, const ShadowColumns& shadows, std::uint32_t& shadow_count) {
  const BrickGrid density = lanes_of(job.grid->density);
  const EmissionField field = lanes_of(job.field);
  std::uint32_t at = shadow_count;
  for (std::uint32_t i = first; i < last; i += static_cast<std::uint32_t>(lane_count())) {
    const B exists = lane_index() + I(static_cast<std::int32_t>(i)) < I(static_cast<std::int32_t>(last));
    const I path = select(exists, as_int(load_lanes(stretches.ray + i)), I(0));
    const U key = load_lanes(stretches.key + i), pixel = load_lanes(stretches.pixel + i),
            sample = load_lanes(stretches.sample + i);
    const RandomWords words = random_words(key, pixel, sample, U(random_keys::place_of_emission));
    const B is_first = as_int(load_u32(paths.depth, path)) == I(0);
    const F u = select(is_first, gather(paths.points[placement_point], path), uniform_from_bits(words.x));

    // Lanes beyond the last follow the first stretch.
    const I stretch =
        select(exists, lane_index() + I(static_cast<std::int32_t>(i)), I(static_cast<std::int32_t>(first)));
    const vec3 entry = gather3(stretches.entry, stretch), direction = gather3(stretches.direction, stretch);
    const ChosenPlace place = choose_place(job, entry, direction, gather(stretches.length, stretch), u);
    const B found = both(exists, place.density > 0.0f);
    if (!any(found)) continue;
    const vec3 p = entry + place.t * direction;
    const F d = job.grid->linear ? grid_linear(density, p) : grid_nearest(density, p);
    const vec3 factor = emission_factor(field, p);
    F mean_rescale = 1.0f;
    if (job.is_chromatic)
      mean_rescale =
          (gather(paths.rescale[0], path) + gather(paths.rescale[1], path) + gather(paths.rescale[2], path)) *
          F(1.0f / 3);
    const F weight =
        d * emission_along_flights(place.majorant, job.thin) / (max(place.density, F(1e-30f)) * mean_rescale);
    const F factors[3] = {factor.x, factor.y, factor.z};
    F carried[3], largest = 0.0f;
    for (int c = 0; c < 3; ++c) {
      carried[c] = gather(paths.throughput[c], path) * (weight * job.emission[c]) * factors[c];
      largest = max(largest, carried[c]);
    }
    const B sent = both(found, largest > 0.0f);
    if (!any(sent)) continue;
    const Packing packing = packing_of(sent);
    const F t = gather(stretches.t_begin, stretch) + place.t;
    const vec3 ray_direction = gather3(paths.ray.direction, path), origin = gather3(paths.ray.origin, path);
    append3(origin + t * ray_direction, packing, shadows.ray.origin, at);
    append3(ray_direction, packing, shadows.ray.direction, at);
    append(F(0.0f), packing, shadows.ray.t_max + at);
    append3(origin, packing, shadows.lead.origin, at);
    append3(ray_direction, packing, shadows.lead.direction, at);
    append(t, packing, shadows.lead.t_max + at);
    append3(vec3(carried[0], carried[1], carried[2]), packing, shadows.value, at);
    append(uniform_from_bits(words.y), packing, shadows.lead.distance_u + at);
    append(hash_word(key ^ U(random_keys::back_from_emission)), packing, shadows.lead.key + at);
    append(pixel, packing, shadows.lead.pixel + at);
    append(sample, packing, shadows.lead.sample + at);
    append(load_lanes(stretches.hero + i), packing, shadows.lead.hero + at);
    append(as_uint(path), packing, shadows.path + at);
    at += packing.count;
  }
  shadow_count = at;
}

}  // namespace HWY_NAMESPACE
}  // namespace brume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brume {

HWY_EXPORT(place_lanes);

void place_emission(const EmissionJob& job, const PathColumns& paths, const TrackColumns& stretches,
                    std::uint32_t first, std::uint32_t last, const ShadowColumns& shadows,
                    std::uint32_t& shadow_count) {
  HWY_DYNAMIC_DISPATCH(place_lanes)(job, paths, stretches, first, last, shadows, shadow_count);
}

}  // namespace brume
#endif

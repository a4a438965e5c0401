#include "render/light_placement.h"

#include "render/phase.h"
#include "render/random_keys.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/light_placement.cpp"
#include <hwy/foreach_target.h>

#include "render/column_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brume {
namespace HWY_NAMESPACE {

// The stretch of a flight within `near` of a light that is nearest at t = `nearest`, at the distance `distance`.
struct NearStretch {
  F begin, length;  // no length: there is none
};
HWY_INLINE NearStretch near_stretch(F length, F near_squared, F nearest, F distance) {
  const F half_chord = sqrt(max(near_squared - distance * distance, F(0.0f)));
  const F begin = min(max(nearest - half_chord, F(0.0f)), length);
  return {begin, min(max(nearest + half_chord, F(0.0f)), length) - begin};
}

// The part of a stretch that a light reaches whose cone is narrower than half of all directions; of others, the
// stretch. At t the flight is at w = from_light + t direction from the light, and within the cone where w.axis > cosine
// |w|: a quadratic in t, which also holds in the mirror image of the cone behind the light.
HWY_INLINE NearStretch lit_stretch(NearStretch whole, vec3 from_light, vec3 direction, vec3 axis, F cone_end) {
  const F cosine = cone_end - 1e-3f;  // a little wider, so that rounding cuts nothing off
  const F square = cosine * cosine, along = dot(direction, axis), height = dot(from_light, axis);
  const F a = along * along - square, b = along * height - square * dot(direction, from_light);
  const F c = height * height - square * dot(from_light, from_light), discriminant = b * b - a * c;
  const F root = sqrt(max(discriminant, F(0.0f)));
  const F sum = b + select(b < 0.0f, -root, root), q = -select(abs(sum) < F(1e-30f), F(1e-30f), sum);
  const F first = min(q / a, c / q), second = max(q / a, c / q);
  // Flatter than the cone, a flight crosses one of the two; steeper, it ends in the cone or comes out of it.
  const B is_flat = a < 0.0f;
  const F enter = select(is_flat, first, select(along < 0.0f, F(-1e30f), second));
  const F leave = select(is_flat, second, select(along < 0.0f, first, F(1e30f)));
  const B misses = both(is_flat, either(discriminant < 0.0f, fma(0.5f * (first + second), along, height) < 0.0f));
  const F begin = max(whole.begin, enter), end = min(whole.begin + whole.length, leave);
  const B is_narrow = cosine > 0.0f;
  return {select(is_narrow, begin, whole.begin), select(is_narrow, select(misses, F(0.0f), end - begin), whole.length)};
}

struct Place {
  F t, density;
};

// A place on a stretch of length `length` and extinction sigma, for u in [0, 1). The light is nearest at t = `nearest`,
// and `distance` away there.
HWY_INLINE Place draw_place(F u, F length, F sigma, F nearest, F distance) {
  const F thickness = sigma * length;
  // The thicker the medium, the more it is its transmittance that decides where light comes from.
  const F equiangular_share = max(F(1.0f) - thickness * 0.125f, F(0.25f));
  const B equiangular = u < equiangular_share;
  const F v = select(equiangular, u / equiangular_share,
                     (u - equiangular_share) / (1.0f - min(equiangular_share, F(0.999999f))));
  // The angle under which the light sees the stretch, and the place at a share v of it from the beginning: without the
  // differences of nearly equal angles of a far light.
  const F from_begin = fma(distance, distance, nearest * nearest);
  const F along = from_begin / length - nearest;
  const F angle = atan_turns(distance / along) + select(along < 0.0f, F(0.5f), F(0.0f));
  F sine, cosine;
  sincos_turns(v * angle, sine, cosine);
  const F by_angle = from_begin * sine / max(fma(distance, cosine, nearest * sine), 1e-7f * sqrt(from_begin));
  // Free flight that ends within the stretch.
  const F absorbed = max(F(1.0f) - exp_natural(-thickness), F(1e-7f));
  const F by_flight = -log_natural(max(F(1.0f) - v * absorbed, F(1e-7f))) / max(sigma, F(1e-20f));
  Place p;
  p.t = min(max(select(equiangular, by_angle, by_flight), F(0.0f)), length);
  const F offset = p.t - nearest;
  const F angle_density = distance / (angle * 6.2831853f * fma(offset, offset, distance * distance));
  const F flight_density = sigma * exp_natural(-sigma * p.t) / absorbed;
  p.density = equiangular_share * angle_density + (1.0f - equiangular_share) * flight_density;
  return p;
}

template <class Phase>
void place(const ScatterJob& job, const PathColumns& paths, const TrackColumns& stretches, std::uint32_t first,
           std::uint32_t last, const ShadowColumns& shadows, std::uint32_t& shadow_count) {
  const vec4 phase(job.phase_numbers[0], job.phase_numbers[1], job.phase_numbers[2], job.phase_numbers[3]);
  std::uint32_t at = shadow_count;
  for (std::uint32_t i = first; i < last; i += static_cast<std::uint32_t>(lane_count())) {
    const B exists = lane_index() + I(static_cast<std::int32_t>(i)) < I(static_cast<std::int32_t>(last));
    const I path = select(exists, as_int(load_lanes(stretches.ray + i)), I(0));
    const U depth = load_u32(paths.depth, path);
    const U key = load_lanes(stretches.key + i), pixel = load_lanes(stretches.pixel + i),
            sample = load_lanes(stretches.sample + i);
    const RandomWords words = random_words(key, pixel, sample, U(random_keys::place_of_light));
    const B is_first = as_int(depth) == I(0);
    const F u = select(is_first, gather(paths.points[placement_point], path), uniform_from_bits(words.x));
    const F pick = select(is_first, gather(paths.points[placement_point + 1], path), uniform_from_bits(words.y));

    const vec3 direction = gather3(paths.ray.direction, path);
    const vec3 origin = gather3(paths.ray.origin, path);
    const F t_begin = load_lanes(stretches.t_begin + i);
    const vec3 begin = origin + t_begin * direction;
    const F whole_length = select(exists, load_lanes(stretches.length + i), F(1.0f));
    F light[3] = {0.0f, 0.0f, 0.0f}, value[3] = {0.0f, 0.0f, 0.0f};
    vec3 axis(0.0f, 0.0f, 1.0f);
    F cone_end = -3.0f, cone_start = -2.0f;
    for (int k = 0; k < job.light_count; ++k) {
      const DeltaLight& l = job.lights[k];
      const B chosen = both(pick >= l.pick[0], pick < l.pick[1]);
      for (int c = 0; c < 3; ++c) {
        light[c] = select(chosen, F(l.place[c]), light[c]);
        value[c] = select(chosen, F(l.value[c] / (l.pick[1] - l.pick[0])), value[c]);
      }
      axis = select3(chosen, lanes_of(l.cone.axis), axis);
      cone_end = select(chosen, F(l.cone.end), cone_end);
      cone_start = select(chosen, F(l.cone.start), cone_start);
    }
    const vec3 to_light = vec3(light[0], light[1], light[2]) - begin;
    const F nearest = dot(to_light, direction);
    const vec3 apart = to_light - nearest * direction;
    // Not exactly ahead, where all places but one would have no density.
    const F distance = max(sqrt(dot(apart, apart)), fma(F(1e-6f), abs(nearest), F(1e-10f)));
    const NearStretch near = lit_stretch(near_stretch(whole_length, job.near_squared, nearest, distance), -to_light,
                                         direction, axis, cone_end);
    const B is_near = both(exists, near.length > 0.0f);
    if (!any(is_near)) continue;
    const F length = select(is_near, near.length, F(1.0f));
    F sigma = job.sigma_t[0];
    F mean_rescale = 1.0f;
    if (job.is_chromatic) {
      const I hero = as_int(load_lanes(stretches.hero + i));
      sigma = select(hero == I(1), F(job.sigma_t[1]), select(hero == I(2), F(job.sigma_t[2]), sigma));
      mean_rescale =
          (gather(paths.rescale[0], path) + gather(paths.rescale[1], path) + gather(paths.rescale[2], path)) *
          F(1.0f / 3);
    }
    // The transmittance of a grid on the way tells nothing about where in it light comes from.
    if (job.grid) sigma = 0.0f;
    const Place p = draw_place(u, length, sigma, nearest - near.begin, distance);
    const F t = near.begin + p.t;
    F density = 1.0f;
    if (job.grid) {
      const BrickGrid grid = lanes_of(job.grid->density);
      const vec3 p_index = load3(stretches.entry, i) + t * load3(stretches.direction, i);
      const vec3 inside = select3(is_near, p_index, vec3(0.0f, 0.0f, 0.0f));
      const RandomWords tap = random_words(key, pixel, sample, U(random_keys::density_at_place));
      density = grid_value(grid, job.grid->linear ? grid_stochastic_place(grid, inside, tap.x, tap.y)
                                                  : grid_nearest_place(grid, inside));
    }
    const vec3 from_place = to_light - t * direction;
    const F squared = max(dot(from_place, from_place), F(1e-20f)), r = sqrt(squared);
    const vec3 shadow_direction = from_place * (F(1.0f) / r);
    const F mu = min(max(dot(shadow_direction, direction), F(-1.0f)), F(1.0f));
    const F falloff = cone_falloff(-dot(shadow_direction, axis), cone_end, cone_start);
    const F weight = falloff * Phase::eval(mu, phase) / (squared * p.density * mean_rescale);
    F carried[3];
    F largest = 0.0f;
    for (int c = 0; c < 3; ++c) {
      carried[c] = gather(paths.throughput[c], path) * (density * job.sigma_s[c] * weight) * value[c];
      largest = max(largest, carried[c]);
    }
    const B sent = both(both(is_near, largest > 0.0f), to_float(as_int(depth)) < F(static_cast<float>(job.max_depth)));
    if (!any(sent)) continue;
    const Packing packing = packing_of(sent);
    const vec3 start = begin + t * direction;
    append3(start, packing, shadows.ray.origin, at);
    append3(shadow_direction, packing, shadows.ray.direction, at);
    append(r, packing, shadows.ray.t_max + at);
    append3(origin, packing, shadows.lead.origin, at);
    append3(direction, packing, shadows.lead.direction, at);
    append(t_begin + t, packing, shadows.lead.t_max + at);
    append3(vec3(carried[0], carried[1], carried[2]), packing, shadows.value, at);
    append(uniform_from_bits(words.z), packing, shadows.ray.distance_u + at);
    append(uniform_from_bits(words.w), packing, shadows.lead.distance_u + at);
    append(hash_word(key ^ U(random_keys::to_placed_light)), packing, shadows.ray.key + at);
    append(hash_word(key ^ U(random_keys::back_from_light)), packing, shadows.lead.key + at);
    for (const RayColumns* rays : {&shadows.ray, &shadows.lead}) {
      append(pixel, packing, rays->pixel + at);
      append(sample, packing, rays->sample + at);
      append(load_lanes(stretches.hero + i), packing, rays->hero + at);
    }
    append(as_uint(path), packing, shadows.path + at);
    at += packing.count;
  }
  shadow_count = at;
}

void place_lanes(const ScatterJob& job, const PathColumns& paths, const TrackColumns& stretches, std::uint32_t first,
                 std::uint32_t last, const ShadowColumns& shadows, std::uint32_t& shadow_count) {
  switch (job.phase) {
#define PHASE(name) \
  case kind_##name: \
    return place<name##_lanes>(job, paths, stretches, first, last, shadows, shadow_count);
#include "kernel/phase_list.inl"
#undef PHASE
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace brume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brume {

HWY_EXPORT(place_lanes);

void place_lights(const ScatterJob& job, const PathColumns& paths, const TrackColumns& stretches, std::uint32_t first,
                  std::uint32_t last, const ShadowColumns& shadows, std::uint32_t& shadow_count) {
  HWY_DYNAMIC_DISPATCH(place_lanes)(job, paths, stretches, first, last, shadows, shadow_count);
}

}  // namespace brume
#endif

#include "render/scatter.h"

#include "render/phase.h"
#include "render/random_keys.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/scatter.cpp"
#include <hwy/foreach_target.h>

#include "render/column_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brume {
namespace HWY_NAMESPACE {

// Shadow rays that would carry less than this, as a share of what isotropic scattering of the whole path would send,
// play roulette: most directions of a narrow phase function are not worth a ray.
constexpr float shadow_roulette_below = 0.5f;
constexpr float path_roulette_below = 0.05f;

// A new direction: by the phase function, or aimed at a light. `density` is that of the mixture, and `weight` the phase
// function over it.
struct NewDirection {
  vec3 direction;
  F density, weight;
};

// What AimFrom of aim.h does, for a phase function.
template <class Phase>
HWY_INLINE NewDirection new_direction(const ScatterJob& job, vec4 phase, vec3 p, vec3 direction, F u, F turns) {
  const auto eval = [&](vec3 towards) {
    return Phase::eval(min(max(dot(towards, direction), F(-1.0f)), F(1.0f)), phase);
  };
  if (job.aimed_light_count == 0) {
    const F mu = Phase::sample(u, phase);
    return {direction_at_cosine(direction, mu, turns), Phase::eval(mu, phase), 1.0f};
  }
  const auto direction_to = [&](int k, F& distance) {
    const vec3 to_light = lanes_of(job.aimed_lights[k].position) - p;
    distance = max(length(to_light), F(1e-20f));
    return to_light * (F(1.0f) / distance);
  };
  const auto strength_of = [&](int k) {
    F distance;
    const vec3 to_light = direction_to(k, distance);
    return aimed_strength(F(job.aimed_lights[k].strength), distance, eval(to_light));
  };
  F strength = 0.0f;
  for (int k = 0; k < job.aimed_light_count; ++k) strength = strength + strength_of(k);
  const F scale = F(Aim::most) / (strength + job.elsewhere), chance = scale * strength;
  const F by_phase = max(u - chance, F(0.0f)) / (1.0f - chance);
  NewDirection next;
  next.direction = direction_at_cosine(direction, Phase::sample(by_phase, phase), turns);
  F left = u;
  for (int k = 0; k < job.aimed_light_count; ++k) {
    F distance;
    const vec3 to_light = direction_to(k, distance);
    const F share = scale * strength_of(k);
    const B chosen = both(left >= 0.0f, left < share);
    next.direction = select3(chosen, aimed_direction(to_light, left / max(share, F(1e-30f)), turns), next.direction);
    left = left - share;
  }
  const F value = eval(next.direction);
  next.density = value * (1.0f - chance);
  for (int k = 0; k < job.aimed_light_count; ++k) {
    F distance;
    const vec3 to_light = direction_to(k, distance);
    next.density = fma(scale * strength_of(k), aimed_density(to_light, next.direction), next.density);
  }
  next.weight = value / next.density;
  return next;
}

// The numbers of an event: `light`, u and v of the direction, and one for roulette.
struct EventNumbers {
  F light, u, v, roulette, shadow_roulette;
};

HWY_INLINE EventNumbers event_numbers(const PathColumns& paths, std::uint32_t i, U depth) {
  const U key = load_lanes(paths.ray.key + i), pixel = load_lanes(paths.ray.pixel + i),
          sample = load_lanes(paths.ray.sample + i);
  const RandomWords a = random_words(key, pixel, sample, U(0u));
  EventNumbers n;
  n.light = uniform_from_bits(a.x);
  n.u = uniform_from_bits(a.y);
  n.v = uniform_from_bits(a.z);
  n.roulette = uniform_from_bits(a.w);
  n.shadow_roulette = random_uniform(key, pixel, sample, U(1u));
  for (int e = 0; e < sobol_events; ++e) {
    const B here = (as_int(depth) == I(e));
    if (!any(here)) continue;
    const int first = first_point_of_event[e];
    n.light = select(here, load_lanes(paths.points[first + 1] + i), n.light);
    n.u = select(here, load_lanes(paths.points[first + 2] + i), n.u);
    n.v = select(here, load_lanes(paths.points[first + 3] + i), n.v);
  }
  return n;
}

// What emission is multiplied by at collisions: all of it in homogeneous media, and of grids the share that is not
// gathered along flights.
HWY_INLINE vec3 emission_here(const ScatterJob& job, B here, vec3 p) {
  if (!job.grid) return vec3(1.0f, 1.0f, 1.0f);
  const vec3 p_index = select3(here, rows_times(job.grid->index_from_world, p), vec3(0.0f, 0.0f, 0.0f));
  const MajorantGrid majorants = lanes_of(job.grid->majorants);
  const MajorantWalk cell = majorant_start(majorants, p_index, vec3(1.0f, 0.0f, 0.0f));
  const F majorant = majorant_at(majorants, cell.cell) * job.grid->sigma_majorant;
  const F share = F(1.0f) - emission_along_flights(majorant, job.emission_thin);
  return share * emission_factor(lanes_of(job.emission_field), p_index);
}

template <class Phase>
std::uint32_t scatter(const ScatterJob& job, const PathColumns& paths, std::uint32_t count,
                      const ShadowColumns& shadows, std::uint32_t& shadow_count, LightRequest* requests) {
  const vec4 phase(job.phase_numbers[0], job.phase_numbers[1], job.phase_numbers[2], job.phase_numbers[3]);
  const F max_depth = static_cast<float>(job.max_depth), last_depth = static_cast<float>(job.last_depth);
  const std::uint32_t hashed_seed = random_keys::hash_seed(job.seed);
  const bool emits = job.emission[0] > 0 || job.emission[1] > 0 || job.emission[2] > 0;
  std::uint32_t request_count = 0;
  std::uint32_t at = shadow_count;
  for (std::uint32_t i = 0; i < count; i += static_cast<std::uint32_t>(lane_count())) {
    const I index = lane_index() + I(static_cast<std::int32_t>(i));
    const B here =
        both((load_lanes(paths.flight.medium + i) == I(job.medium)), index < I(static_cast<std::int32_t>(count)));
    if (!any(here)) continue;
    const U depth = load_lanes(paths.depth + i);
    const vec3 direction = load3(paths.ray.direction, i);
    const vec3 p = load3(paths.ray.origin, i) + load_lanes(paths.flight.t + i) * direction;

    // The weights: f sigma / sigma_hero, and what is emitted, which is seen at every collision.
    F f[3], r[3], mean_rescale = 1.0f;
    F hero_sigma = job.sigma_t[0];
    if (job.is_chromatic) {
      const I hero = as_int(load_lanes(paths.ray.hero + i));
      hero_sigma = select((hero == I(1)), F(job.sigma_t[1]), select((hero == I(2)), F(job.sigma_t[2]), hero_sigma));
      mean_rescale = 0.0f;
      for (int c = 0; c < 3; ++c) {
        r[c] = load_lanes(paths.rescale[c] + i) * (job.sigma_t[c] / hero_sigma);
        mean_rescale = fma(r[c], F(1.0f / 3), mean_rescale);
        put(r[c], here, paths.rescale[c] + i);
      }
    }
    const F scale = F(1.0f) / (hero_sigma * mean_rescale);
    F largest = 0.0f;
    const vec3 factor = emits ? emission_here(job, here, p) : vec3(0.0f, 0.0f, 0.0f);
    const F factors[3] = {factor.x, factor.y, factor.z};
    for (int c = 0; c < 3; ++c) {
      const F before = load_lanes(paths.throughput[c] + i);
      if (emits) {
        const F seen = load_lanes(paths.radiance[c] + i);
        put(fma(before * job.emission[c] * factors[c], scale, seen), here, paths.radiance[c] + i);
      }
      f[c] = before * (job.sigma_s[c] / hero_sigma);
      largest = max(largest, f[c]);
    }
    const F worth = largest / mean_rescale;  // of the path, as seen by the camera
    const B goes_on = both(both(here, to_float(as_int(depth)) < max_depth), worth > 0.0f);
    const EventNumbers n = event_numbers(paths, i, depth);

    // Light from a chosen light.
    for (int k = 0; k < job.light_count; ++k) {
      const DeltaLight& light = job.lights[k];
      const B chosen = both(goes_on, both(n.light >= light.pick[0], n.light < light.pick[1]));
      if (!any(chosen)) continue;
      vec3 to_light(light.place[0], light.place[1], light.place[2]);
      F distance = 1e30f, irradiance = 1 / (light.pick[1] - light.pick[0]);
      B gathered_here = chosen;
      if (light.is_point) {
        to_light = to_light - p;
        // A collision at the light itself would see infinity.
        const F squared = max(dot(to_light, to_light), F(1e-20f));
        distance = sqrt(squared);
        to_light = to_light * (F(1.0f) / distance);
        const F falloff = cone_falloff(-dot(to_light, lanes_of(light.cone.axis)), light.cone.end, light.cone.start);
        irradiance = falloff * irradiance / squared;
        gathered_here = both(both(chosen, squared >= job.near_squared), falloff > 0.0f);
      }
      const F mu = min(max(dot(to_light, direction), F(-1.0f)), F(1.0f));
      const F value = Phase::eval(mu, phase);
      const F survival = min(value * worth * (12.566371f / shadow_roulette_below), F(1.0f));
      const B sent = both(gathered_here, n.shadow_roulette < survival);
      if (!any(sent)) continue;
      const Packing packing = packing_of(sent);
      const F weight = value * irradiance / (max(survival, F(1e-30f)) * mean_rescale);
      append3(p, packing, shadows.ray.origin, at);
      append3(to_light, packing, shadows.ray.direction, at);
      append3(vec3(weight * f[0] * light.value[0], weight * f[1] * light.value[1], weight * f[2] * light.value[2]),
              packing, shadows.value, at);
      append(F(0.0f), packing, shadows.lead.t_max + at);
      append(distance, packing, shadows.ray.t_max + at);
      const U key = load_lanes(paths.ray.key + i);
      append(hash_word(key ^ U(random_keys::to_light)), packing, shadows.ray.key + at);
      append(load_lanes(paths.ray.pixel + i), packing, shadows.ray.pixel + at);
      append(load_lanes(paths.ray.sample + i), packing, shadows.ray.sample + at);
      append(load_lanes(paths.ray.hero + i), packing, shadows.ray.hero + at);
      append(random_uniform(key, load_lanes(paths.ray.pixel + i), load_lanes(paths.ray.sample + i), U(2u)), packing,
             shadows.ray.distance_u + at);
      append(as_uint(index), packing, shadows.path + at);
      at += packing.count;
    }
    const B requested = both(goes_on, both(n.light >= job.picks_of_delta_lights, n.light < job.pick_end));
    if (any(requested)) {
      HWY_ALIGN float columns[10][HWY_MAX_BYTES / sizeof(float)];
      const F values[10] = {n.light,
                            p.x,
                            p.y,
                            p.z,
                            direction.x,
                            direction.y,
                            direction.z,
                            f[0] / mean_rescale,
                            f[1] / mean_rescale,
                            f[2] / mean_rescale};
      for (int c = 0; c < 10; ++c) store_lanes(values[c], columns[c]);
      for (std::uint32_t left = lane_bits(requested); left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        LightRequest& request = requests[request_count++];
        request.path = i + static_cast<std::uint32_t>(lane);
        request.u = columns[0][lane];
        for (int axis = 0; axis < 3; ++axis) {
          request.position[axis] = columns[1 + axis][lane];
          request.direction[axis] = columns[4 + axis][lane];
          request.value[axis] = columns[7 + axis][lane];
        }
      }
    }

    // A new direction, or the end by roulette.
    const NewDirection next = new_direction<Phase>(job, phase, p, direction, n.u, n.v);
    const F survival = min(worth * next.weight * (1 / path_roulette_below), F(1.0f));
    const B survives = both(both(goes_on, to_float(as_int(depth)) < last_depth), n.roulette < survival);
    for (int c = 0; c < 3; ++c) put(f[c] * next.weight / survival, here, paths.throughput[c] + i);
    put3(p, here, paths.ray.origin, i);
    put3(next.direction, here, paths.ray.direction, i);
    put(next.density * F(job.density_scale), here, paths.direction_density + i);
    put(select(survives, F(1e30f), F(0.0f)), here, paths.ray.t_max + i);
    put(depth + U(1u), here, paths.depth + i);
    const U key = hash_word((depth + U(1u)) * U(random_keys::event_step) ^ U(hashed_seed));
    put(key, here, paths.ray.key + i);
    F distance_u = random_uniform(key, load_lanes(paths.ray.pixel + i), load_lanes(paths.ray.sample + i), U(3u));
    for (int e = 1; e < sobol_events; ++e)
      distance_u =
          select((as_int(depth) == I(e - 1)), load_lanes(paths.points[first_point_of_event[e]] + i), distance_u);
    put(distance_u, here, paths.ray.distance_u + i);
  }
  shadow_count = at;
  return request_count;
}

std::uint32_t scatter_lanes(const ScatterJob& job, const PathColumns& paths, std::uint32_t count,
                            const ShadowColumns& shadows, std::uint32_t& shadow_count, LightRequest* requests) {
  switch (job.phase) {
#define PHASE(name) \
  case kind_##name: \
    return scatter<name##_lanes>(job, paths, count, shadows, shadow_count, requests);
#include "kernel/phase_list.inl"
#undef PHASE
  }
  return 0;
}

}  // namespace HWY_NAMESPACE
}  // namespace brume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brume {

HWY_EXPORT(scatter_lanes);

std::uint32_t scatter_paths(const ScatterJob& job, const PathColumns& paths, std::uint32_t count,
                            const ShadowColumns& shadows, std::uint32_t& shadow_count, LightRequest* requests) {
  return HWY_DYNAMIC_DISPATCH(scatter_lanes)(job, paths, count, shadows, shadow_count, requests);
}

}  // namespace brume
#endif

// Which random numbers volpath's parts draw. A number is a hash of a key, the pixel, the sample and a counter
// (kernel/random.inl), so parts that are to be independent differ in the key or in the counter:
//
//   key                      counter                       what it decides
//   the scene's seed         points + pair                 places in the pixel and on the lens, and the first events
//   the scene's seed         surface_event(depth) + 0 ...  what a surface does with a path after `depth` events
//   the scene's seed         light_choice(depth) + 0 ...   the light that the event asks, and the place on it
//   event_key(seed, depth)   0 to 3                        what a collision does with a path
//   event_key(seed, depth)   surface_is_reached            whether a path ends at its collision or goes to the surface
//   a stretch's key          0 ...                         tentative collisions of a flight through one medium
//   a stretch's key          place_of_light ...            places along it that light or emission comes from
//   a stretch's key          first_distance                how far a flight goes there
//
// A stretch's key comes from its ray's, which is the event's for a path and a key derived from it for a shadow ray.
#pragma once

#include <cstdint>

#include "kernel/scalar.h"

namespace brume::random_keys {

// Counters of the seed.
constexpr std::uint32_t points = 0x40000000u;
constexpr std::uint32_t surface_event(std::uint32_t depth) { return 0x20000000u + depth * 256; }
constexpr std::uint32_t light_choice(std::uint32_t depth) { return surface_event(depth) + 128; }

// Keys of events, apart from the seed itself for every seed; 0 too, which hash_word maps to itself.
constexpr std::uint32_t event_step = 0x9e3779b9u;
inline std::uint32_t hash_seed(std::uint32_t seed) { return kernel::hash_word(seed ^ 0x85ebca6bu); }
inline std::uint32_t event_key(std::uint32_t seed, std::uint32_t depth) {
  return kernel::hash_word((depth * event_step) ^ hash_seed(seed));
}
// Counters of an event's key.
constexpr std::uint32_t surface_is_reached = 0x80000001u;

// A stretch has the key hash((the ray's ^ stretch) + ordinal stretch_step).
constexpr std::uint32_t stretch = 0x7f4a7c15u, stretch_step = 0x9e3779b9u;
// Counters of a stretch's key.
constexpr std::uint32_t place_of_light = 0xfffffff0u, density_at_place = 0xfffffff1u, place_of_emission = 0xfffffff2u,
                        first_distance = 0xffffffffu;

// Shadow rays have the key hash(another ^ one of these): from an event to a light; from a place of light to the light,
// and back to the flight's origin; from a place of emission.
constexpr std::uint32_t to_light = 0x5bd1e995u, to_placed_light = 0x2545f491u, back_from_light = 0x6c078965u,
                        back_from_emission = 0x3c6ef372u;
// Counter of the key of a shadow ray.
constexpr std::uint32_t shadow_distance = 0x80000000u;

}  // namespace brume::random_keys

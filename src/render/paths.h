// The state of volpath: paths in flight and shadow rays on their way to lights, as columns.
#pragma once

#include <cstdint>

#include "kernel/scalar.h"
#include "render/medium_tasks.h"
#include "render/ray_batch.h"

namespace brume {

// Sobol' numbers of a path after the two of its place in the pixel. The flight and the scattering of an event take, in
// this order: distance, light, and the two of the new direction.
constexpr int point_dimensions = 14;
constexpr int sobol_events = 3;
constexpr int first_point_of_event[sobol_events] = {0, 6, 10};
constexpr int placement_point = 4;  // two more for the first event: where along the flight light is gathered
// Of a whole sample: its place in the pixel, those of its path, and last, where the camera has one, its place on the
// lens, so that the others are the same with and without.
constexpr int lens_point = 2 + point_dimensions, sample_dimensions = lens_point + 2;

struct PathColumns {
  explicit PathColumns(ColumnMemory& memory);
  RayColumns ray;  // t_max = 0: the path has ended
  FlightColumns flight;
  // What radiance from ahead is worth in each channel, over the density of the path if the hero had been the only
  // channel...
  float* throughput[3] = {};
  // ...and that density for each channel as the hero, over the one of the hero that was: the balance heuristic over
  // heroes divides by the mean. Used only where extinction differs between channels.
  float* rescale[3] = {};
  // What the path has met by itself, and what shadow rays have brought: two sums, since shadow rays arrive whenever
  // there is no room for more of them, and the bits of a sum depend on its order.
  float* radiance[3] = {};
  float* gathered[3] = {};
  // The density of the ray's direction per unit of solid angle; negative where a light cannot have sampled it.
  float* direction_density = nullptr;
  std::uint32_t* depth = nullptr;   // how often it was scattered
  std::uint32_t* target = nullptr;  // which sample of the tile it is
  float* points[point_dimensions] = {};
};

// A shadow ray carries value[c] to the path `path` if nothing is in its way, nor in the way of its lead: the stretch of
// a flight that comes before it, where t_max is not 0.
struct ShadowColumns {
  explicit ShadowColumns(ColumnMemory& memory);
  RayColumns ray, lead;
  float* value[3] = {};
  std::uint32_t* path = nullptr;
};

inline kernel::vec3 at(float* const* columns, std::uint32_t i) { return {columns[0][i], columns[1][i], columns[2][i]}; }

inline void set(float* const* columns, std::uint32_t i, kernel::vec3 v) {
  columns[0][i] = v.x;
  columns[1][i] = v.y;
  columns[2][i] = v.z;
}

inline Spectrum spectrum_at(float* const* columns, std::uint32_t i) {
  return {{columns[0][i], columns[1][i], columns[2][i]}};
}

inline void set(float* const* columns, std::uint32_t i, const Spectrum& s) {
  for (int c = 0; c < 3; ++c) columns[c][i] = s[c];
}

inline void add(float* const* columns, std::uint32_t i, const Spectrum& s) {
  for (int c = 0; c < 3; ++c) columns[c][i] += s[c];
}

}  // namespace brume

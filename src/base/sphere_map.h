// Pictures of all directions: maps between the unit square and the unit sphere. The square's first coordinate runs to
// the right and its second down; +z is up.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/geometry.h"

namespace brume {

enum class SphereMap { equal_area, equirectangular };

struct SquarePoint {
  double u = 0, v = 0;  // in [0, 1]
};

// The octahedral map of equal areas: a quarter of the square about its centre, |u'| + |v'| < 1, is the upper
// hemisphere, the corners fold over the lower. Lines from the centre become meridians, rings parallels.
// Beyond the square's edges, by up to a quarter of it, neighbours stay neighbours and areas equal.
// Source: P. Clarberg, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD", JGT 13(3), 2008.
inline Vector3 equal_area_direction(SquarePoint p) {
  const double u = 2 * p.u - 1, v = 2 * p.v - 1, a = std::abs(u), b = std::abs(v);
  const double above = 1 - a - b, r = 1 - std::abs(above);
  const double phi = (r == 0 ? 1 : (b - a) / r + 1) * std::numbers::pi / 4;
  const double ring = r * std::sqrt(2 - r * r);
  return {std::copysign(std::cos(phi) * ring, u), std::copysign(std::sin(phi) * ring, v),
          std::copysign(1 - r * r, above)};
}

inline SquarePoint equal_area_point(Vector3 d) {
  const double x = std::abs(d.x), y = std::abs(d.y), r = std::sqrt(std::max(0.0, 1 - std::abs(d.z)));
  const double share = x == 0 && y == 0 ? 0 : std::atan2(y, x) * 2 / std::numbers::pi;  // of the quarter turn
  double v = share * r, u = r - v;
  if (d.z < 0) {
    const double folded = 1 - v;
    v = 1 - u;
    u = folded;
  }
  return {0.5 * (std::copysign(u, d.x) + 1), 0.5 * (std::copysign(v, d.y) + 1)};
}

// The map by longitude, counted from +x towards +y, and polar angle.
inline Vector3 equirectangular_direction(SquarePoint p) {
  const double phi = 2 * std::numbers::pi * p.u, theta = std::numbers::pi * p.v, ring = std::sin(theta);
  return {ring * std::cos(phi), ring * std::sin(phi), std::cos(theta)};
}

inline SquarePoint equirectangular_point(Vector3 d) {
  const double turns = std::atan2(d.y, d.x) / (2 * std::numbers::pi);
  return {turns < 0 ? turns + 1 : turns, std::acos(std::clamp(d.z, -1.0, 1.0)) / std::numbers::pi};
}

inline Vector3 map_direction(SphereMap map, SquarePoint p) {
  return map == SphereMap::equal_area ? equal_area_direction(p) : equirectangular_direction(p);
}

inline SquarePoint map_point(SphereMap map, Vector3 d) {
  return map == SphereMap::equal_area ? equal_area_point(d) : equirectangular_point(d);
}

}  // namespace brume

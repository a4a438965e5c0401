// How a place on a surface changes with the surface's parameters u and v.
#pragma once

#include <array>

#include "base/geometry.h"

namespace brume {

// dp/du and dp/dv; where they are not known, both 0.
struct Tangents {
  Vector3 u, v;
};

// By how the place and (u, v) change with two other parameters, a and b: dp/da = u_a dp/du + v_a dp/dv and the same for
// b, solved for dp/du and dp/dv.
inline Tangents tangents_from(const Tangents& by_ab, std::array<double, 2> uv_a, std::array<double, 2> uv_b) {
  const double determinant = uv_a[0] * uv_b[1] - uv_a[1] * uv_b[0];
  if (determinant == 0) return {};
  const double scale = 1 / determinant;
  return {scale * (uv_b[1] * by_ab.u - uv_a[1] * by_ab.v), scale * (uv_a[0] * by_ab.v - uv_b[0] * by_ab.u)};
}

}  // namespace brume

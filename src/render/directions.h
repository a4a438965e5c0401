// Directions from polar coordinates.
#pragma once

#include <algorithm>
#include <cmath>

#include "kernel/scalar.h"

namespace brume {

// The unit vector with cosine z to the z axis, `turns` (of 2 pi) around it.
inline kernel::vec3 direction_around_z(float z, float turns) {
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  float sine = 0, cosine = 0;
  kernel::sincos_turns(turns, sine, cosine);
  return {r * cosine, r * sine, z};
}

// From coordinates about the z axis to coordinates about the unit vector n.
// Source: T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
inline kernel::vec3 rotate_to(kernel::vec3 n, kernel::vec3 v) {
  const float sign = std::copysign(1.0f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  const kernel::vec3 x_axis(1 + sign * n.x * n.x * a, sign * b, -sign * n.x);
  const kernel::vec3 y_axis(b, sign + n.y * n.y * a, -n.y);
  return v.x * x_axis + v.y * y_axis + v.z * n;
}

}  // namespace brume

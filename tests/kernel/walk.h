// Walks through the integer lattice: by the kernel's DDA, and by an oracle in double that sorts all plane crossings.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "kernel/scalar.h"

namespace brume {

struct Visit {
  std::array<int, 3> cell{};
  double t_in = 0, t_out = 0;
  double chord() const { return t_out - t_in; }
};

// The cells that the kernel visits on [0, length] of a ray in lattice coordinates.
inline std::vector<Visit> kernel_walk(kernel::vec3 origin, kernel::vec3 direction, float length) {
  std::vector<Visit> visits;
  kernel::Dda walk = kernel::dda_start(origin, direction);
  for (float t = 0; t < length;) {
    const float leave = kernel::min(kernel::dda_cell_exit(walk), length);
    visits.push_back({{walk.cell_x, walk.cell_y, walk.cell_z}, t, leave});
    kernel::dda_step(walk);
    t = leave;
  }
  return visits;
}

// The same, without rounding to speak of.
inline std::vector<Visit> oracle_walk(const std::array<double, 3>& origin, const std::array<double, 3>& direction,
                                      double length) {
  std::vector<double> crossings{0, length};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = direction[axis];
    if (std::abs(d) < 1e-37) continue;
    const double begin = origin[axis], end = begin + d * length;
    for (double plane = std::ceil(std::min(begin, end)); plane <= std::max(begin, end); ++plane) {
      const double t = (plane - begin) / d;
      if (t > 0 && t < length) crossings.push_back(t);
    }
  }
  std::ranges::sort(crossings);
  std::vector<Visit> visits;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    Visit v{{}, crossings[i], crossings[i + 1]};
    if (v.chord() <= 0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      v.cell[axis] = static_cast<int>(std::floor(origin[axis] + direction[axis] * 0.5 * (v.t_in + v.t_out)));
    visits.push_back(v);
  }
  return visits;
}

struct TestRay {
  kernel::vec3 origin, direction;
};

inline std::array<double, 3> to_array(kernel::vec3 v) { return {v.x, v.y, v.z}; }

// Rays at the box [lo, hi]^3: from inside, from up to `distance` box edges away, along axes and diagonals, of any
// length.
inline TestRay make_ray(std::uint32_t index, float lo, float hi, float distance) {
  const auto uniform = [&](std::uint32_t dimension, float a, float b) {
    return a + (b - a) * kernel::random_uniform(41, 0, index, dimension);
  };
  const auto point = [&](std::uint32_t dimension, float a, float b) {
    return kernel::vec3(uniform(dimension, a, b), uniform(dimension + 1, a, b), uniform(dimension + 2, a, b));
  };
  const float away = distance * (hi - lo) * uniform(0, 0, 1);
  TestRay ray{point(1, lo - away, hi + away), {}};
  if (index % 7 == 0) ray.origin = point(1, lo, hi);
  if (index % 11 == 0) ray.origin = {std::round(ray.origin.x), std::round(ray.origin.y), std::round(ray.origin.z)};
  ray.direction = point(4, lo, hi) - ray.origin;
  if (index % 5 == 0) {  // some components 0, -0, denormal, tiny, or equal
    const std::array<float, 7> special{0.0f, -0.0f, 1e-40f, 1e-30f, -1e-5f, 1.0f, -1.0f};
    float* components[] = {&ray.direction.x, &ray.direction.y, &ray.direction.z};
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      if (uniform(7 + axis, 0, 1) < 0.6f)
        *components[axis] = special[static_cast<std::size_t>(uniform(10 + axis, 0, 7))];
  }
  ray.direction = ray.direction * std::exp2(uniform(13, -8, 8));
  return ray;
}

}  // namespace brume

// Ray and box against a slow oracle in long double, over random and constructed rays: an end of the interval is within
// the rounding that box.inl states, and so is every hit or miss; nothing is NaN. The fault this catches: slabs without
// a case for parallel rays, where 0 times infinity appears for an origin on the slab's plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kernel/scalar.h"
#include "sanitized.h"

namespace brume {
namespace {

using kernel::vec3;

constexpr int rays = sanitized ? 200000 : 10000000;

struct Ray {
  std::array<float, 3> origin, direction, lo, hi;
  float t_enter = 0, t_exit = 0;
};

struct Clipped {
  bool hit = false;
  float t_enter = 0, t_exit = 0;
};

float uniform(int ray, std::uint32_t dimension, float lo, float hi) {
  return lo + (hi - lo) * kernel::random_uniform(31, 0, static_cast<std::uint32_t>(ray), dimension);
}
std::size_t pick(int ray, std::uint32_t dimension, std::size_t choices) {
  return static_cast<std::size_t>(uniform(ray, dimension, 0, static_cast<float>(choices)));
}

// On the faces, edges and corners, next to them, inside, near and far.
float make_origin(int ray, std::uint32_t dimension, float lo, float hi) {
  const std::array choices{lo,
                           hi,
                           0.5f * (lo + hi),
                           std::nextafter(lo, -1e30f),
                           std::nextafter(lo, 1e30f),
                           std::nextafter(hi, -1e30f),
                           std::nextafter(hi, 1e30f),
                           0.0f,
                           -0.0f,
                           1e-40f,
                           uniform(ray, dimension, lo, hi),
                           uniform(ray, dimension, -3, 3),
                           uniform(ray, dimension, -1e4f, 1e4f),
                           uniform(ray, dimension, -1e12f, 1e12f)};
  return choices[pick(ray, dimension + 1, choices.size())];
}

float make_direction(int ray, std::uint32_t dimension) {
  const float sign = uniform(ray, dimension, -1, 1) < 0 ? -1.0f : 1.0f;
  const std::array choices{0.0f,
                           -0.0f,
                           1e-45f,
                           -1e-40f,
                           0.9e-37f,
                           1.1e-37f,
                           1e-20f,
                           1.0f,
                           -1.0f,
                           1e10f,
                           1e37f,
                           0.5f,
                           uniform(ray, dimension + 1, -1, 1),
                           std::exp2(uniform(ray, dimension + 1, -60, 30))};
  return sign * choices[pick(ray, dimension + 2, choices.size())];
}

Ray make_ray(int index) {
  Ray r;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const std::array los{0.0f, -1.0f, 1000.0f, uniform(index, axis, -5, 5)};
    const std::array sizes{1.0f, 64.0f, 1e-3f, uniform(index, axis + 3, 0, 5)};
    r.lo[axis] = los[pick(index, axis + 6, los.size())];
    r.hi[axis] = r.lo[axis] + sizes[pick(index, axis + 9, sizes.size())];
    r.origin[axis] = make_origin(index, 20 + 4 * axis, r.lo[axis], r.hi[axis]);
    r.direction[axis] = make_direction(index, 40 + 4 * axis);
  }
  if (index % 2 == 0) {  // aimed at the box, so that half of the rays hit
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      if (index % 4 == 0 || pick(index, 63 + axis, 2) == 0)
        r.direction[axis] = uniform(index, 60 + axis, r.lo[axis], r.hi[axis]) - r.origin[axis];
  }
  const std::array begins{0.0f, -1e30f, uniform(index, 70, 0, 2)};
  const std::array ends{1e30f, 1e30f, 1.0f, uniform(index, 71, 0, 1e4f)};
  r.t_enter = begins[pick(index, 72, begins.size())];
  r.t_exit = ends[pick(index, 73, ends.size())];
  return r;
}

vec3 to_vec3(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

Clipped kernel_clip(const Ray& r) {
  Clipped c{false, r.t_enter, r.t_exit};
  c.hit = kernel::box_clip(to_vec3(r.origin), to_vec3(r.direction), to_vec3(r.lo), to_vec3(r.hi), c.t_enter, c.t_exit);
  return c;
}

// Without the parallel case: the twin.
Clipped naive_clip(const Ray& r) {
  Clipped c{false, r.t_enter, r.t_exit};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float inverse = 1 / r.direction[axis];
    const float a = (r.lo[axis] - r.origin[axis]) * inverse, b = (r.hi[axis] - r.origin[axis]) * inverse;
    c.t_enter = kernel::max(c.t_enter, kernel::min(a, b));
    c.t_exit = kernel::min(c.t_exit, kernel::max(a, b));
  }
  c.hit = c.t_enter <= c.t_exit;
  return c;
}

struct Range {
  long double lo, hi;
};

// A t and what rounding may make of it: three roundings, of half an ulp each, and of the smallest denormal.
Range rounded(long double t) {
  const long double error = std::abs(t) * 3.01L * 0x1p-24L + 4e-45L;
  return {t - error, t + error > 3.4e38L ? INFINITY : t + error};
}

// Whether a result is one that rounding as stated could give.
bool is_right(const Ray& r, const Clipped& c) {
  if (std::isnan(c.t_enter) || std::isnan(c.t_exit)) return false;
  Range enter{r.t_enter, r.t_enter}, leave{r.t_exit, r.t_exit};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(r.direction[axis]) < 1e-37f) {
      if (r.origin[axis] < r.lo[axis] || r.origin[axis] > r.hi[axis]) return !c.hit;
      continue;
    }
    const long double a = (static_cast<long double>(r.lo[axis]) - r.origin[axis]) / r.direction[axis];
    const long double b = (static_cast<long double>(r.hi[axis]) - r.origin[axis]) / r.direction[axis];
    const Range near = rounded(std::min(a, b)), far = rounded(std::max(a, b));
    enter = {std::max(enter.lo, near.lo), std::max(enter.hi, near.hi)};
    leave = {std::min(leave.lo, far.lo), std::min(leave.hi, far.hi)};
  }
  if (!c.hit) return enter.hi > leave.lo;
  return enter.lo <= leave.hi && enter.lo <= c.t_enter && c.t_enter <= enter.hi && leave.lo <= c.t_exit &&
         c.t_exit <= leave.hi;
}

TEST(BoxClip, IsRightWithinTheStatedRounding) {
  int wrong = 0, hits = 0;
  for (int i = 0; i < rays; ++i) {
    const Ray r = make_ray(i);
    const Clipped c = kernel_clip(r);
    hits += c.hit;
    if (!is_right(r, c) && wrong++ < 5)
      ADD_FAILURE() << "ray " << i << " from " << r.origin[0] << " " << r.origin[1] << " " << r.origin[2] << " along "
                    << r.direction[0] << " " << r.direction[1] << " " << r.direction[2] << ": hit " << c.hit << ", "
                    << c.t_enter << " to " << c.t_exit;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(hits, rays / 10);
  EXPECT_LT(hits, rays / 10 * 9);
}

TEST(BoxClipTwin, SlabsWithoutTheParallelCaseAreRejected) {
  int wrong = 0;
  for (int i = 0; i < rays / 10; ++i) {
    const Ray r = make_ray(i);
    wrong += !is_right(r, naive_clip(r));
  }
  EXPECT_GT(wrong, rays / 1000);
}

TEST(BoxClip, OriginOnAPlaneAndParallelToIt) {
  const vec3 lo(0, 0, 0), hi(1, 1, 1);
  for (const float zero : {0.0f, -0.0f, 1e-40f, -1e-40f})
    for (const float y : {0.0f, 1.0f}) {
      float t_enter = 0, t_exit = 1e30f;
      EXPECT_TRUE(kernel::box_clip(vec3(-1, y, 0.5f), vec3(1, zero, zero), lo, hi, t_enter, t_exit));
      EXPECT_EQ(t_enter, 1.0f);
      EXPECT_EQ(t_exit, 2.0f);
    }
  float t_enter = 0, t_exit = 1e30f;
  EXPECT_FALSE(kernel::box_clip(vec3(-1, 1.0000001f, 0.5f), vec3(1, 0, 0), lo, hi, t_enter, t_exit));
}

// Look-ups along a span trust that it is in the box.
TEST(BoxSpan, RaysThatAreNotOfFiniteNumbersMiss) {
  const vec3 lo(-1, -1, -1), hi(1, 1, 1);
  EXPECT_GT(kernel::box_span({0, 0, -3}, {0, 0, 1}, lo, hi, 0, 1e30f).t_length, 0);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    EXPECT_EQ(kernel::box_span({bad, 0, -3}, {0, 0, 1}, lo, hi, 0, 1e30f).t_length, 0);
    EXPECT_EQ(kernel::box_span({0, 0, -3}, {0, bad, 1}, lo, hi, 0, 1e30f).t_length, 0);
    EXPECT_EQ(kernel::box_span({bad, bad, bad}, {bad, bad, bad}, lo, hi, 0, 1e30f).t_length, 0);
  }
}

}  // namespace
}  // namespace brume

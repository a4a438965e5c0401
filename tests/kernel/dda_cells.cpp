// The DDA's cells against an oracle in double, on the voxel lattice and on the one shifted by half a voxel: every cell
// with a chord above 1e-6 of the walk's length is visited once and in order, with the chord it has; the chords sum to
// the box's chord within 1e-5 (|entry distance| + chord), from origins up to a thousand boxes away. The faults this
// catches: t accumulated step by step from a distant origin; a walk that ends where its cell is outside the box, which
// the rounded entry's may be.
#include <gtest/gtest.h>

#include <string>

#include "kernel/walk.h"
#include "sanitized.h"

namespace brume {
namespace {

constexpr float edge = 24;

constexpr std::uint32_t rays = sanitized ? 20000 : 1000000;

// How many visits of `a` with a chord above epsilon are not, in order and with that chord, among the visits of `b`.
int missing(const std::vector<Visit>& a, const std::vector<Visit>& b, double epsilon) {
  int count = 0;
  std::size_t at = 0;
  for (const Visit& v : a) {
    if (v.chord() <= epsilon) continue;
    std::size_t found = at;
    while (found < b.size() && b[found].cell != v.cell) ++found;
    if (found == b.size() || std::abs(b[found].chord() - v.chord()) > epsilon)
      ++count;
    else
      at = found + 1;
  }
  return count;
}

bool any_cell_twice(const std::vector<Visit>& visits) {
  std::vector<std::array<int, 3>> cells;
  for (const Visit& v : visits) cells.push_back(v.cell);
  std::ranges::sort(cells);
  return std::ranges::adjacent_find(cells) != cells.end();
}

double chord_sum(const std::vector<Visit>& visits) {
  double sum = 0;
  for (const Visit& v : visits) sum += v.chord();
  return sum;
}

// The t at which a ray enters the box [lo, hi]^3 and how long it stays, in long double; a length of 0 where it misses.
struct Chord {
  double t_enter = 0, length = 0;
};
Chord exact_chord(const TestRay& ray, float lo, float hi) {
  long double enter = 0, leave = 1e30L;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const long double o = to_array(ray.origin)[axis], d = to_array(ray.direction)[axis];
    if (std::abs(d) < 1e-37L) {
      if (o < lo || o > hi) return {};
      continue;
    }
    enter = std::max(enter, std::min((lo - o) / d, (hi - o) / d));
    leave = std::min(leave, std::max((lo - o) / d, (hi - o) / d));
  }
  if (leave <= enter) return {static_cast<double>(enter), 0};
  return {static_cast<double>(enter), static_cast<double>(leave - enter)};
}

kernel::BoxSpan span_in(const TestRay& ray, float lo, float hi) {
  return kernel::box_span(ray.origin, ray.direction, {lo, lo, lo}, {hi, hi, hi}, 0.0f, 1e30f);
}

void expect_once_in_order(std::uint32_t count, float shift) {
  const float lo = -shift, hi = edge + shift;
  int walked = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const TestRay ray = make_ray(i, lo, hi, i % 3 == 0 ? 1000.0f : 2.0f);
    const kernel::BoxSpan span = span_in(ray, lo, hi);
    if (span.t_length <= 0) continue;
    ++walked;
    const kernel::vec3 origin = span.entry - kernel::vec3(shift, shift, shift);
    const std::vector<Visit> visits = kernel_walk(origin, ray.direction, span.t_length);
    const std::vector<Visit> truth = oracle_walk(to_array(origin), to_array(ray.direction), span.t_length);
    const double epsilon = 1e-6 * span.t_length;
    ASSERT_EQ(missing(truth, visits, epsilon), 0) << "ray " << i;
    ASSERT_EQ(missing(visits, truth, epsilon), 0) << "ray " << i;
    ASSERT_FALSE(any_cell_twice(visits)) << "ray " << i;
  }
  EXPECT_GT(walked, static_cast<int>(count) / 2);
}

// How many rays' chords, of cells that `walk` finds from the entry to the exit, do not sum to the box's.
template <class Walk>
int wrong_sums(std::uint32_t count, float shift, Walk walk) {
  const float lo = -shift, hi = edge + shift;
  int wrong = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const TestRay ray = make_ray(i, lo, hi, i % 3 == 0 ? 1000.0f : 2.0f);
    const Chord exact = exact_chord(ray, lo, hi);
    const kernel::BoxSpan span = span_in(ray, lo, hi);
    const kernel::vec3 origin = span.entry - kernel::vec3(shift, shift, shift);
    const double error = std::abs(chord_sum(walk(origin, ray.direction, span.t_length)) - exact.length);
    wrong += !(error <= 1e-5 * (std::abs(exact.t_enter) + exact.length));
  }
  return wrong;
}

class DdaCells : public testing::TestWithParam<float> {};  // the shift of the lattice

TEST_P(DdaCells, OnceInOrderAndWithTheirChords) { expect_once_in_order(rays, GetParam()); }

TEST_P(DdaCells, ChordsSumToTheBoxs) { EXPECT_EQ(wrong_sums(rays, GetParam(), kernel_walk), 0); }

// However distant the origin, a walk stays within a voxel of the box: look-ups need no bounds test.
TEST_P(DdaCells, StayWithinAVoxelOfTheBox) {
  const float shift = GetParam(), lo = -shift, hi = edge + shift;
  for (std::uint32_t i = 0; i < rays; ++i) {
    const TestRay ray = make_ray(i, lo, hi, i % 2 == 0 ? 1e3f : 1e9f);
    const kernel::BoxSpan span = span_in(ray, lo, hi);
    const kernel::vec3 origin = span.entry - kernel::vec3(shift, shift, shift);
    for (const Visit& v : kernel_walk(origin, ray.direction, span.t_length))
      for (const int c : v.cell)
        ASSERT_TRUE(c >= -2 && c <= static_cast<int>(edge) + 1) << "ray " << i << " cell " << c;
  }
}

std::string lattice_name(const testing::TestParamInfo<float>& shift) {
  return shift.param == 0 ? "Voxels" : "HalfShifted";
}
INSTANTIATE_TEST_SUITE_P(Lattices, DdaCells, testing::Values(0.0f, 0.5f), lattice_name);

// The walk as textbooks have it: t from the ray's own origin, advanced by 1 / |direction| at each plane.
std::vector<Visit> accumulating_walk(const TestRay& ray, const kernel::BoxSpan& span) {
  std::vector<Visit> visits;
  kernel::Dda walk = kernel::dda_start(span.entry, ray.direction);
  walk.origin = ray.origin;
  float next[] = {kernel::dda_plane(ray.origin.x, walk.inverse.x, walk.cell_x, walk.step_x),
                  kernel::dda_plane(ray.origin.y, walk.inverse.y, walk.cell_y, walk.step_y),
                  kernel::dda_plane(ray.origin.z, walk.inverse.z, walk.cell_z, walk.step_z)};
  const float delta[] = {std::abs(walk.inverse.x), std::abs(walk.inverse.y), std::abs(walk.inverse.z)};
  std::array cell{walk.cell_x, walk.cell_y, walk.cell_z};
  const std::array step{walk.step_x, walk.step_y, walk.step_z};
  const float end = span.t_enter + span.t_length;
  for (float t = span.t_enter; t < end && visits.size() < 200;) {
    const auto axis = static_cast<std::size_t>(std::min_element(next, next + 3) - next);
    const float leave = kernel::min(next[axis], end);
    visits.push_back({cell, t - span.t_enter, leave - span.t_enter});
    cell[axis] += step[axis];
    next[axis] += delta[axis];
    t = leave;
  }
  return visits;
}

// A walk that takes a cell outside the box for the box's end.
std::vector<Visit> walk_within_bounds(kernel::vec3 origin, kernel::vec3 direction, float length) {
  std::vector<Visit> visits = kernel_walk(origin, direction, length);
  const auto is_outside = [](const Visit& v) {
    return std::ranges::any_of(v.cell, [](int c) { return c < 0 || c >= static_cast<int>(edge); });
  };
  visits.erase(std::ranges::find_if(visits, is_outside), visits.end());
  return visits;
}

TEST(DdaCellsTwin, EndingAtACellOutsideIsRejected) {
  EXPECT_GT(wrong_sums(rays / 10, 0, walk_within_bounds), static_cast<int>(rays) / 1000);
}

TEST(DdaCellsTwin, AccumulatedTFromADistantOriginIsRejected) {
  int wrong = 0, walked = 0;
  for (std::uint32_t i = 0; i < rays / 10; ++i) {
    const TestRay ray = make_ray(i, 0, edge, 1000);
    const kernel::BoxSpan span = span_in(ray, 0, edge);
    if (span.t_length <= 0) continue;
    ++walked;
    const std::vector<Visit> truth = oracle_walk(to_array(span.entry), to_array(ray.direction), span.t_length);
    wrong += missing(truth, accumulating_walk(ray, span), 1e-6 * span.t_length) > 0;
  }
  EXPECT_GT(wrong, walked / 2);
}

}  // namespace
}  // namespace brume

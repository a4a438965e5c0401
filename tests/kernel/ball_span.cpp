// Ray and ball against an oracle in long double, over random and constructed rays: the ends of the span lie on the ball
// as it may have moved by the rounding that ball.inl states. The fault this catches: the roots by the textbook formula,
// which loses the span of a distant origin.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "kernel/scalar.h"

namespace brume {
namespace {

using kernel::vec3;

constexpr int rays = 1000000;

float uniform(int ray, std::uint32_t dimension, float lo, float hi) {
  return lo + (hi - lo) * kernel::random_uniform(32, 0, static_cast<std::uint32_t>(ray), dimension);
}

struct Ray {
  vec3 origin, direction;
};

// At the centre, inside, on the surface, outside and far away; half of the rays are aimed at the ball, and directions
// are of all lengths.
Ray make_ray(int i) {
  const vec3 at(uniform(i, 0, -1, 1), uniform(i, 1, -1, 1), uniform(i, 2, -1, 1));
  const std::array distances{0.0f, 0.5f, 1.0f, 1.5f, std::exp2(uniform(i, 3, -20, 14))};
  const float distance = distances[static_cast<std::size_t>(uniform(i, 4, 0, 5))];
  const vec3 origin = distance * normalize(at);
  vec3 direction(uniform(i, 5, -1, 1), uniform(i, 6, -1, 1), uniform(i, 7, -1, 1));
  if (i % 2 == 0) direction = direction - origin;
  if (i % 16 == 1) direction.x = direction.y = 0;
  return {origin, std::exp2(uniform(i, 8, -10, 10)) * direction};
}

struct Span {
  float t_enter, t_length;
};

Span kernel_span(const Ray& r, float t_end) {
  const kernel::BoxSpan s = kernel::ball_span(r.origin, r.direction, 0, t_end);
  return {s.t_enter, s.t_length};
}

// The span by the roots of a t^2 + 2 b t + c: the twin.
Span textbook_span(const Ray& r, float t_end) {
  const float a = dot(r.direction, r.direction), b = dot(r.origin, r.direction), c = dot(r.origin, r.origin) - 1;
  const float squared = b * b - a * c;
  if (!(squared > 0)) return {0, 0};
  const float t_enter = std::max(0.0f, (-b - std::sqrt(squared)) / a),
              t_exit = std::min(t_end, (std::sqrt(squared) - b) / a);
  return {t_enter, std::max(0.0f, t_exit - t_enter)};
}

// Whether the span lies in a ball a little larger, and that of a ball a little smaller lies in it.
bool is_right(const Ray& r, float t_end, const Span& span) {
  using Long = long double;
  if (!std::isfinite(span.t_enter) || !std::isfinite(span.t_length) || span.t_length < 0) return false;
  const Long o[] = {r.origin.x, r.origin.y, r.origin.z}, d[] = {r.direction.x, r.direction.y, r.direction.z};
  Long dd = 0, od = 0, oo = 0;
  for (int axis = 0; axis < 3; ++axis) dd += d[axis] * d[axis], od += o[axis] * d[axis], oo += o[axis] * o[axis];
  if (dd == 0) return true;
  const Long moved = 2e-7L * (1 + std::sqrt(oo)), middle = -od / dd, nearest = oo - od * od / dd;
  const auto chord = [&](Long radius, Long& t0, Long& t1) {
    const Long left = radius * radius - nearest;
    const Long half = left > 0 ? std::sqrt(left / dd) : 0;
    t0 = std::clamp<Long>(middle - half, 0, t_end);
    t1 = std::clamp<Long>(middle + half, 0, t_end);
    return left > 0;
  };
  Long outer0, outer1, inner0, inner1;
  const bool may_hit = chord(1 + 2 * moved, outer0, outer1);
  const bool must_hit = chord(1 - 2 * moved, inner0, inner1);
  if (span.t_length == 0) return !must_hit || inner1 - inner0 <= 4 * moved / std::sqrt(dd);
  const Long slack = moved / std::sqrt(dd), enter = span.t_enter, leave = enter + span.t_length;
  return may_hit && enter >= outer0 - slack && leave <= outer1 + slack &&
         (!must_hit || (enter <= inner0 + slack && leave >= inner1 - slack));
}

int wrong_spans(int count, Span (*span)(const Ray&, float), int& hits) {
  int wrong = 0;
  hits = 0;
  for (int i = 0; i < count; ++i) {
    const Ray r = make_ray(i);
    const float t_end = i % 3 == 0 ? uniform(i, 9, 0, 4) : 1e30f;
    const Span found = span(r, t_end);
    hits += found.t_length > 0;
    wrong += !is_right(r, t_end, found);
  }
  return wrong;
}

TEST(BallSpan, IsRightWithinTheStatedRounding) {
  int hits = 0;
  EXPECT_EQ(wrong_spans(rays, kernel_span, hits), 0);
  EXPECT_GT(hits, rays / 4);
  EXPECT_LT(hits, 9 * rays / 10);
}

TEST(BallSpanTwin, TheTextbookRootsAreRejected) {
  int hits = 0;
  EXPECT_GT(wrong_spans(rays / 10, textbook_span, hits), rays / 1000);
}

TEST(BallSpan, OfADirectionOfNoLengthIsNone) {
  EXPECT_EQ(kernel_span({vec3(2, 0, 0), vec3(0, 0, 0)}, 1e30f).t_length, 0);
}

}  // namespace
}  // namespace brume

#include "intersect/quadric.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brume {

namespace {

using Kind = CompiledQuadric::Kind;

// From the x axis, in [0, 2 pi).
double angle_of(Vector3 p) {
  const double phi = std::atan2(p.y, p.x);
  return phi < 0 ? phi + 2 * std::numbers::pi : phi;
}

// Whether the point lies within the part of the circle that the surface has.
bool within_sweep(const CompiledQuadric& quadric, Vector3 p) {
  return quadric.phi_max >= 2 * std::numbers::pi || angle_of(p) <= quadric.phi_max;
}

// Where a line meets a whole surface, and whether against its normal.
struct Roots {
  int count = 0;
  std::array<double, 2> t{};
  std::array<bool, 2> against{};
};

Roots plane_root(Vector3 o, Vector3 d) {
  if (d.z == 0) return {};
  return {1, {-o.z / d.z}, {d.z < 0}};
}

// The roots of |a + t b| = 1, about the point that is nearest to the origin, where cancellation costs nothing. The
// first leads in, also where rounding says that the ray only touches.
Roots unit_roots(Vector3 a, Vector3 b) {
  const double bb = dot(b, b), middle = -dot(a, b) / bb;
  const Vector3 nearest = a + middle * b;
  const double h = 1 - dot(nearest, nearest);
  if (!(h >= 0 && bb > 0)) return {};
  const double half_chord = std::sqrt(h / bb);
  return {2, {middle - half_chord, middle + half_chord}, {true, false}};
}

// f(t) = z - x y = a t^2 + b t + c grows along the normal.
Roots saddle_roots(Vector3 o, Vector3 d) {
  const double a = -d.x * d.y, b = d.z - o.x * d.y - o.y * d.x, c = o.z - o.x * o.y;
  if (a == 0) return b == 0 ? Roots{} : Roots{1, {-c / b}, {b < 0}};
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0)) return {};
  // Without the difference of near numbers.
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  const double t0 = q / a, t1 = q == 0 ? t0 : c / q;
  return {2, {std::min(t0, t1), std::max(t0, t1)}, {a > 0, a < 0}};
}

Vector3 across_z(Vector3 v) { return {v.x, v.y, 0}; }

Vector3 object_normal(const CompiledQuadric& quadric, Vector3 p) {
  switch (quadric.kind) {
    case Kind::sphere:
      return p;
    case Kind::disk:
      return {0, 0, 1};
    case Kind::cylinder:
      return across_z(p);
    case Kind::saddle:
      break;
  }
  return {-p.y, -p.x, 1};
}

}  // namespace

bool is_on_quadric(const CompiledQuadric& quadric, Vector3 p) {
  // Neighbouring patches overlap by this, so that no ray passes between them.
  constexpr double seam = 1e-9;
  switch (quadric.kind) {
    case Kind::sphere:
      return quadric.is_whole_sphere() || (p.z >= quadric.z_min && p.z <= quadric.z_max && within_sweep(quadric, p));
    case Kind::cylinder:
      return p.z >= 0 && p.z <= 1 && within_sweep(quadric, p);
    case Kind::saddle:
      return p.x >= -seam && p.x <= 1 + seam && p.y >= -seam && p.y <= 1 + seam;
    case Kind::disk:
      break;
  }
  const double squared = p.x * p.x + p.y * p.y;
  return squared <= 1 && squared >= quadric.inner_radius * quadric.inner_radius && within_sweep(quadric, p);
}

int quadric_hits(const CompiledQuadric& quadric, Vector3 origin, Vector3 direction, std::array<QuadricHit, 2>& hits) {
  const Vector3 o = quadric.object_from_world.point(origin), d = quadric.object_from_world.vector(direction);
  const bool upright = quadric.kind == Kind::cylinder;
  const Roots roots = quadric.kind == Kind::disk     ? plane_root(o, d)
                      : quadric.kind == Kind::saddle ? saddle_roots(o, d)
                                                     : unit_roots(upright ? across_z(o) : o, upright ? across_z(d) : d);
  int count = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(roots.count); ++i)
    if (is_on_quadric(quadric, o + roots.t[i] * d))
      hits[static_cast<std::size_t>(count++)] = {roots.t[i], roots.against[i] != quadric.flip_normal};
  return count;
}

Vector3 quadric_normal(const CompiledQuadric& quadric, Vector3 p) {
  const Vector3 n = normalize(transposed(quadric.object_from_world, object_normal(quadric, p)));
  return quadric.flip_normal ? -n : n;
}

std::array<float, 2> quadric_uv(const CompiledQuadric& quadric, Vector3 p) {
  double u = quadric.kind == Kind::saddle ? p.x : angle_of(p) / quadric.phi_max, v = p.y;
  if (quadric.kind == Kind::sphere) {
    const double lowest = std::acos(quadric.z_min), highest = std::acos(quadric.z_max);
    v = (std::acos(std::clamp(p.z, -1.0, 1.0)) - lowest) / (highest - lowest);
  } else if (quadric.kind == Kind::disk) {
    v = (1 - std::hypot(p.x, p.y)) / (1 - quadric.inner_radius);
  } else if (quadric.kind == Kind::cylinder) {
    v = p.z;
  }
  return {static_cast<float>(u), static_cast<float>(v)};
}

Tangents quadric_tangents(const CompiledQuadric& quadric, Vector3 p) {
  Vector3 u = quadric.phi_max * Vector3{-p.y, p.x, 0}, v{0, 0, 1};
  if (quadric.kind == Kind::saddle) {
    u = {1, 0, p.y};
    v = {0, 1, p.x};
  } else if (quadric.kind != Kind::cylinder) {
    const double radius = std::hypot(p.x, p.y);
    const Vector3 outwards = radius > 0 ? 1 / radius * across_z(p) : Vector3{};
    if (quadric.kind == Kind::disk)
      v = (quadric.inner_radius - 1) * outwards;
    else
      v = (std::acos(quadric.z_max) - std::acos(quadric.z_min)) * (p.z * outwards - Vector3{0, 0, radius});
  }
  return {quadric.world_from_object.vector(u), quadric.world_from_object.vector(v)};
}

double saddle_area(const CompiledQuadric& quadric, Vector3 p) {
  return std::abs(quadric.world_from_object.determinant()) *
         length(transposed(quadric.object_from_world, object_normal(quadric, p)));
}

Box3 quadric_bounds(const CompiledQuadric& quadric) {
  Box3 box;
  if (quadric.kind == Kind::saddle) {
    for (const Vector3 corner : {Vector3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}})
      box.include(quadric.world_from_object.point(corner));
    for (int axis = 0; axis < 3; ++axis) {
      const double margin = 1e-5 * std::max(std::abs(box.lo[axis]), std::abs(box.hi[axis]));
      box.lo[axis] -= margin;
      box.hi[axis] += margin;
    }
    return box;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto& row = quadric.world_from_object.m[static_cast<std::size_t>(axis)];
    const double tall = quadric.kind == Kind::cylinder ? row[2] : 0;
    const double extent =
        quadric.kind == Kind::sphere ? std::hypot(row[0], row[1], row[2]) : std::hypot(row[0], row[1]);
    const double margin = 1e-5 * (extent + std::abs(tall) + std::abs(row[3]));
    box.lo[axis] = row[3] + std::min(0.0, tall) - extent - margin;
    box.hi[axis] = row[3] + std::max(0.0, tall) + extent + margin;
  }
  return box;
}

}  // namespace brume

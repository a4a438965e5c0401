#include "intersect/quadric.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brume {

namespace {

using Kind = CompiledQuadric::Kind;

// Whether the point lies within the part of the circle that the surface has.
bool within_sweep(const CompiledQuadric& quadric, Vector3 p) {
  if (quadric.phi_max >= 2 * std::numbers::pi) return true;
  const double phi = std::atan2(p.y, p.x);
  return (phi < 0 ? phi + 2 * std::numbers::pi : phi) <= quadric.phi_max;
}

// The two roots of |a + t b| = 1, about the point that is nearest to the origin, where cancellation costs nothing.
bool unit_roots(Vector3 a, Vector3 b, double& t0, double& t1) {
  const double bb = dot(b, b), middle = -dot(a, b) / bb;
  const Vector3 nearest = a + middle * b;
  const double h = 1 - dot(nearest, nearest);
  if (!(h >= 0 && bb > 0)) return false;
  const double half_chord = std::sqrt(h / bb);
  t0 = middle - half_chord;
  t1 = middle + half_chord;
  return true;
}

Vector3 across_z(Vector3 v) { return {v.x, v.y, 0}; }

Vector3 object_normal(const CompiledQuadric& quadric, Vector3 p) {
  if (quadric.kind == Kind::sphere) return p;
  return quadric.kind == Kind::disk ? Vector3{0, 0, 1} : across_z(p);
}

bool on_surface(const CompiledQuadric& quadric, Vector3 p) {
  if (quadric.kind == Kind::sphere) return true;
  if (quadric.kind == Kind::cylinder) return p.z >= 0 && p.z <= 1 && within_sweep(quadric, p);
  const double squared = p.x * p.x + p.y * p.y;
  return squared <= 1 && squared >= quadric.inner_radius * quadric.inner_radius && within_sweep(quadric, p);
}

}  // namespace

int quadric_hits(const CompiledQuadric& quadric, Vector3 origin, Vector3 direction, std::array<QuadricHit, 2>& hits) {
  const Vector3 o = quadric.object_from_world.point(origin), d = quadric.object_from_world.vector(direction);
  double t[2] = {0, 0};
  int candidates = 2;
  if (quadric.kind == Kind::disk) {
    if (d.z == 0) return 0;
    t[0] = -o.z / d.z;
    candidates = 1;
  } else if (quadric.kind == Kind::cylinder) {
    if (!unit_roots(across_z(o), across_z(d), t[0], t[1])) return 0;
  } else if (!unit_roots(o, d, t[0], t[1])) {
    return 0;
  }
  int count = 0;
  for (int i = 0; i < candidates; ++i) {
    const Vector3 p = o + t[i] * d;
    if (!on_surface(quadric, p)) continue;
    // Of two roots the first leads in, also where rounding says that the ray only touches.
    const bool against = candidates == 2 ? i == 0 : dot(object_normal(quadric, p), d) < 0;
    hits[static_cast<std::size_t>(count++)] = {t[i], against != quadric.flip_normal};
  }
  return count;
}

kernel::vec3 quadric_normal(const CompiledQuadric& quadric, Vector3 p_world) {
  const Vector3 p = quadric.object_from_world.point(p_world);
  Vector3 n = normalize(transposed(quadric.object_from_world, object_normal(quadric, p)));
  if (quadric.flip_normal) n = -n;
  return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
}

Box3 quadric_bounds(const CompiledQuadric& quadric) {
  Box3 box;
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

#include "base/geometry.h"

#include <algorithm>
#include <numbers>

namespace brume {

void Box3::include(Vector3 p) {
  for (int a = 0; a < 3; ++a) {
    lo[a] = std::min(lo[a], p[a]);
    hi[a] = std::max(hi[a], p[a]);
  }
}

Vector3 Transform::normal(Vector3 n) const { return transposed(inverse(*this), n); }

Vector3 transposed(const Transform& t, Vector3 v) {
  return {t.m[0][0] * v.x + t.m[1][0] * v.y + t.m[2][0] * v.z, t.m[0][1] * v.x + t.m[1][1] * v.y + t.m[2][1] * v.z,
          t.m[0][2] * v.x + t.m[1][2] * v.y + t.m[2][2] * v.z};
}

double Transform::determinant() const {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

Transform operator*(const Transform& a, const Transform& b) {
  Transform r;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      r.m[i][j] = 0;
      for (std::size_t k = 0; k < 4; ++k) r.m[i][j] += a.m[i][k] * b.m[k][j];
    }
  return r;
}

Transform inverse(const Transform& t) {
  const auto& m = t.m;
  const double d = 1 / t.determinant();
  Transform r;
  const bool singular = !std::isfinite(d);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      r.m[j][i] = singular ? std::nan("") : (m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1]) * d;
    }
  const Vector3 origin = r.vector({m[0][3], m[1][3], m[2][3]});
  r.m[0][3] = -origin.x;
  r.m[1][3] = -origin.y;
  r.m[2][3] = -origin.z;
  return r;
}

Transform translate(Vector3 d) {
  Transform t;
  t.m[0][3] = d.x;
  t.m[1][3] = d.y;
  t.m[2][3] = d.z;
  return t;
}

Transform scale(Vector3 s) {
  Transform t;
  t.m[0][0] = s.x;
  t.m[1][1] = s.y;
  t.m[2][2] = s.z;
  return t;
}

// Rodrigues' formula.
Transform rotate(double degrees, Vector3 axis) {
  const Vector3 a = normalize(axis);
  const double angle = degrees * std::numbers::pi / 180, s = std::sin(angle), c = std::cos(angle);
  Transform t;
  t.m = {{{a.x * a.x + (1 - a.x * a.x) * c, a.x * a.y * (1 - c) - a.z * s, a.x * a.z * (1 - c) + a.y * s, 0},
          {a.x * a.y * (1 - c) + a.z * s, a.y * a.y + (1 - a.y * a.y) * c, a.y * a.z * (1 - c) - a.x * s, 0},
          {a.x * a.z * (1 - c) - a.y * s, a.y * a.z * (1 - c) + a.x * s, a.z * a.z + (1 - a.z * a.z) * c, 0},
          {0, 0, 0, 1}}};
  return t;
}

Transform look_at(Vector3 eye, Vector3 at, Vector3 up) {
  const Vector3 forward = normalize(at - eye), right = normalize(cross(normalize(up), forward)),
                new_up = cross(forward, right);
  Transform world_from_camera;
  for (int row = 0; row < 3; ++row) {
    const auto r = static_cast<std::size_t>(row);
    world_from_camera.m[r] = {right[row], new_up[row], forward[row], eye[row]};
  }
  return inverse(world_from_camera);
}

Box3 bounds(const Transform& t, const Box3& box) {
  Box3 r;
  if (box.empty()) return r;
  for (int corner = 0; corner < 8; ++corner)
    r.include(t.point(
        {corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z}));
  return r;
}

}  // namespace brume

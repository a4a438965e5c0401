// Host-side geometry in double precision: what scenes are described and compiled in. Kernels have their own float vec3.
#pragma once

#include <array>
#include <cmath>
#include <limits>

namespace brume {

struct Vector3 {
  double x = 0, y = 0, z = 0;
  double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  bool operator==(const Vector3&) const = default;
};
inline Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector3 operator-(Vector3 a) { return {-a.x, -a.y, -a.z}; }
inline Vector3 operator*(double s, Vector3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vector3 operator*(Vector3 a, double s) { return s * a; }
inline double dot(Vector3 a, Vector3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector3 cross(Vector3 a, Vector3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vector3 a) { return std::sqrt(dot(a, a)); }
// A zero vector stays zero.
inline Vector3 normalize(Vector3 a) {
  const double l = length(a);
  return l > 0 ? (1 / l) * a : a;
}

// An axis-aligned box; empty where lo > hi on any axis, as a new one is.
struct Box3 {
  Vector3 lo{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()};
  Vector3 hi{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()};
  bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  void include(Vector3 p);
};

// An affine map, applied to columns: p' = M p. m[row][column]; the last row is 0 0 0 1.
struct Transform {
  std::array<std::array<double, 4>, 4> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  Vector3 point(Vector3 p) const {
    const Vector3 v = vector(p);
    return {v.x + m[0][3], v.y + m[1][3], v.z + m[2][3]};
  }
  Vector3 vector(Vector3 v) const {
    return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z, m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
            m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
  }
  // A normal of a surface whose points move by this map: by the inverse transpose; not normalised.
  Vector3 normal(Vector3 n) const;
  double determinant() const;  // of the 3 x 3 part
  bool operator==(const Transform&) const = default;
};
Transform operator*(const Transform& a, const Transform& b);
// The transpose of the 3 x 3 part times v: with the inverse map given, v's image as a normal.
Vector3 transposed(const Transform& t, Vector3 v);
// The inverse; of a singular map, a matrix of NaN (readers reject singular transforms).
Transform inverse(const Transform& t);
Transform translate(Vector3 d);
Transform scale(Vector3 s);
Transform rotate(double degrees, Vector3 axis);
// camera-from-world for an eye looking at a point: pbrt's, left-handed, +z forward, +y up.
Transform look_at(Vector3 eye, Vector3 at, Vector3 up);
// The bounds of the image of a box.
Box3 bounds(const Transform& t, const Box3& box);

}  // namespace brume

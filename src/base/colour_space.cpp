#include "base/colour_space.h"

namespace brume {

namespace {

constexpr Chromaticity d65{0.3127, 0.3290};

Vector3 xyz_of(Chromaticity c) { return {c.x / c.y, 1, (1 - c.x - c.y) / c.y}; }

Matrix3 columns(Vector3 a, Vector3 b, Vector3 c) { return {{{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}}}}; }

Matrix3 diagonal(Vector3 d) { return {{{{d.x, 0, 0}, {0, d.y, 0}, {0, 0, d.z}}}}; }

}  // namespace

const Primaries& primaries(ColourSpace space) {
  static constexpr Primaries all[] = {{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, d65},
                                      {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, d65},
                                      {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, d65},
                                      {{0.7347, 0.2653}, {0, 1}, {0.0001, -0.0770}, {0.32168, 0.33767}}};
  return all[static_cast<std::size_t>(space)];
}

Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
  Matrix3 r;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      r.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
  return r;
}

Matrix3 operator*(double s, const Matrix3& a) { return diagonal({s, s, s}) * a; }

Vector3 operator*(const Matrix3& a, Vector3 v) {
  Vector3 r;
  for (int i = 0; i < 3; ++i) {
    const auto& row = a.m[static_cast<std::size_t>(i)];
    r[i] = row[0] * v.x + row[1] * v.y + row[2] * v.z;
  }
  return r;
}

Matrix3 inverse(const Matrix3& a) {
  Transform t;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) t.m[i][j] = a.m[i][j];
  t = inverse(t);
  Matrix3 r;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r.m[i][j] = t.m[i][j];
  return r;
}

// The primaries, each as strong as makes their sum white. (A primary with y = 0 would have to be written otherwise.)
Matrix3 xyz_from(ColourSpace space) {
  const Primaries& p = primaries(space);
  const Matrix3 unscaled = columns(xyz_of(p.red), xyz_of(p.green), xyz_of(p.blue));
  return unscaled * diagonal(inverse(unscaled) * xyz_of(p.white));
}

Matrix3 white_adaptation(Chromaticity from, Chromaticity to) {
  static constexpr Matrix3 cones_from_xyz{
      {{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}}};
  const Vector3 before = cones_from_xyz * xyz_of(from), after = cones_from_xyz * xyz_of(to);
  return inverse(cones_from_xyz) * diagonal({after.x / before.x, after.y / before.y, after.z / before.z}) *
         cones_from_xyz;
}

Matrix3 rec709_from(ColourSpace space, Whites whites) {
  if (space == ColourSpace::srgb) return {};
  const Matrix3 to_rec709 = inverse(xyz_from(ColourSpace::srgb));
  if (whites == Whites::kept) return to_rec709 * xyz_from(space);
  return to_rec709 * white_adaptation(primaries(space).white, d65) * xyz_from(space);
}

Chromaticity daylight(double kelvin) {
  const double t = 1000 / (kelvin * 1.4388 / 1.4380);
  const double x = t >= 1 / 7.0 ? 0.244063 + t * (0.09911 + t * (2.9678 - t * 4.6070))
                                : 0.237040 + t * (0.24748 + t * (1.9018 - t * 2.0064));
  return {x, -3 * x * x + 2.870 * x - 0.275};
}

}  // namespace brume

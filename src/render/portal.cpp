#include "render/portal.h"

#include <algorithm>
#include <cmath>

namespace brume {

using kernel::vec3;

namespace {

Vector3 to_double(vec3 v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }

// The sine of the angle between the direction (x, h) and (0, h), and the x of such a sine.
double sine_of(double x, double h) { return x / std::hypot(x, h); }
double at_sine(double s, double h) { return h * s / std::sqrt(std::max(1e-30, 1 - s * s)); }

// The solid angle of the rectangle between (0, 0) and (x, y) at the distance h, with the sign of x y.
double solid_angle_to(double x, double y, double h) { return std::atan2(x * y, h * std::sqrt(x * x + y * y + h * h)); }

}  // namespace

bool passes(const CompiledPortal& portal, const Ray& ray) {
  const Vector3 direction = to_double(ray.direction), to_corner = portal.corner - to_double(ray.origin);
  const double along = dot(direction, portal.outwards), h = dot(to_corner, portal.outwards);
  if (!(along > 0 && h > 0)) return false;
  const Vector3 from_corner = (h / along) * direction - to_corner;
  const double x = dot(from_corner, portal.x), y = dot(from_corner, portal.y);
  return x >= 0 && x <= portal.width && y >= 0 && y <= portal.height;
}

PortalView::PortalView(const CompiledPortal& portal, vec3 from) : portal_(portal) {
  const Vector3 to_corner = portal.corner - to_double(from);
  x0_ = dot(to_corner, portal.x);
  x1_ = x0_ + portal.width;
  y0_ = dot(to_corner, portal.y);
  y1_ = y0_ + portal.height;
  h_ = dot(to_corner, portal.outwards);
  if (!(h_ > 0)) return;
  const double seen = strip(x1_) - strip(x0_);
  if (seen > 1e-14) solid_angle_ = seen;  // less is rounding
}

// The solid angle from x = 0 to x, with its sign.
double PortalView::strip(double x) const { return solid_angle_to(x, y1_, h_) - solid_angle_to(x, y0_, h_); }

// With the sines a of x, b0 of y0 and b1 of y1, strip(x) is asin(a b1) - asin(a b0). So that this is phi,
// a = sin(phi) / sqrt(b0^2 + b1^2 - 2 b0 b1 cos(phi)), the root written here without cancellation.
vec3 PortalView::direction(double u, double v) const {
  const double phi = strip(x0_) + u * solid_angle_, half = std::sin(phi / 2);
  const double b0 = sine_of(y0_, h_), b1 = sine_of(y1_, h_);
  const double root = std::sqrt(std::max(1e-300, (b1 - b0) * (b1 - b0) + 4 * b0 * b1 * half * half));
  const double a = std::clamp(std::sin(phi) / root, -1.0, 1.0);
  const double x = std::clamp(at_sine(a, h_), x0_, x1_), distance = std::hypot(x, h_);
  const double c0 = sine_of(y0_, distance), c1 = sine_of(y1_, distance);
  const double y = std::clamp(at_sine(c0 + v * (c1 - c0), distance), y0_, y1_);
  const Vector3 d = normalize(x * portal_.x + y * portal_.y + h_ * portal_.outwards);
  return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
}

}  // namespace brume

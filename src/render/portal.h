// Portals: rectangles that an infinite light shines through.
#pragma once

#include "compiled/compiled_scene.h"
#include "intersect/intersector.h"

namespace brume {

// Whether the ray, on its way to infinity, leaves through the portal.
bool passes(const CompiledPortal& portal, const Ray& ray);

// A portal as it is seen from a point: a solid angle, and directions that are uniform in it. They are drawn one
// coordinate after the other: x in proportion to the solid angle of the strip up to it, then y along that line; both
// steps have closed inverses. Source: C. Urena, M. Fajardo, A. King, "An Area-Preserving Parametrization for Spherical
// Rectangles", CGF 32(4), 2013.
class PortalView {
 public:
  PortalView(const CompiledPortal& portal, kernel::vec3 from);

  // 0 from the outer side, from the portal's plane, and where the portal is too small to be told from nothing.
  double solid_angle() const { return solid_angle_; }
  // For two numbers in [0, 1], where the solid angle is not 0.
  kernel::vec3 direction(double u, double v) const;

 private:
  double strip(double x) const;

  const CompiledPortal& portal_;
  // The rectangle [x0, x1] x [y0, y1] at the distance h, in coordinates along its edges about the point.
  double x0_, x1_, y0_, y1_, h_;
  double solid_angle_ = 0;
};

}  // namespace brume

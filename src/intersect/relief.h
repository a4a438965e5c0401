// Relief that is not there: shading normals that are turned by bump maps and normal maps.
#pragma once

#include "intersect/tangents.h"
#include "intersect/textures.h"

namespace brume {

// The shading normal of a hit on a material that has relief. That of the hit itself, where the turned one would point
// to the other side of the surface or cannot be told.
//
// A bump map is a surface p + d n that is not built, with d the texture's value in world units and n the normal.
// Its tangents are dp/du + d_u n and dp/dv + d_v n, less a term d dn/du, which is small where bumps are small against
// the radii of the surface's curvature. Their cross product has the direction of
//   n + (d_u n x dp/dv + d_v dp/du x n) / a,  a = n . (dp/du x dp/dv),
// that is n less the gradient of d along the surface, whichever way u and v run. Source: J. Blinn, "Simulation of
// Wrinkled Surfaces", SIGGRAPH 1978.
//
// A normal map holds the normal itself: twice its colour less 1 are its parts along dp/du made orthogonal to n, across
// that on the side of dp/dv, and along n.
kernel::vec3 relief_normal(const CompiledScene& scene, const CompiledMaterial& material, const SurfaceHit& hit,
                           const Tangents& tangents);

}  // namespace brume

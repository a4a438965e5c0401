// Spheres, disks and cylinders under affine maps against rays, in double precision.
#pragma once

#include <array>

#include "compiled/compiled_scene.h"

namespace brume {

struct QuadricHit {
  double t = 0;
  bool inwards = false;  // against the normal
};

// Where the line origin + t direction meets the surface, at any t, sorted; returns how often, at most twice.
int quadric_hits(const CompiledQuadric& quadric, Vector3 origin, Vector3 direction, std::array<QuadricHit, 2>& hits);

// The unit normal at a point of the surface. Spheres and cylinders have it outwards, unless it is flipped.
kernel::vec3 quadric_normal(const CompiledQuadric& quadric, Vector3 p_world);

// A little more than the bounds in the world, for boxes in float.
Box3 quadric_bounds(const CompiledQuadric& quadric);

}  // namespace brume

// Spheres, disks, cylinders and saddles under affine maps against rays, in double precision.
#pragma once

#include <array>

#include "compiled/compiled_scene.h"
#include "intersect/tangents.h"

namespace brume {

struct QuadricHit {
  double t = 0;
  bool inwards = false;  // against the normal
};

// Where the line origin + t direction meets the surface, at any t, sorted; returns how often, at most twice.
int quadric_hits(const CompiledQuadric& quadric, Vector3 origin, Vector3 direction, std::array<QuadricHit, 2>& hits);

// Below, `p` is a point of the surface in the quadric's own space.

// Whether a point of the whole sphere, cylinder, plane or saddle belongs to the part of it that there is.
bool is_on_quadric(const CompiledQuadric& quadric, Vector3 p);

// The unit normal in the world. Spheres and cylinders have it outwards, unless it is flipped.
Vector3 quadric_normal(const CompiledQuadric& quadric, Vector3 p);

// pbrt's surface parameters. Spheres and cylinders: u around, from the x axis, v upwards along z (of a sphere in equal
// angles). Disks: u around, v inwards. Saddles: x and y.
std::array<float, 2> quadric_uv(const CompiledQuadric& quadric, Vector3 p);

// How the place in the world changes with these parameters.
Tangents quadric_tangents(const CompiledQuadric& quadric, Vector3 p);

// Saddles: the area in the world of a unit of area of the unit square.
double saddle_area(const CompiledQuadric& quadric, Vector3 p);

// Bilinear in what the corners (0, 0), (1, 0), (0, 1), (1, 1) have.
template <std::size_t size>
std::array<float, size> at_patch(const std::array<std::array<float, size>, 4>& corners, Vector3 p) {
  const double weights[4] = {(1 - p.x) * (1 - p.y), p.x * (1 - p.y), (1 - p.x) * p.y, p.x * p.y};
  std::array<float, size> value{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < size; ++k) value[k] += static_cast<float>(weights[i]) * corners[i][k];
  return value;
}

// A little more than the bounds in the world, for boxes in float.
Box3 quadric_bounds(const CompiledQuadric& quadric);

}  // namespace brume

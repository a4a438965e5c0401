// A shape as Embree holds it, and what Embree calls for it.
#pragma once

#include <embree3/rtcore.h>

#include <vector>

#include "intersect/intersector.h"
#include "intersect/quadric.h"

namespace brume {

struct AttachedShape {
  const CompiledQuadric* quadric = nullptr;  // null: a mesh
  int shape = -1;                            // in the compiled scene
  bool flip_normal = false;                  // mesh: the normal is the negative of Embree's
  bool is_boundary = false;                  // it has its crossings collected, and stops no ray
};

// What a boundary query carries through Embree to the callbacks that collect its crossings. Embree's number of an
// instance, less first_instance, is its place in the compiled scene.
struct CrossingContext {
  RTCIntersectContext embree;  // first, so that a pointer to it is a pointer to this
  std::vector<Crossing>* found;
  int first_ray;
  unsigned first_instance;
};

// A geometry of the shape, committed. `shape` and the scene must outlive it.
RTCGeometry make_geometry(RTCDevice device, const CompiledScene& scene, const AttachedShape& shape);

}  // namespace brume

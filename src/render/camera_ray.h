// Rays from the camera through points of the picture.
#pragma once

#include "compiled/compiled_scene.h"
#include "intersect/intersector.h"

namespace brume {

// The direction that it looks in, of unit length.
inline kernel::vec3 camera_axis(const CompiledCamera& camera) {
  const Vector3 axis = normalize(camera.world_from_camera.vector({0, 0, 1}));
  return {static_cast<float>(axis.x), static_cast<float>(axis.y), static_cast<float>(axis.z)};
}

// Through the point (x, y), in pixels from the top left of the whole picture.
inline Ray camera_ray(const CompiledCamera& camera, double x, double y) {
  const Vector3 origin = camera.world_from_camera.point({});
  const Vector3 direction =
      normalize(camera.world_from_camera.vector({camera.x0 + x * camera.dx, camera.y0 + y * camera.dy, 1}));
  const auto to_float = [](Vector3 v) {
    return kernel::vec3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
  };
  return {to_float(origin), to_float(direction), far_away};
}

}  // namespace brume

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

// Through the point (x, y), in pixels from the top left of the whole picture, from the place on the lens that the
// numbers u and v in [0, 1) stand for; (1/2, 1/2) is its middle. The lens is thin: with (d, 1) the direction through
// its middle, all rays of the point (x, y) meet at focal_distance (d, 1), so that from the place l they go along (d - l
// / focal_distance, 1).
// Source: R. L. Cook, T. Porter and L. Carpenter, "Distributed Ray Tracing", SIGGRAPH 1984.
inline Ray camera_ray(const CompiledCamera& camera, double x, double y, float u, float v) {
  float disk_x, disk_y;
  kernel::disk_point(u, v, disk_x, disk_y);
  const double lens_x = camera.lens_radius * static_cast<double>(disk_x);
  const double lens_y = camera.lens_radius * static_cast<double>(disk_y);
  const Vector3 origin = camera.world_from_camera.point({lens_x, lens_y, 0});
  const Vector3 direction =
      normalize(camera.world_from_camera.vector({camera.x0 + x * camera.dx - lens_x / camera.focal_distance,
                                                 camera.y0 + y * camera.dy - lens_y / camera.focal_distance, 1}));
  const auto to_float = [](Vector3 p) {
    return kernel::vec3(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
  };
  return {to_float(origin), to_float(direction), far_away};
}

}  // namespace brume

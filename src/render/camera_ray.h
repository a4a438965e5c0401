// Rays from the camera through points of the picture.
#pragma once

#include <algorithm>

#include "compiled/compiled_scene.h"
#include "intersect/intersector.h"

namespace brume {

inline kernel::vec3 to_floats(Vector3 p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

// The depth of what a camera sees: how far it is along the axis, or where there is none, how far it is.
class CameraDepth {
 public:
  explicit CameraDepth(const CompiledCamera& camera)
      : has_axis_(!camera.sphere_map), axis_(to_floats(normalize(camera.world_from_camera.vector({0, 0, 1})))) {}
  // Of a unit along a ray.
  float along(kernel::vec3 direction) const { return has_axis_ ? dot(direction, axis_) : 1; }

 private:
  bool has_axis_;
  kernel::vec3 axis_;
};

// Source: pbrt-v4's spherical camera.
inline Vector3 mapped_direction(const CompiledCamera& camera, double x, double y) {
  // A filter reaches beyond the picture, but where it has a few pixels hardly further than the maps do.
  const auto within = [](double coordinate) { return std::clamp(coordinate, -0.25, 1.25); };
  const Vector3 d =
      map_direction(*camera.sphere_map, {within(camera.x0 + x * camera.dx), within(camera.y0 + y * camera.dy)});
  return {d.x, d.z, d.y};
}

// Through the point (x, y), in pixels from the top left of the whole picture, from the place on the lens that the
// numbers u and v in [0, 1) stand for; (1/2, 1/2) is its middle. The lens is thin: with (d, 1) the direction through
// its middle, all rays of the point (x, y) meet at focal_distance (d, 1), so that from the place l they go along (d - l
// / focal_distance, 1).
// Source: R. L. Cook, T. Porter and L. Carpenter, "Distributed Ray Tracing", SIGGRAPH 1984.
inline Ray camera_ray(const CompiledCamera& camera, double x, double y, float u, float v) {
  if (camera.sphere_map)
    return {to_floats(camera.world_from_camera.point({})),
            to_floats(normalize(camera.world_from_camera.vector(mapped_direction(camera, x, y)))), far_away};
  float disk_x, disk_y;
  kernel::disk_point(u, v, disk_x, disk_y);
  const double lens_x = camera.lens_radius * static_cast<double>(disk_x);
  const double lens_y = camera.lens_radius * static_cast<double>(disk_y);
  const Vector3 origin = camera.world_from_camera.point({lens_x, lens_y, 0});
  const Vector3 direction =
      normalize(camera.world_from_camera.vector({camera.x0 + x * camera.dx - lens_x / camera.focal_distance,
                                                 camera.y0 + y * camera.dy - lens_y / camera.focal_distance, 1}));
  return {to_floats(origin), to_floats(direction), far_away};
}

}  // namespace brume

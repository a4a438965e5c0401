// Rays against surfaces: the only place that knows Embree. Built from CompiledScene's geometry.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "compiled/compiled_scene.h"

namespace brume {

// As far as a ray goes that nothing stops. Finite, so that a coefficient of 0 times it is 0.
constexpr float far_away = 1e30f;

// What is seen may have coordinates of this magnitude: Embree takes no more than 1.8e18.
constexpr double farthest_coordinate = 1e18;

// A ray in world space; the direction has unit length, so t is a distance.
struct Ray {
  kernel::vec3 origin, direction;
  float t_max = far_away;
  kernel::vec3 at(float t) const { return origin + t * direction; }
};

// Embree takes a triangle's corners relative to the ray's origin, each axis rounded by itself. With d from the place to
// a corner and n the normal, the plane is off by up to a rounding of the sum over the axes of |n_i d_i|: nothing where
// it faces along an axis, and else, d being at right angles to n, at most twice the sum without the largest |n_i|.
inline float tilted_length(kernel::vec3 n, float longest_edge) {
  const float x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  return std::min(1.0f, 2 * (x + y + z - std::max({x, y, z})) / length(n)) * longest_edge;
}

// What a place, its distance and the triangle that it is on, by its tilted_length, have roundings in proportion to.
// Planes of large triangles were measured to be off by 4e-7 of that; of coordinates and distance we allow for 20 times
// as much.
inline float rounding_extent(kernel::vec3 place, float t, float tilted = 0) {
  return std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z), t, 0.2f * tilted});
}

struct SurfaceHit {
  float t = 0;
  float extent = 0;  // see rounding_extent
  int shape = -1;
  kernel::vec3 position;
  // Unit length. The geometric normal points out of the shape (ReverseOrientation included); the shading normal is on
  // its side.
  kernel::vec3 normal, shading_normal;
  std::array<float, 2> uv{};  // the place on a shape that is textured, as pbrt counts it (see intersect/quadric.h)
  bool from_inside = false;   // the normals were turned, since the ray comes from the side that they point away from
};

// Where a ray passes the boundary of media.
struct Crossing {
  int ray = 0;  // index into the rays asked about
  float t = 0;
  int shape = -1;
  int instance = -1;     // in which the shape stands; below 0: in the world itself
  bool inwards = false;  // against the shape's normal
};

// A ray that is not of finite numbers meets nothing.
class Intersector {
 public:
  // `scene` must outlive this.
  explicit Intersector(const CompiledScene& scene);
  ~Intersector();

  bool has_surfaces() const;
  bool has_boundaries() const;

  // The first surface along the ray; shapes without a material do not count, nor cut-outs that the ray passes.
  bool nearest_surface(const Ray& ray, SurfaceHit& hit) const;

  // blocked[i] = 1 where a surface lies within (0, t_max) of rays[i], else 0.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

  // All passages through boundaries of media along the whole of each ray, t_max ignored, sorted by ray and t. Where a
  // ray meets an edge shared by two triangles or by two parts of a shape, that is one passage.
  void crossings(std::span<const Ray> rays, std::vector<Crossing>& found) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace brume

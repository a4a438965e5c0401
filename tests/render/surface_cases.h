// Shapes with pbrt's parametrisations, to be put into scenes in four ways.
#pragma once

#include <array>
#include <functional>
#include <random>
#include <vector>

#include "compiled/compiled_scene.h"
#include "render/scenes.h"

namespace brume {

struct Surface {
  const char* name;
  decltype(ShapeDescription::kind) shape;
  std::function<Vector3(double u, double v)> point;  // in object space
  // The normal is along dp/du x dp/dv, or against it.
  bool against_cross = false;
};

std::vector<Surface> surfaces();

// A point at random: away from the edges, where rays may pass.
std::array<double, 2> random_uv(const Surface& surface, std::mt19937& random);

// A surface in the world, in the world with its normal reversed, in an instance, and in one that moves nothing.
constexpr int surface_ways = 4;
struct PlacedSurface {
  SceneDescription scene;
  Surface surface;
  Transform world_from_surface;
  bool against_cross = false;  // the normal in the world is against the cross product of the world's dp/du and dp/dv

  Vector3 point(double u, double v) const { return world_from_surface.point(surface.point(u, v)); }
  // Along dp/du x dp/dv.
  Vector3 cross_normal(double u, double v) const;
};
// `material` and `relief` may name the scene's texture, a `texture` of numbers.
PlacedSurface place_surface(const Surface& surface, int way, const MaterialDescription& material,
                            const TextureDescription& texture, const Relief& relief = {});

CompiledScene compiled(const SceneDescription& scene);

inline kernel::vec3 to_float(Vector3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline Vector3 to_double(kernel::vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

}  // namespace brume

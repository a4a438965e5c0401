// Surfaces as integrators see them: reflection and refraction, and how rays leave them.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "compiled/compiled_scene.h"
#include "intersect/intersector.h"
#include "intersect/textures.h"
#include "render/random_stream.h"

namespace brume {

// Turns a hit's normals to the side that the ray comes from.
inline SurfaceHit facing(SurfaceHit hit, kernel::vec3 direction) {
  if (dot(hit.normal, direction) <= 0) return hit;
  hit.normal = -hit.normal;
  hit.shading_normal = -hit.shading_normal;
  hit.from_inside = !hit.from_inside;
  return hit;
}

// How far a ray starts from the surface that it leaves, against hitting it again: some tens of roundings (see
// rounding_extent).
inline kernel::vec3 leave_surface(kernel::vec3 p, kernel::vec3 n, float extent) { return p + (8e-6f * extent) * n; }

// The same for a ray that goes on in this direction, from whichever side.
inline kernel::vec3 leave_towards(kernel::vec3 p, const SurfaceHit& hit, kernel::vec3 direction) {
  return leave_surface(p, dot(direction, hit.normal) < 0 ? -hit.normal : hit.normal, hit.extent);
}

inline float clamped_cosine(kernel::vec3 a, kernel::vec3 b) { return std::max(0.0f, dot(a, b)); }

// The direction of a mirror's reflection.
inline kernel::vec3 reflect(kernel::vec3 direction, kernel::vec3 normal) {
  return normalize(direction - (2 * dot(direction, normal)) * normal);
}

// The material at a hit: the scene's, or where it has textures a copy with the values that they have there.
class MaterialAt {
 public:
  MaterialAt(const CompiledScene& scene, const SurfaceHit& hit)
      : material_(
            &scene.materials[static_cast<std::size_t>(scene.shapes[static_cast<std::size_t>(hit.shape)].material)]) {
    if (!is_textured(*material_)) return;
    CompiledMaterial& m = textured_.emplace(*material_);
    if (m.diffuse_texture >= 0) m.diffuse = texture_reflectance(scene, m.diffuse_texture, hit);
    if (m.ambient_texture >= 0) m.ambient = texture_reflectance(scene, m.ambient_texture, hit);
    material_ = &m;
  }
  MaterialAt(const MaterialAt&) = delete;
  MaterialAt& operator=(const MaterialAt&) = delete;

  const CompiledMaterial& operator*() const { return *material_; }
  const CompiledMaterial* operator->() const { return material_; }

 private:
  const CompiledMaterial* material_;
  std::optional<CompiledMaterial> textured_;
};

// A direction in which a path goes on. The weight is f |cos| over the chance of the choice, for radiance that travels
// against the path: refraction into a medium of index n times as great divides it by n^2. Zero where the path ends.
struct SurfaceSample {
  kernel::vec3 direction;
  Spectrum weight;
  float pdf = 0;  // per steradian; 0 for a mirror's direction or a refracted one, which is the only one
  bool transmitted = false;
};

// Below, `hit` is facing the ray that travels along `direction`.

// What a smooth surface sends on in a mirror's direction and in the refracted one, as shares of the light that meets
// it. Radiance that is refracted is `squeeze` times as great besides, as a solid angle changes with it.
struct SmoothLobes {
  Spectrum reflected, refracted;
  kernel::vec3 refracted_direction{0, 0, 0};
  float squeeze = 1;
};
SmoothLobes smooth_lobes(const CompiledMaterial& material, const SurfaceHit& hit, kernel::vec3 direction);

SurfaceSample sample_surface(const CompiledScene& scene, const SurfaceHit& hit, kernel::vec3 direction,
                             RandomStream& random);

// f |cos| for light from the direction `to_light`, mirrors and smooth glass left out; `pdf` is the density with which
// sample_surface takes that direction. It is 0 for directions beyond the surface, unless that is rough glass.
Spectrum eval_surface(const CompiledScene& scene, const SurfaceHit& hit, kernel::vec3 direction, kernel::vec3 to_light,
                      float& pdf);

// That in two parts: the facets of a rough surface (alpha above 0), with the density of directions that are drawn from
// them, and the rest.
Spectrum eval_matt(const CompiledScene& scene, const SurfaceHit& hit, kernel::vec3 direction, kernel::vec3 to_light);
Spectrum eval_facets(const CompiledScene& scene, const SurfaceHit& hit, kernel::vec3 direction, kernel::vec3 to_light,
                     float& pdf);
SurfaceSample sample_facets(const CompiledMaterial& material, const SurfaceHit& hit, kernel::vec3 direction,
                            RandomStream& random);

// True where eval_surface is not 0 throughout, that is where light can be gathered by shadow rays.
bool scatters_widely(const CompiledMaterial& material);

// The normal on the side from which light is gathered, as sample_light and light_pdf take it; null where that is both.
inline const kernel::vec3* lit_side(const CompiledScene& scene, const SurfaceHit& hit) {
  const auto& shape = scene.shapes[static_cast<std::size_t>(hit.shape)];
  const CompiledMaterial& material = scene.materials[static_cast<std::size_t>(shape.material)];
  return material.kind == CompiledMaterial::Kind::rough_dielectric ? nullptr : &hit.shading_normal;
}

// The share of light that crosses the surface straight on, as if it were not refracted. The cosine to the normal is
// taken for that on the outer side, which before and behind a plate is the same.
Spectrum straight_transmittance(const CompiledMaterial& material, float cosine);

// The ray that goes on from `ray`'s hit, and starts on the side that it is going to.
inline Ray continued(const Ray& ray, const SurfaceHit& hit, const SurfaceSample& sample) {
  return {leave_towards(ray.at(hit.t), hit, sample.direction), sample.direction, far_away};
}

}  // namespace brume

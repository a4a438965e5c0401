// Textures at hits.
#pragma once

#include "compiled/compiled_scene.h"
#include "intersect/intersector.h"

namespace brume {

// A place on a surface, as textures are asked for it.
struct SurfacePlace {
  std::array<double, 2> uv{};
  Vector3 position;
};
SurfacePlace place_of(const SurfaceHit& hit);

// The value there; a texture of numbers has the same in all channels.
Spectrum texture_value(const CompiledScene& scene, std::int32_t texture, const SurfacePlace& place);
inline Spectrum texture_value(const CompiledScene& scene, std::int32_t texture, const SurfaceHit& hit) {
  return texture_value(scene, texture, place_of(hit));
}

// The same within [0, 1], as a reflectance.
Spectrum texture_reflectance(const CompiledScene& scene, std::int32_t texture, const SurfaceHit& hit);

}  // namespace brume

// Textures at hits.
#pragma once

#include "compiled/compiled_scene.h"
#include "intersect/intersector.h"

namespace brume {

// The value there; a texture of numbers has the same in all channels.
Spectrum texture_value(const CompiledScene& scene, std::int32_t texture, const SurfaceHit& hit);

// The same within [0, 1], as a reflectance.
Spectrum texture_reflectance(const CompiledScene& scene, std::int32_t texture, const SurfaceHit& hit);

}  // namespace brume

// The (u, v) of places on shapes, for textures.
#pragma once

#include "intersect/quadric.h"

namespace brume {

// At (1 - b1 - b2, b1, b2) between the corners of a triangle, which is counted from the mesh's first.
inline std::array<float, 2> triangle_uv(const CompiledScene& scene, const CompiledMesh& mesh, std::uint32_t triangle,
                                        float b1, float b2) {
  if (mesh.first_uv < 0) return {b1 + b2, b2};
  const auto& corners = scene.triangles[mesh.first_triangle + triangle];
  const float weights[3] = {1 - b1 - b2, b1, b2};
  std::array<float, 2> uv{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 2; ++k)
      uv[k] += weights[i] * scene.uvs[static_cast<std::size_t>(mesh.first_uv) + corners[i]][k];
  return uv;
}

// At a point in the quadric's own space.
inline std::array<float, 2> surface_uv(const CompiledScene& scene, const CompiledQuadric& quadric, Vector3 p) {
  if (quadric.patch < 0) return quadric_uv(quadric, p);
  return at_patch(scene.patches[static_cast<std::size_t>(quadric.patch)].uv, p);
}

}  // namespace brume

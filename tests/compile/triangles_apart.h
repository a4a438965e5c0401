// Meshes as they come from files that know no shared vertices.
#pragma once

#include "scene/description.h"

namespace brume {

// The same triangles, each with vertices of its own.
inline TriangleMeshShape triangles_apart(const TriangleMeshShape& mesh) {
  TriangleMeshShape apart;
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(apart.positions.size());
    for (const std::uint32_t v : triangle) apart.positions.push_back(mesh.positions[v]);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  return apart;
}

}  // namespace brume

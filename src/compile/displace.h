// Displacement: the triangles of a mesh are split until their edges are short, and its vertices moved along their
// normals.
#pragma once

#include <functional>
#include <optional>

#include "scene/description.h"

namespace brume {

// How far a vertex moves, by its place in the mesh's own space and its (u, v).
using Displace = std::function<double(Vector3 p, const std::array<double, 2>& uv)>;

// The mesh, which has uv, with no edge longer than `edge_length` in the world before it is displaced, and with normals
// of its own new shape. None where that takes more than max_triangles.
std::optional<TriangleMeshShape> displaced(TriangleMeshShape mesh, const Transform& world_from_object,
                                           double edge_length, const Displace& displace, std::size_t max_triangles);

}  // namespace brume

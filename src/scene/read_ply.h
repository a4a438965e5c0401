// Meshes of .ply files.
#pragma once

#include <string>
#include <string_view>

#include "scene/description.h"

namespace brume {

struct PlyMesh {
  TriangleMeshShape mesh;
  std::size_t skipped_faces = 0;  // those that have neither three nor four corners
};

// Reads element `vertex` (x y z, nx ny nz where there are all three, and u v, s t,
// texture_u texture_v or texture_s texture_t) and element `face` (the list vertex_indices or
// vertex_index) of a file in text or in binary of either byte order; whatever else it holds is passed over. Faces of
// four corners become two triangles. Throws InputError.
PlyMesh read_ply(const std::string& path);
// The same for bytes at hand; `name` is for messages.
PlyMesh read_ply_bytes(const std::string& name, std::string_view bytes);

}  // namespace brume

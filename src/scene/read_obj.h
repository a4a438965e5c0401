// Meshes of Wavefront's .obj files.
#pragma once

#include <string>

#include "scene/description.h"

namespace brume {

struct ObjMesh {
  TriangleMeshShape mesh;
  bool names_materials = false;      // which are not read
  bool lacks_normals_or_uv = false;  // in some corners, so that those of the others are left out
  std::size_t skipped_elements = 0;  // points and lines
};

// Reads v, vt, vn and f, all objects and groups into one mesh; corners with the same v/vt/vn are one vertex. Polygons
// of up to 256 corners become triangles, concave ones too. Throws InputError.
ObjMesh read_obj(const std::string& path);
// The same from the file's text; `name` is for messages.
ObjMesh read_obj_text(const std::string& name, std::string text);

// A polygon, given by its corners in order, as triangles of their indices: n - 2 of them, by cutting off ears in the
// plane that fits it best. What crosses itself gives some triangles between its corners.
std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<Vector3>& polygon);

}  // namespace brume

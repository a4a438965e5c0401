// Bilinear patches: p(u, v) = p00 + u e10 + v e01 + u v t with the edges e10 = p10 - p00, e01 = p01 - p00 and the twist
// t = p00 - p10 - p01 + p11. It is the image of the saddle z = x y under the affine map whose columns are e10, e01 and
// t, and met exactly as such. Where they lie in a plane there is no such map, and two triangles fill the patch.
#include <cmath>

#include "compile/compiler.h"

namespace brume {

namespace {

// Of a patch's size: by how little it may miss the plane and still be taken for flat, a few roundings of its corners in
// float.
constexpr double flatness = 1e-6;

Transform from_saddle(const std::array<Vector3, 4>& p) {
  const Vector3 e10 = p[1] - p[0], e01 = p[2] - p[0], twist = p[3] - p[1] - e01;
  Transform t;
  for (int row = 0; row < 3; ++row) t.m[static_cast<std::size_t>(row)] = {e10[row], e01[row], twist[row], p[0][row]};
  return t;
}

bool is_flat(const std::array<Vector3, 4>& p) {
  const Vector3 e10 = p[1] - p[0], e01 = p[2] - p[0], e11 = p[3] - p[0];
  return !(std::abs(dot(cross(e10, e01), e11)) > flatness * length(e10) * length(e01) * length(e11));
}

}  // namespace

std::vector<CompiledShape> Compiler::add_patches(const ShapeDescription& shape, const BilinearMeshShape& patches) {
  std::vector<CompiledShape> parts;
  TriangleMeshShape flat;
  for (const auto& corners : patches.patches) {
    std::array<Vector3, 4> p, normals;
    std::array<std::array<double, 2>, 4> uv{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
    for (std::size_t i = 0; i < 4; ++i) {
      p[i] = patches.positions[corners[i]];
      if (!patches.normals.empty()) normals[i] = patches.normals[corners[i]];
      if (!patches.uv.empty()) uv[i] = patches.uv[corners[i]];
    }
    if (!is_flat(p)) {
      parts.push_back(add_saddle(shape, from_saddle(p), normals, uv));
      continue;
    }
    const auto first = static_cast<std::uint32_t>(flat.positions.size());
    flat.positions.insert(flat.positions.end(), p.begin(), p.end());
    if (!patches.normals.empty()) flat.normals.insert(flat.normals.end(), normals.begin(), normals.end());
    flat.uv.insert(flat.uv.end(), uv.begin(), uv.end());
    flat.triangles.push_back({first, first + 1, first + 3});
    flat.triangles.push_back({first, first + 3, first + 2});
  }
  if (!flat.triangles.empty()) parts.push_back(add_mesh(shape, flat));
  return parts;
}

CompiledShape Compiler::add_saddle(const ShapeDescription& shape, const Transform& object_from_saddle,
                                   const std::array<Vector3, 4>& normals,
                                   const std::array<std::array<double, 2>, 4>& uv) {
  CompiledQuadric q;
  q.kind = CompiledQuadric::Kind::saddle;
  q.world_from_object = shape.world_from_object * object_from_saddle;
  q.object_from_world = inverse(q.world_from_object);
  // The normal is along e10 x e01 in the shape's own space.
  q.flip_normal = flips_normal(shape) != (q.world_from_object.determinant() < 0);
  q.patch = static_cast<std::int32_t>(compiled_.patches.size());
  CompiledPatch patch;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3 n = normals[i] == Vector3{} ? Vector3{} : world_normal(shape, normals[i]);
    patch.normals[i] = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
    patch.uv[i] = {static_cast<float>(uv[i][0]), static_cast<float>(uv[i][1])};
  }
  compiled_.patches.push_back(patch);
  return add_quadric(q);
}

}  // namespace brume

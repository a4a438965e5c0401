// Media in boxes, which rays meet by arithmetic alone: volumes placed without a shape, and closed boxes of triangles
// that are nothing but the boundary of a medium.
#include <algorithm>
#include <cmath>
#include <optional>

#include "compile/compiler.h"

namespace brume {

namespace {

Vector3 to_vector(const std::array<float, 3>& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

std::array<float, 3> to_float(Vector3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// The map from the unit cube to the parallelepiped with a corner and three edges.
Transform from_unit_cube(Vector3 corner, Vector3 a, Vector3 b, Vector3 c) {
  Transform t;
  for (int row = 0; row < 3; ++row) t.m[static_cast<std::size_t>(row)] = {a[row], b[row], c[row], corner[row]};
  return t;
}

// Which corner of the unit cube p is, as three bits; none where it is not within 1e-5 of one.
std::optional<int> unit_corner(Vector3 p) {
  int corner = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const bool high = p[axis] > 0.5;
    if (!(std::abs(p[axis] - (high ? 1 : 0)) <= 1e-5)) return std::nullopt;
    corner |= (high ? 1 : 0) << axis;
  }
  return corner;
}

// The parallelepiped whose corners are these eight points, as the image of the unit cube.
std::optional<Transform> parallelepiped(const std::vector<Vector3>& points) {
  for (std::size_t i = 1; i < 8; ++i)
    for (std::size_t j = i + 1; j < 8; ++j)
      for (std::size_t k = j + 1; k < 8; ++k) {
        const Transform world_from_unit =
            from_unit_cube(points[0], points[i] - points[0], points[j] - points[0], points[k] - points[0]);
        const Transform unit_from_world = inverse(world_from_unit);
        int seen = 0;
        for (const Vector3& p : points) {
          const std::optional<int> corner = unit_corner(unit_from_world.point(p));
          if (corner) seen |= 1 << *corner;
        }
        if (seen == 0xff) return world_from_unit;
      }
  return std::nullopt;
}

// Whether twelve triangles between corners of the unit cube are its six faces, two triangles each.
bool is_closed_box(const std::vector<std::array<int, 3>>& triangles) {
  std::array<std::vector<int>, 6> faces;  // the corners that each triangle leaves out of its face
  for (const auto& [a, b, c] : triangles) {
    if (a == b || b == c || c == a) return false;
    const int all = a & b & c, none = ~(a | b | c) & 7;
    int face = -1;
    for (int axis = 0; axis < 3; ++axis) {
      if (all >> axis & 1) face = 2 * axis + 1;
      if (none >> axis & 1) face = 2 * axis;
    }
    if (face < 0) return false;
    const int axis = face / 2, fixed = (face & 1) << axis;
    // The sum of the four corners of a face: each free axis twice, the fixed one four times or never.
    const int sum = 4 * fixed + 2 * (7 & ~(1 << axis));
    faces[static_cast<std::size_t>(face)].push_back(sum - a - b - c);
  }
  // Two triangles cover a face where the corners that they leave out are opposite.
  return std::all_of(faces.begin(), faces.end(), [&](const std::vector<int>& left_out) {
    if (left_out.size() != 2) return false;
    const int difference = left_out[0] ^ left_out[1];
    return difference == 3 || difference == 5 || difference == 6;
  });
}

// The box that a mesh is, with its normals outwards.
std::optional<Transform> as_box(const CompiledScene& scene, const CompiledMesh& mesh) {
  if (mesh.triangle_count != 12) return std::nullopt;
  std::vector<Vector3> points;
  for (std::uint32_t i = 0; i < mesh.vertex_count; ++i) {
    const Vector3 p = to_vector(scene.positions[mesh.first_vertex + i]);
    if (std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
    if (points.size() > 8) return std::nullopt;
  }
  if (points.size() != 8) return std::nullopt;
  const std::optional<Transform> world_from_unit = parallelepiped(points);
  if (!world_from_unit) return std::nullopt;
  const Transform unit_from_world = inverse(*world_from_unit);
  const Vector3 centre = world_from_unit->point({0.5, 0.5, 0.5});
  std::vector<std::array<int, 3>> triangles;
  for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) {
    std::array<Vector3, 3> p;
    std::array<int, 3> corners{};
    for (std::size_t v = 0; v < 3; ++v) {
      p[v] = to_vector(scene.positions[mesh.first_vertex + scene.triangles[mesh.first_triangle + i][v]]);
      const std::optional<int> corner = unit_corner(unit_from_world.point(p[v]));
      if (!corner) return std::nullopt;
      corners[v] = *corner;
    }
    const Vector3 normal = cross(p[1] - p[0], p[2] - p[0]);
    if ((dot(normal, p[0] - centre) < 0) != mesh.flip_normal) return std::nullopt;
    triangles.push_back(corners);
  }
  return is_closed_box(triangles) ? world_from_unit : std::nullopt;
}

// The part of a grid's bounds that lies in a box, where that is a box along the grid's axes.
std::optional<Box3> grid_in_box(const CompiledGrid& grid, const Transform& index_from_unit) {
  const Box3 bounds_index{to_vector(grid.bounds_lo), to_vector(grid.bounds_hi)};
  const Box3 in_unit = bounds(inverse(index_from_unit), bounds_index);
  bool is_inside = true;
  for (int axis = 0; axis < 3; ++axis)
    is_inside = is_inside && in_unit.lo[axis] >= -1e-9 && in_unit.hi[axis] <= 1 + 1e-9;
  if (is_inside) return bounds_index;
  for (const auto& row : index_from_unit.m) {
    int nonzero = 0;
    for (std::size_t i = 0; i < 3; ++i) nonzero += std::abs(row[i]) > 1e-4;  // of a voxel
    if (nonzero > 1) return std::nullopt;
  }
  Box3 box = bounds(index_from_unit, {{0, 0, 0}, {1, 1, 1}});
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = std::max(box.lo[axis], bounds_index.lo[axis]);
    box.hi[axis] = std::min(box.hi[axis], bounds_index.hi[axis]);
  }
  return box;
}

}  // namespace

void Compiler::add_volume(std::int32_t medium) {
  const CompiledMedium& m = compiled_.media[static_cast<std::size_t>(medium)];
  if (m.grid < 0) return;
  const CompiledGrid& grid = compiled_.grids[static_cast<std::size_t>(m.grid)];
  compiled_.volumes.push_back({medium, m.index_from_world, grid.bounds_lo, grid.bounds_hi});
}

void Compiler::boxes_to_volumes() {
  // More of them could overlap than a path can follow; boundaries say where.
  if (compiled_.boundaries.size() > max_active_media) return;
  // A medium that some shape displaces is counted along rays.
  const auto is_displaced = [&](std::int32_t medium) {
    return std::any_of(compiled_.boundaries.begin(), compiled_.boundaries.end(),
                       [&](const CompiledBoundary& b) { return b.outside == medium; });
  };
  const auto to_volume = [&](const CompiledShape& shape) {
    if (shape.kind != CompiledShape::Kind::mesh || shape.material >= 0 || shape.boundary < 0) return false;
    const CompiledBoundary& boundary = compiled_.boundaries[static_cast<std::size_t>(shape.boundary)];
    if (boundary.inside == no_medium || boundary.outside != no_medium || is_displaced(boundary.inside)) return false;
    const std::optional<Transform> world_from_unit = as_box(compiled_, compiled_.meshes[shape.index]);
    if (!world_from_unit) return false;
    const CompiledMedium& medium = compiled_.media[static_cast<std::size_t>(boundary.inside)];
    if (medium.grid < 0) {
      compiled_.volumes.push_back({boundary.inside, inverse(*world_from_unit), {0, 0, 0}, {1, 1, 1}});
      return true;
    }
    const std::optional<Box3> box =
        grid_in_box(compiled_.grids[static_cast<std::size_t>(medium.grid)], medium.index_from_world * *world_from_unit);
    if (!box) return false;
    if (!box->empty())
      compiled_.volumes.push_back({boundary.inside, medium.index_from_world, to_float(box->lo), to_float(box->hi)});
    return true;
  };
  const auto first = compiled_.shapes.begin() + compiled_.world.first_shape;
  compiled_.shapes.erase(std::remove_if(first, compiled_.shapes.end(), to_volume), compiled_.shapes.end());
  compiled_.world.shape_count = static_cast<std::uint32_t>(compiled_.shapes.size()) - compiled_.world.first_shape;
}

}  // namespace brume

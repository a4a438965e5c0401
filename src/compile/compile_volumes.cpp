// Media in regions that rays meet by arithmetic alone: volumes placed without a shape, and the insides of spheres and
// of closed boxes of triangles that are nothing but boundaries of media.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "compile/compiler.h"

namespace brume {

namespace {

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

// The region that a shape bounds with its normals outwards, where it is a box or a sphere.
std::optional<CompiledRegion> region_within(const CompiledScene& scene, const CompiledShape& shape) {
  if (shape.kind == CompiledShape::Kind::quadric) {
    const CompiledQuadric& q = scene.quadrics[shape.index];
    if (!q.is_whole_sphere() || q.flip_normal) return std::nullopt;
    return CompiledRegion{CompiledRegion::Kind::ball, q.object_from_world};
  }
  const std::optional<Transform> world_from_unit = as_box(scene, scene.meshes[shape.index]);
  if (!world_from_unit) return std::nullopt;
  return CompiledRegion{CompiledRegion::Kind::box, inverse(*world_from_unit), {0, 0, 0}, {1, 1, 1}};
}

// The part of a medium's grid that lies in a region, where that is a box along the grid's axes; empty where it is none.
std::optional<CompiledRegion> part_of_grid(const CompiledMedium& medium, const CompiledGrid& grid,
                                           const CompiledRegion& region) {
  const Transform index_from_local = medium.index_from_world * inverse(region.local_from_world);
  Box3 box{to_vector(grid.bounds_lo), to_vector(grid.bounds_hi)};
  const auto holds_all = [&] {
    const Transform local_from_index = inverse(index_from_local);
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 p = local_from_index.point(
          {(corner & 1 ? box.hi : box.lo).x, (corner & 2 ? box.hi : box.lo).y, (corner & 4 ? box.hi : box.lo).z});
      if (region.kind == CompiledRegion::Kind::ball ? !(dot(p, p) <= 1 + 1e-9)
                                                    : !(p.x >= -1e-9 && p.x <= 1 + 1e-9 && p.y >= -1e-9 &&
                                                        p.y <= 1 + 1e-9 && p.z >= -1e-9 && p.z <= 1 + 1e-9))
        return false;
    }
    return true;
  };
  if (!holds_all()) {
    if (region.kind == CompiledRegion::Kind::ball) return std::nullopt;
    for (const auto& row : index_from_local.m) {
      int nonzero = 0;
      for (std::size_t i = 0; i < 3; ++i) nonzero += std::abs(row[i]) > 1e-4;  // of a voxel
      if (nonzero > 1) return std::nullopt;
    }
    const Box3 cut = bounds(index_from_local, {{0, 0, 0}, {1, 1, 1}});
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::max(box.lo[axis], cut.lo[axis]);
      box.hi[axis] = std::min(box.hi[axis], cut.hi[axis]);
    }
  }
  return CompiledRegion{CompiledRegion::Kind::box, medium.index_from_world, to_float(box.lo), to_float(box.hi)};
}

}  // namespace

void Compiler::add_volume(std::int32_t medium) {
  const CompiledMedium& m = compiled_.media[static_cast<std::size_t>(medium)];
  if (m.grid < 0) return;
  const CompiledGrid& grid = compiled_.grids[static_cast<std::size_t>(m.grid)];
  compiled_.volumes.push_back(
      {medium, {CompiledRegion::Kind::box, m.index_from_world, grid.bounds_lo, grid.bounds_hi}});
}

namespace {

// A shape that bounds media.
struct Boundary {
  CompiledBoundary media;
  std::optional<CompiledRegion> region;  // where it is nothing else, and its inside is a region
};

// Which media are where, as far as arithmetic tells it: those that fill the insides of regions and are displaced at
// most by one, if they fill one alone, and whose neighbours across all boundaries are such media too.
class ArithmeticMedia {
 public:
  ArithmeticMedia(const CompiledScene& scene, const std::vector<Boundary>& boundaries)
      : scene_(scene), boundaries_(boundaries), is_one_(scene.media.size(), true) {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t m = 0; m < is_one_.size(); ++m) {
        if (!is_one_[m] || qualifies(static_cast<std::int32_t>(m))) continue;
        is_one_[m] = false;
        changed = true;
      }
    }
  }

  bool includes(std::int32_t medium) const { return medium == no_medium || is_one_[static_cast<std::size_t>(medium)]; }
  bool includes(const Boundary& b) const { return b.region && includes(b.media.inside) && includes(b.media.outside); }
  // The boundary that displaces the medium.
  const Boundary* hole_in(std::int32_t medium) const {
    const auto at = std::find_if(boundaries_.begin(), boundaries_.end(),
                                 [&](const Boundary& b) { return b.media.outside == medium; });
    return at == boundaries_.end() ? nullptr : &*at;
  }
  // The part of the medium's region in the boundary that is not empty for want of a grid.
  std::optional<CompiledRegion> region_of(const Boundary& b) const {
    const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(b.media.inside)];
    if (medium.grid < 0) return b.region;
    return part_of_grid(medium, scene_.grids[static_cast<std::size_t>(medium.grid)], *b.region);
  }

 private:
  bool qualifies(std::int32_t medium) const {
    int inside = 0, outside = 0;
    for (const Boundary& b : boundaries_) {
      if (b.media.inside != medium && b.media.outside != medium) continue;
      if (!includes(b) || (b.media.inside == medium && !region_of(b))) return false;
      inside += b.media.inside == medium;
      outside += b.media.outside == medium;
    }
    if (outside == 0) return true;
    if (inside != 1 || outside != 1) return false;
    // A camera in a hole that sticks out of the region would have the medium around all.
    const Boundary& region = *std::find_if(boundaries_.begin(), boundaries_.end(),
                                           [&](const Boundary& b) { return b.media.inside == medium; });
    const Vector3 eye = scene_.camera.world_from_camera.point({});
    return !hole_in(medium)->region->contains(eye) || region.region->contains(eye);
  }

  const CompiledScene& scene_;
  const std::vector<Boundary>& boundaries_;
  std::vector<bool> is_one_;  // by medium
};

}  // namespace

void Compiler::boundaries_to_volumes() {
  // More of them could overlap than a path can follow; boundaries say where.
  if (compiled_.boundaries.size() > max_active_media) return;
  std::vector<Boundary> boundaries;
  std::vector<std::size_t> boundary_of_shape;
  for (std::size_t i = 0; i < compiled_.shapes.size(); ++i) {
    const CompiledShape& shape = compiled_.shapes[i];
    boundary_of_shape.push_back(boundaries.size());
    if (shape.boundary < 0) continue;
    boundaries.push_back({compiled_.boundaries[static_cast<std::size_t>(shape.boundary)], {}});
    const bool in_world = i >= compiled_.world.first_shape;  // once, and where it says
    if (shape.material < 0 && in_world) boundaries.back().region = region_within(compiled_, shape);
  }
  const ArithmeticMedia media(compiled_, boundaries);
  std::map<const Boundary*, std::int32_t> holes;
  const auto add_hole = [&](const Boundary* b) {
    if (!b) return -1;
    const auto [at, is_new] = holes.try_emplace(b, static_cast<std::int32_t>(compiled_.holes.size()));
    if (is_new) compiled_.holes.push_back(*b->region);
    return at->second;
  };
  for (const Boundary& b : boundaries) {
    if (!media.includes(b) || b.media.inside == no_medium) continue;
    const CompiledRegion region = *media.region_of(b);
    if (region.lo[0] < region.hi[0] && region.lo[1] < region.hi[1] && region.lo[2] < region.hi[2])
      compiled_.volumes.push_back({b.media.inside, region, add_hole(media.hole_in(b.media.inside))});
  }
  std::size_t next = 0;
  std::erase_if(compiled_.shapes, [&](const CompiledShape& shape) {
    const std::size_t boundary = boundary_of_shape[next++];
    return shape.boundary >= 0 && media.includes(boundaries[boundary]);
  });
  compiled_.world.shape_count = static_cast<std::uint32_t>(compiled_.shapes.size()) - compiled_.world.first_shape;
}

}  // namespace brume

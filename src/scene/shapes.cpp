// Shape, and what is checked of free volumes once all media are known.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scene/reader.h"

namespace brume {

namespace {

SphereShape read_sphere(ParameterList& p) {
  const double radius = p.number("radius", 1, Range::above(0));
  const bool whole =
      p.number("zmin", -radius) <= -radius && p.number("zmax", radius) >= radius && p.number("phimax", 360) >= 360;
  if (!whole) p.error(p.place(), "parts of a sphere are not supported: leave out zmin, zmax and phimax");
  p.ignore({"float zmin", "float zmax", "float phimax"});
  return {radius};
}

QuadShape read_quad(ParameterList& p) {
  QuadShape quad;
  quad.origin = p.triple(ParameterType::point3, "origin", quad.origin);
  quad.edge_u = p.triple(ParameterType::vector3, "edgeu", quad.edge_u);
  quad.edge_v = p.triple(ParameterType::vector3, "edgev", quad.edge_v);
  if (!(length(cross(quad.edge_u, quad.edge_v)) > 0))
    p.error(p.place(), "the quad has no area: edgeu and edgev must be neither 0 nor parallel");
  return quad;
}

// Triples of indices, each below the number of vertices. Three vertices without indices are one triangle.
std::vector<std::array<std::uint32_t, 3>> read_indices(ParameterList& p, std::size_t vertices) {
  const Parameter* indices = p.find(ParameterType::integer, "indices");
  if (!indices) {
    if (vertices != 3) p.require(ParameterType::integer, "indices");
    return {{0, 1, 2}};
  }
  const std::vector<std::int64_t>& v = indices->integers;
  if (v.size() % 3 != 0) {
    p.value_error(*indices, 0, fmt::format("takes three indices a triangle, found {} in all", v.size()));
    return {};
  }
  std::vector<std::array<std::uint32_t, 3>> triangles(v.size() / 3);
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (v[i] < 0 || v[i] >= static_cast<std::int64_t>(vertices)) {
      p.value_error(*indices, i,
                    fmt::format("must be from 0 to {}, the last of the points P, found {}", vertices - 1, v[i]));
      return {};
    }
    triangles[i / 3][i % 3] = static_cast<std::uint32_t>(v[i]);
  }
  return triangles;
}

TriangleMeshShape read_triangle_mesh(ParameterList& p) {
  TriangleMeshShape mesh;
  p.require(ParameterType::point3, "P");
  mesh.positions = p.triples(ParameterType::point3, "P");
  if (p.has(ParameterType::point3, "P"))
    mesh.triangles = read_indices(p, mesh.positions.size());
  else
    p.ignore({"integer indices"});
  mesh.normals = p.triples(ParameterType::normal, "N");
  if (!mesh.normals.empty() && !mesh.positions.empty() && mesh.normals.size() != mesh.positions.size())
    p.value_error(*p.find(ParameterType::normal, "N"), 0,
                  fmt::format("must have a normal for each of the {} points P, found {}", mesh.positions.size(),
                              mesh.normals.size()));
  p.ignore({"vector3 S", "point2 uv", "float uv", "point2 st", "float st", "integer faceIndices"});
  return mesh;
}

}  // namespace

void Reader::shape() {
  const std::string type = string_argument("a type");
  const std::vector<std::string_view> types = {"sphere", "trianglemesh", "quad", "volume"};
  if (std::find(types.begin(), types.end(), type) == types.end())
    unknown_type(argument_, "Shape", type, types,
                 {"cylinder", "disk", "plymesh", "bilinearmesh", "loopsubdiv", "curve"});
  ParameterList p = parameters(fmt::format("Shape \"{}\"", type), "shape");

  ShapeDescription shape;
  shape.location = location(directive_.place);
  shape.inside = state_.inside;
  if (type == "volume") {
    // It has neither a surface nor a place of its own.
    shape.material = InterfaceMaterial{};
    shape.kind = VolumeShape{};
    volume_uses_.push_back({state_.inside, state_.ctm, directive_.place});
    p.finish();
    scene_.shapes.push_back(std::move(shape));
    return;
  }
  shape.world_from_object = usable_ctm("the shape");
  shape.reverse_orientation = state_.reverse_orientation;
  shape.material = state_.material;
  shape.outside = state_.outside;
  if (type == "sphere") shape.kind = read_sphere(p);
  if (type == "quad") shape.kind = read_quad(p);
  if (type == "trianglemesh") shape.kind = read_triangle_mesh(p);
  if (p.number("alpha", 1) != 1)
    p.value_error(*p.find(ParameterType::float_, "alpha"), 0, "must be 1: cut-outs are not supported yet");
  p.finish();
  scene_.shapes.push_back(std::move(shape));
}

void Reader::check_volumes() {
  for (const VolumeUse& use : volume_uses_) {
    if (use.inside.empty())
      messages_.error(use.place, "Shape \"volume\" needs a medium: give its name by MediumInterface before");
    const auto medium = media_by_name_.find(use.inside);
    if (medium == media_by_name_.end()) continue;  // reported where it is named
    const MediumDescription& m = scene_.media[medium->second];
    if (std::holds_alternative<HomogeneousMedium>(m.kind))
      messages_.error(use.place, fmt::format("Shape \"volume\" needs a medium with bounds of its own, and \"{}\" is "
                                             "homogeneous: put it inside a closed shape",
                                             printable(use.inside)));
    else if (use.ctm != Transform() && use.ctm != m.world_from_medium)
      messages_.warning(use.place,
                        fmt::format("the current transformation has no effect on Shape \"volume\", which stands "
                                    "where MakeNamedMedium \"{}\" put it",
                                    printable(use.inside)));
  }
}

}  // namespace brume

// Shape, and what is checked of free volumes once all media are known.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scene/read_obj.h"
#include "scene/read_ply.h"
#include "scene/reader.h"

namespace brume {

namespace {

SphereShape read_sphere(ParameterList& p) {
  SphereShape sphere;
  sphere.radius = p.number("radius", 1, Range::above(0));
  const double a = p.number("zmin", -sphere.radius), b = p.number("zmax", sphere.radius);
  if (std::min(a, b) > -sphere.radius) sphere.z_min = std::min(a, b);
  if (std::max(a, b) < sphere.radius) sphere.z_max = std::max(a, b);
  sphere.phi_max = p.number("phimax", sphere.phi_max, Range{0, 360, true, false});
  if (a == b || std::min(a, b) >= sphere.radius || std::max(a, b) <= -sphere.radius)
    p.error(p.place(), fmt::format("nothing is left of the sphere of radius {} between zmin = {} and zmax = {}",
                                   sphere.radius, a, b));
  return sphere;
}

DiskShape read_disk(ParameterList& p) {
  DiskShape disk;
  disk.radius = p.number("radius", disk.radius, Range::above(0));
  disk.height = p.number("height", disk.height);
  disk.inner_radius = p.number("innerradius", disk.inner_radius, Range::at_least(0));
  disk.phi_max = p.number("phimax", disk.phi_max, Range{0, 360, true, false});
  if (disk.inner_radius >= disk.radius && disk.inner_radius > 0)
    p.value_error(*p.find(ParameterType::float_, "innerradius"), 0,
                  fmt::format("must be below the radius, {}, found {}", disk.radius, disk.inner_radius));
  return disk;
}

CylinderShape read_cylinder(ParameterList& p) {
  CylinderShape cylinder;
  cylinder.radius = p.number("radius", cylinder.radius, Range::above(0));
  const double a = p.number("zmin", cylinder.z_min), b = p.number("zmax", cylinder.z_max);
  cylinder.z_min = std::min(a, b);
  cylinder.z_max = std::max(a, b);
  cylinder.phi_max = p.number("phimax", cylinder.phi_max, Range{0, 360, true, false});
  cylinder.caps = p.boolean("caps", false);
  if (a == b) p.error(p.place(), fmt::format("the cylinder has no height: zmin and zmax are both {}", a));
  return cylinder;
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

// Indices of faces of `corners` vertices each, all below the number of vertices. That many vertices without indices are
// one face.
template <std::size_t corners>
std::vector<std::array<std::uint32_t, corners>> read_indices(ParameterList& p, std::size_t vertices,
                                                             std::string_view rule) {
  const Parameter* indices = p.find(ParameterType::integer, "indices");
  if (!indices) {
    if (vertices != corners) {
      p.require(ParameterType::integer, "indices");
      return {};
    }
    std::array<std::uint32_t, corners> face;
    for (std::size_t i = 0; i < corners; ++i) face[i] = static_cast<std::uint32_t>(i);
    return {face};
  }
  const std::vector<std::int64_t>& v = indices->integers;
  if (v.size() % corners != 0) {
    p.value_error(*indices, 0, fmt::format("takes {}, found {} in all", rule, v.size()));
    return {};
  }
  std::vector<std::array<std::uint32_t, corners>> faces(v.size() / corners);
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (v[i] < 0 || v[i] >= static_cast<std::int64_t>(vertices)) {
      p.value_error(*indices, i,
                    fmt::format("must be from 0 to {}, the last of the points P, found {}", vertices - 1, v[i]));
      return {};
    }
    faces[i / corners][i % corners] = static_cast<std::uint32_t>(v[i]);
  }
  return faces;
}

// Normals and uv.
template <class Mesh>
void read_vertex_values(ParameterList& p, Mesh& mesh) {
  mesh.normals = p.triples(ParameterType::normal, "N");
  if (!mesh.normals.empty() && !mesh.positions.empty() && mesh.normals.size() != mesh.positions.size())
    p.value_error(*p.find(ParameterType::normal, "N"), 0,
                  fmt::format("must have a normal for each of the {} points P, found {}", mesh.positions.size(),
                              mesh.normals.size()));
  // pbrt's old spellings.
  for (const std::string_view name : {"uv", "st"})
    for (const ParameterType type : {ParameterType::point2, ParameterType::float_}) {
      const Parameter* given = p.find(type, name);
      if (!given) continue;
      const std::vector<double>& v = given->numbers;
      if (v.size() != 2 * mesh.positions.size() && !mesh.positions.empty())
        p.value_error(*given, 0,
                      fmt::format("must have two numbers for each of the {} points P, found {}", mesh.positions.size(),
                                  v.size()));
      mesh.uv.clear();
      for (std::size_t i = 0; i + 1 < v.size(); i += 2) mesh.uv.push_back({v[i], v[i + 1]});
    }
}

TriangleMeshShape read_triangle_mesh(ParameterList& p) {
  TriangleMeshShape mesh;
  p.require(ParameterType::point3, "P");
  mesh.positions = p.triples(ParameterType::point3, "P");
  if (p.has(ParameterType::point3, "P"))
    mesh.triangles = read_indices<3>(p, mesh.positions.size(), "three indices a triangle");
  else
    p.ignore({"integer indices"});
  read_vertex_values(p, mesh);
  p.ignore({"vector3 S", "integer faceIndices"});
  return mesh;
}

BilinearMeshShape read_bilinear_mesh(ParameterList& p) {
  BilinearMeshShape mesh;
  p.require(ParameterType::point3, "P");
  mesh.positions = p.triples(ParameterType::point3, "P");
  if (p.has(ParameterType::point3, "P"))
    mesh.patches = read_indices<4>(p, mesh.positions.size(), "four indices a patch");
  else
    p.ignore({"integer indices"});
  read_vertex_values(p, mesh);
  // pbrt draws the points of a light by the image: that changes the noise, and not what the light sends out.
  p.ignore({"integer faceIndices", "string emissionfilename"});
  return mesh;
}

}  // namespace

TriangleMeshShape Reader::ply_mesh(ParameterList& p) {
  p.require(ParameterType::string, "filename");
  const std::string name = p.string("filename", "");
  const GivenName file = file_name(p, "filename");
  if (file.empty()) return {};
  const Place place = p.place_of(ParameterType::string, "filename");
  try {
    PlyMesh ply = read_ply(file);
    if (ply.skipped_faces > 0)
      messages_.warning(place, fmt::format("\"{}\" has {} faces with neither three nor four corners; they are left out",
                                           printable(name), ply.skipped_faces));
    return std::move(ply.mesh);
  } catch (const InputError& e) {
    p.error(place, fmt::format("\"{}\" {}", printable(name), e.diagnostics().front().message));
    return {};
  }
}

TriangleMeshShape Reader::obj_mesh(ParameterList& p) {
  p.require(ParameterType::string, "filename");
  const std::string name = p.string("filename", "");
  const GivenName file = file_name(p, "filename");
  if (file.empty()) return {};
  const Place place = p.place_of(ParameterType::string, "filename");
  try {
    ObjMesh obj = read_obj(file);
    const auto warn = [&](bool is_so, const std::string& what) {
      if (is_so) messages_.warning(place, fmt::format("\"{}\" {}", printable(name), what));
    };
    warn(obj.names_materials, "names materials; they are not read, and the current one is used");
    warn(obj.lacks_normals_or_uv, "has normals or uv in some corners and not in others; they are left out");
    warn(obj.skipped_elements > 0, fmt::format("has {} points and lines; they are left out", obj.skipped_elements));
    return std::move(obj.mesh);
  } catch (const InputError& e) {
    p.error(place, fmt::format("\"{}\" {}", printable(name), e.diagnostics().front().message));
    return {};
  }
}

std::optional<Displacement> Reader::displacement(ParameterList& p) {
  const double edge_length = p.number("edgelength", 1, Range::above(0));
  Textured texture;
  use_texture(p, "displacement", true, texture);
  if (texture.texture < 0) return std::nullopt;
  return Displacement{texture.texture, edge_length};
}

void Reader::shape() {
  const std::string type = string_argument("a type");
  const std::vector<std::string_view> types = {"sphere", "trianglemesh", "plymesh",  "objmesh", "bilinearmesh",
                                               "quad",   "disk",         "cylinder", "volume"};
  if (std::find(types.begin(), types.end(), type) == types.end())
    unknown_type(argument_, "Shape", type, types, {"loopsubdiv", "curve"});
  ParameterList p = parameters(fmt::format("Shape \"{}\"", type), "shape");

  ShapeDescription shape;
  shape.location = location(directive_.place);
  shape.inside = state_.inside;
  if (type == "volume" && in_object_)
    messages_.fail(directive_.place, "Shape \"volume\" has no place in an object: media stay where they are made");
  if (type == "volume") {
    // It has neither a surface nor a place of its own.
    shape.material = InterfaceMaterial{};
    shape.kind = VolumeShape{};
    volume_uses_.push_back({state_.inside, state_.ctm, directive_.place});
    p.finish();
    add_shape(std::move(shape));
    return;
  }
  shape.world_from_object = usable_ctm("the shape");
  shape.reverse_orientation = state_.reverse_orientation;
  shape.material = state_.material.surface;
  shape.relief = state_.material.relief;
  shape.outside = state_.outside;
  if (state_.area_light && in_object_) {
    messages_.warning(directive_.place, "AreaLightSource has no effect on the shapes of objects");
  } else if (!std::holds_alternative<InterfaceMaterial>(shape.material)) {
    shape.light = state_.area_light;
  } else if (state_.area_light) {
    messages_.warning(directive_.place, "AreaLightSource has no effect on a shape whose material is \"interface\"");
  }
  if (type == "sphere") shape.kind = read_sphere(p);
  if (type == "quad") shape.kind = read_quad(p);
  if (type == "disk") shape.kind = read_disk(p);
  if (type == "cylinder") shape.kind = read_cylinder(p);
  if (type == "trianglemesh") shape.kind = read_triangle_mesh(p);
  if (type == "bilinearmesh") shape.kind = read_bilinear_mesh(p);
  if (type == "plymesh") shape.kind = ply_mesh(p);
  if (type == "objmesh") shape.kind = obj_mesh(p);
  if (auto* mesh = std::get_if<TriangleMeshShape>(&shape.kind)) mesh->displacement = displacement(p);
  shape.alpha = constant_spectrum(static_cast<float>(p.number("alpha", 1, Range::from_to(0, 1))));
  use_texture(p, "alpha", true, shape.alpha);
  p.finish();
  add_shape(std::move(shape));
}

void Reader::check_volumes() {
  for (const VolumeUse& use : volume_uses_) {
    if (use.inside.empty())
      messages_.error(use.place, "Shape \"volume\" needs a medium: give its name by MediumInterface before");
    const auto medium = media_by_name_.find(use.inside);
    if (medium == media_by_name_.end()) continue;  // reported where it is named
    const MediumDescription& m = scene_.media[medium->second.index];
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

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "base/fresnel.h"
#include "base/microfacet.h"
#include "compile/bounds_media.h"
#include "compile/compiler.h"
#include "compile/displace.h"
#include "compiled/coat.h"
#include "intersect/textures.h"

namespace brume {

namespace {

std::array<float, 3> to_float(Vector3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// Keeps a Blinn-Phong highlight from making light: at normal incidence, where it is brightest, it sends back what it
// gets. Source: F. Giesen, "Phong Normalization Factor derivations", 2009: with c = (s + 2) (s + 4) / (8 pi (2^(-s/2) +
// s)), the integral of c (n.h)^s cos over the hemisphere is 1.
float highlight_scale(double s) {
  return static_cast<float>((s + 2) * (s + 4) / (8 * std::numbers::pi * (std::exp2(-s / 2) + s)));
}

// Of the light that meets a rough coat at a cosine, how much it lets in: what its facets do not reflect, each one as
// Fresnel has it; light that would hit a second facet is let in. By quadrature over the facets that are seen.
float rough_transmittance(float cosine, float eta, float alpha) {
  constexpr int steps = 48;
  const kernel::vec3 n(0, 0, 1), v(std::sqrt(1 - cosine * cosine), 0, cosine);
  double reflected = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const auto middle = [](int k) { return (static_cast<float>(k) + 0.5f) / steps; };
      const kernel::vec3 h = draw_facet(n, v, alpha, middle(i), middle(j));
      const float along = dot(h, v), out = 2 * along * h.z - v.z;
      if (out <= 0) continue;
      float refracted_cosine = 0;
      const float hidden = hidden_facets(cosine, alpha);
      reflected += static_cast<double>(fresnel_dielectric(along, eta, refracted_cosine) * (1 + hidden) /
                                       (1 + hidden + hidden_facets(out, alpha)));
    }
  return static_cast<float>(1 - reflected / (steps * steps));
}

// Of diffuse light that meets the coat from within. By reciprocity it is 1 - T / eta^2, with T, how much is let in of
// diffuse light from without, the integral of 2 mu times that at the cosine mu.
float internal_reflectance(const CompiledMaterial& m) {
  constexpr int steps = 4096;
  double let_in = 0;
  for (int i = 0; i < steps; ++i) {
    const float mu = (static_cast<float>(i) + 0.5f) / steps;
    let_in += 2 * static_cast<double>(mu * coat_transmittance(m, mu)) / steps;
  }
  const auto eta = static_cast<double>(m.refractive_index);
  return static_cast<float>(1 - let_in / (eta * eta));
}

// What follows from a coat's index of refraction and its roughness; it takes milliseconds.
void add_coat_tables(CompiledMaterial& m) {
  constexpr auto intervals = static_cast<float>(std::tuple_size_v<decltype(m.coat_transmittance)> - 1);
  if (m.alpha > 0)
    for (std::size_t i = 0; i < m.coat_transmittance.size(); ++i)
      m.coat_transmittance[i] =
          rough_transmittance(std::max(1e-3f, static_cast<float>(i) / intervals), m.refractive_index, m.alpha);
  m.internal_reflectance = internal_reflectance(m);
}

// Part of the shape, as the image of a part of a unit quadric (see CompiledQuadric).
CompiledQuadric quadric_of(const ShapeDescription& shape, CompiledQuadric::Kind kind, const Transform& object_from_unit,
                           double phi_max) {
  CompiledQuadric c;
  c.kind = kind;
  c.phi_max = phi_max * std::numbers::pi / 180;
  c.world_from_object = shape.world_from_object * object_from_unit;
  c.object_from_world = inverse(c.world_from_object);
  c.flip_normal = flips_normal(shape);
  return c;
}

CompiledQuadric compile_sphere(const ShapeDescription& shape, const SphereShape& sphere) {
  CompiledQuadric c = quadric_of(shape, CompiledQuadric::Kind::sphere,
                                 scale({sphere.radius, sphere.radius, sphere.radius}), sphere.phi_max);
  c.z_min = std::max(-1.0, sphere.z_min / sphere.radius);
  c.z_max = std::min(1.0, sphere.z_max / sphere.radius);
  return c;
}

CompiledQuadric compile_disk(const ShapeDescription& shape, const DiskShape& disk) {
  CompiledQuadric c = quadric_of(shape, CompiledQuadric::Kind::disk,
                                 translate({0, 0, disk.height}) * scale({disk.radius, disk.radius, 1}), disk.phi_max);
  c.inner_radius = disk.inner_radius / disk.radius;
  return c;
}

// The wall and, where there are caps, the lower and the upper one.
std::vector<CompiledQuadric> compile_cylinder(const ShapeDescription& shape, const CylinderShape& cylinder) {
  const auto [radius, z_min, z_max, phi_max, caps] = cylinder;
  std::vector<CompiledQuadric> all = {quadric_of(shape, CompiledQuadric::Kind::cylinder,
                                                 translate({0, 0, z_min}) * scale({radius, radius, z_max - z_min}),
                                                 phi_max)};
  if (!caps) return all;
  all.push_back(compile_disk(shape, {radius, z_min, 0, phi_max}));
  all.back().flip_normal = !all.back().flip_normal;
  all.push_back(compile_disk(shape, {radius, z_max, 0, phi_max}));
  return all;
}

// Of the body that the shape is the surface of; null where it absorbs nothing.
const Spectrum* absorption_of(const ShapeDescription& shape) {
  const auto* phong = std::get_if<BlinnPhongMaterial>(&shape.material);
  return phong && !is_zero(phong->refraction) && !is_zero(phong->absorption) ? &phong->absorption : nullptr;
}

}  // namespace

bool flips_normal(const ShapeDescription& shape) {
  return shape.reverse_orientation != (shape.world_from_object.determinant() < 0);
}

Vector3 world_normal(const ShapeDescription& shape, Vector3 n) {
  const Vector3 world = normalize(shape.world_from_object.normal(n));
  return shape.reverse_orientation ? -world : world;
}

void Compiler::add_shape(const ShapeDescription& shape) {
  const std::int32_t inside = medium_index(shape.inside, shape.location);
  const std::int32_t outside = medium_index(shape.outside, shape.location);
  if (std::holds_alternative<VolumeShape>(shape.kind)) {
    if (inside == no_medium && shape.inside.empty())
      error(shape.location, "Shape \"volume\" needs an inside medium; none is current");
    else if (inside != no_medium && compiled_.media[static_cast<std::size_t>(inside)].grid < 0 && errors_.empty())
      error(shape.location, "Shape \"volume\" needs a medium with bounds; \"" + shape.inside + "\" is homogeneous");
    else if (inside != no_medium)
      add_volume(inside);
    return;
  }
  CompiledShape compiled;
  if (!std::holds_alternative<InterfaceMaterial>(shape.material))
    compiled.material = material_index(shape.material, shape.relief);
  if (is_cut_out(shape)) {
    check_cut_out(shape);
    compiled.alpha = operand(shape.alpha);
  } else if (bounds_media(shape)) {
    compiled.boundary = static_cast<std::int32_t>(compiled_.boundaries.size());
    compiled_.boundaries.push_back({inside, outside});
  }
  if (compiled.material < 0 && compiled.boundary < 0) return;  // nothing to see or to enter
  std::vector<CompiledShape> parts = add_geometry(shape);
  if (!parts.empty()) check_range(bounds_of(parts), "the shape", shape.location);
  for (CompiledShape& part : parts) {
    part.material = compiled.material;
    part.boundary = compiled.boundary;
    part.alpha = compiled.alpha;
    if (part.material < 0) continue;
    const CompiledMaterial& material = compiled_.materials[static_cast<std::size_t>(part.material)];
    part.is_textured = is_textured(material) || has_relief(material) || part.alpha >= 0;
  }
  if (shape.light && compiled.material >= 0) add_area_lights(*shape.light, parts);
  compiled_.shapes.insert(compiled_.shapes.end(), parts.begin(), parts.end());
  if (const Spectrum* absorption = absorption_of(shape)) add_absorption(std::move(parts), *absorption);
}

void Compiler::check_cut_out(const ShapeDescription& shape) {
  const char* what = !shape.inside.empty() && shape.inside != shape.outside ? "has a medium inside"
                     : absorption_of(shape)                                 ? "absorbs"
                                                                            : nullptr;
  if (what) error(shape.location, std::string("\"alpha\" of a shape that ") + what + " must be 1");
}

void Compiler::add_absorption(std::vector<CompiledShape> parts, const Spectrum& sigma_a) {
  auto found = std::find_if(absorbers_.begin(), absorbers_.end(), [&](std::int32_t medium) {
    return compiled_.media[static_cast<std::size_t>(medium)].sigma_t == sigma_a;
  });
  if (found == absorbers_.end()) {
    CompiledMedium medium;
    medium.sigma_t = sigma_a;
    medium.phase = phase_kind("isotropic");
    found = absorbers_.insert(absorbers_.end(), static_cast<std::int32_t>(compiled_.media.size()));
    compiled_.media.push_back(medium);
  }
  for (CompiledShape& part : parts) {
    part.material = part.light = -1;
    part.is_textured = false;
    part.boundary = static_cast<std::int32_t>(compiled_.boundaries.size());
  }
  compiled_.boundaries.push_back({*found, no_medium});
  compiled_.shapes.insert(compiled_.shapes.end(), parts.begin(), parts.end());
}

std::vector<CompiledShape> Compiler::add_geometry(const ShapeDescription& shape) {
  if (const auto* sphere = std::get_if<SphereShape>(&shape.kind)) return {add_quadric(compile_sphere(shape, *sphere))};
  if (const auto* disk = std::get_if<DiskShape>(&shape.kind)) return {add_quadric(compile_disk(shape, *disk))};
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape.kind)) {
    std::vector<CompiledShape> parts;
    for (const CompiledQuadric& q : compile_cylinder(shape, *cylinder)) parts.push_back(add_quadric(q));
    return parts;
  }
  if (const auto* patches = std::get_if<BilinearMeshShape>(&shape.kind)) return add_patches(shape, *patches);
  if (const auto* mesh = std::get_if<TriangleMeshShape>(&shape.kind)) {
    if (mesh->displacement) return {add_mesh(shape, displaced_mesh(shape, *mesh))};
    return {add_mesh(shape, *mesh)};
  }
  const auto& [origin, u, v] = std::get<QuadShape>(shape.kind);
  return {add_mesh(shape, {{origin, origin + u, origin + u + v, origin + v},
                           {{0, 1, 2}, {0, 2, 3}},
                           {},
                           {{0, 0}, {1, 0}, {1, 1}, {0, 1}}})};
}

CompiledShape Compiler::add_quadric(const CompiledQuadric& quadric) {
  compiled_.quadrics.push_back(quadric);
  return {CompiledShape::Kind::quadric, static_cast<std::uint32_t>(compiled_.quadrics.size() - 1)};
}

TriangleMeshShape Compiler::displaced_mesh(const ShapeDescription& shape, const TriangleMeshShape& mesh) {
  constexpr std::size_t max_triangles = std::size_t{1} << 24;
  constexpr double max_float = std::numeric_limits<float>::max();
  if (mesh.uv.empty()) error(shape.location, "\"texture displacement\" needs a mesh whose vertices have u and v");
  if (!errors_.empty()) return mesh;  // the texture may lack its picture
  const Displacement& displacement = *mesh.displacement;
  const std::int32_t texture = textures_.at(static_cast<std::size_t>(displacement.texture));
  bool in_range = true;
  const auto displace = [&](Vector3 p, const std::array<double, 2>& uv) {
    const std::array<float, 3> place = to_float(shape.world_from_object.point(p));
    SurfaceHit vertex;
    vertex.position = {place[0], place[1], place[2]};
    vertex.uv = {static_cast<float>(uv[0]), static_cast<float>(uv[1])};
    const auto distance = static_cast<double>(texture_value(compiled_, texture, vertex)[0]);
    in_range = in_range && std::abs(distance) <= max_float;
    return distance;
  };
  auto result = displaced(mesh, shape.world_from_object, displacement.edge_length, displace, max_triangles);
  if (!result)
    error(shape.location, fmt::format("with edges of at most {} (\"float edgelength\") the mesh would have more than "
                                      "{} triangles",
                                      displacement.edge_length, max_triangles));
  if (!in_range) error(shape.location, "\"texture displacement\" is infinite or not a number on the mesh");
  return result && in_range ? std::move(*result) : mesh;
}

CompiledShape Compiler::add_mesh(const ShapeDescription& shape, const TriangleMeshShape& from) {
  CompiledMesh mesh;
  mesh.first_vertex = static_cast<std::uint32_t>(compiled_.positions.size());
  mesh.vertex_count = static_cast<std::uint32_t>(from.positions.size());
  mesh.first_triangle = static_cast<std::uint32_t>(compiled_.triangles.size());
  mesh.triangle_count = static_cast<std::uint32_t>(from.triangles.size());
  mesh.has_normals = !from.normals.empty();
  mesh.flip_normal = flips_normal(shape);
  for (const Vector3& p : from.positions) compiled_.positions.push_back(to_float(shape.world_from_object.point(p)));
  compiled_.triangles.insert(compiled_.triangles.end(), from.triangles.begin(), from.triangles.end());
  if (mesh.has_normals) {
    compiled_.normals.resize(mesh.first_vertex);  // earlier meshes may have none
    for (const Vector3& n : from.normals) compiled_.normals.push_back(to_float(world_normal(shape, n)));
  }
  if (!from.uv.empty()) {
    mesh.first_uv = static_cast<std::int64_t>(compiled_.uvs.size());
    for (const auto& [u, v] : from.uv) compiled_.uvs.push_back({static_cast<float>(u), static_cast<float>(v)});
  }
  compiled_.meshes.push_back(mesh);
  return {CompiledShape::Kind::mesh, static_cast<std::uint32_t>(compiled_.meshes.size() - 1)};
}

CompiledMaterial Compiler::compile_material(const MaterialDescription& material) const {
  CompiledMaterial c;
  const auto set = [&](const Textured& from, Spectrum& value, std::int32_t& texture) {
    value = from.value;
    if (from.texture >= 0) texture = textures_.at(static_cast<std::size_t>(from.texture));
  };
  const auto set_diffuse = [&](const Textured& from) { set(from, c.diffuse, c.diffuse_texture); };
  const auto set_ambient = [&](const Textured& from) { set(from, c.ambient, c.ambient_texture); };
  if (const auto* diffuse = std::get_if<DiffuseMaterial>(&material)) {
    set_diffuse(diffuse->reflectance);
    set_ambient(diffuse->reflectance);
  } else if (const auto* phong = std::get_if<BlinnPhongMaterial>(&material)) {
    set_diffuse(phong->diffuse);
    set_ambient(phong->ambient);
    c.specular = phong->specular;
    c.mirror = phong->reflection;
    c.refraction = phong->refraction;
    c.shininess = phong->shininess;
    c.metallic = phong->metallic;
    c.highlight_scale = highlight_scale(static_cast<double>(phong->shininess));
    c.refractive_index = phong->index;
  } else if (const auto* conductor = std::get_if<ConductorMaterial>(&material)) {
    c.kind = CompiledMaterial::Kind::conductor;
    c.eta = conductor->eta;
    c.k = conductor->k;
    c.alpha = conductor->alpha;
    if (c.alpha > 0)
      for (int i = 0; i < channel_count; ++i) c.ambient[i] = fresnel_conductor(1, c.eta[i], c.k[i]);
  } else if (const auto* dielectric = std::get_if<DielectricMaterial>(&material)) {
    c.refraction = constant_spectrum(1);
    c.refractive_index = dielectric->eta;
    // With nothing to refract, facets do not show.
    if (dielectric->alpha > 0 && std::abs(dielectric->eta - 1) > 1e-3f) {
      c.kind = CompiledMaterial::Kind::rough_dielectric;
      c.alpha = dielectric->alpha;
    }
  } else if (const auto* coated = std::get_if<CoatedDiffuseMaterial>(&material)) {
    c.kind = CompiledMaterial::Kind::coated_diffuse;
    set_diffuse(coated->reflectance);
    set_ambient(coated->reflectance);
    c.refractive_index = coated->eta;
    c.alpha = coated->alpha;
  }
  return c;
}

std::int32_t Compiler::material_index(const MaterialDescription& material, const Relief& relief) {
  CompiledMaterial c = compile_material(material);
  if (relief.displacement >= 0) c.displacement = textures_.at(static_cast<std::size_t>(relief.displacement));
  if (!relief.normal_map.empty()) c.normal_map = normal_map(relief);
  const auto [known, is_new] = materials_.try_emplace(c, static_cast<std::int32_t>(compiled_.materials.size()));
  if (is_new) {
    if (c.kind == CompiledMaterial::Kind::coated_diffuse) add_coat_tables(c);
    compiled_.materials.push_back(c);
  }
  return known->second;
}

}  // namespace brume

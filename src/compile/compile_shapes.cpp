#include <algorithm>
#include <numbers>
#include <tuple>

#include "base/fresnel.h"
#include "base/microfacet.h"
#include "compile/compiler.h"
#include "compiled/coat.h"

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

CompiledMaterial compile_material(const MaterialDescription& material) {
  CompiledMaterial c;
  if (const auto* diffuse = std::get_if<DiffuseMaterial>(&material)) {
    c.diffuse = c.ambient = diffuse->reflectance;
  } else if (const auto* phong = std::get_if<BlinnPhongMaterial>(&material)) {
    c.diffuse = phong->diffuse;
    c.specular = phong->specular;
    c.mirror = phong->reflection;
    c.refraction = phong->refraction;
    c.ambient = phong->ambient;
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
  } else if (const auto* coated = std::get_if<CoatedDiffuseMaterial>(&material)) {
    c.kind = CompiledMaterial::Kind::coated_diffuse;
    c.diffuse = c.ambient = coated->reflectance;
    c.refractive_index = coated->eta;
    c.alpha = coated->alpha;
    constexpr auto intervals = static_cast<float>(std::tuple_size_v<decltype(c.coat_transmittance)> - 1);
    if (c.alpha > 0)
      for (std::size_t i = 0; i < c.coat_transmittance.size(); ++i)
        c.coat_transmittance[i] =
            rough_transmittance(std::max(1e-3f, static_cast<float>(i) / intervals), c.refractive_index, c.alpha);
    c.internal_reflectance = internal_reflectance(c);
  }
  return c;
}

// The unit sphere, disk or cylinder (see CompiledQuadric) that the shape is, and the map that makes it the shape.
bool compile_quadric(const ShapeDescription& shape, CompiledQuadric& c) {
  Transform object_from_unit;
  double phi_max = 360;
  if (const auto* sphere = std::get_if<SphereShape>(&shape.kind)) {
    c.kind = CompiledQuadric::Kind::sphere;
    object_from_unit = scale({sphere->radius, sphere->radius, sphere->radius});
  } else if (const auto* disk = std::get_if<DiskShape>(&shape.kind)) {
    c.kind = CompiledQuadric::Kind::disk;
    object_from_unit = translate({0, 0, disk->height}) * scale({disk->radius, disk->radius, 1});
    c.inner_radius = disk->inner_radius / disk->radius;
    phi_max = disk->phi_max;
  } else if (const auto* cylinder = std::get_if<CylinderShape>(&shape.kind)) {
    c.kind = CompiledQuadric::Kind::cylinder;
    object_from_unit = translate({0, 0, cylinder->z_min}) *
                       scale({cylinder->radius, cylinder->radius, cylinder->z_max - cylinder->z_min});
    phi_max = cylinder->phi_max;
  } else {
    return false;
  }
  c.phi_max = phi_max * std::numbers::pi / 180;
  c.world_from_object = shape.world_from_object * object_from_unit;
  c.object_from_world = inverse(c.world_from_object);
  c.flip_normal = shape.reverse_orientation != (shape.world_from_object.determinant() < 0);
  return true;
}

}  // namespace

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
  if (!std::holds_alternative<InterfaceMaterial>(shape.material)) compiled.material = material_index(shape.material);
  if (inside != outside) {
    compiled.boundary = static_cast<std::int32_t>(compiled_.boundaries.size());
    compiled_.boundaries.push_back({inside, outside});
  }
  if (compiled.material < 0 && compiled.boundary < 0) return;  // nothing to see or to enter
  add_geometry(shape, compiled);
  if (shape.light && compiled.material >= 0) compiled.light = add_area_light(*shape.light, compiled);
  compiled_.shapes.push_back(compiled);
  if (const auto* phong = std::get_if<BlinnPhongMaterial>(&shape.material);
      phong && !is_zero(phong->refraction) && !is_zero(phong->absorption))
    add_absorption(compiled, phong->absorption);
}

void Compiler::add_absorption(CompiledShape shape, const Spectrum& sigma_a) {
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
  shape.material = shape.light = -1;
  shape.boundary = static_cast<std::int32_t>(compiled_.boundaries.size());
  compiled_.boundaries.push_back({*found, no_medium});
  compiled_.shapes.push_back(shape);
}

void Compiler::add_geometry(const ShapeDescription& shape, CompiledShape& compiled) {
  compiled.kind = CompiledShape::Kind::mesh;
  if (CompiledQuadric quadric; compile_quadric(shape, quadric)) {
    compiled.kind = CompiledShape::Kind::quadric;
    compiled.index = static_cast<std::uint32_t>(compiled_.quadrics.size());
    compiled_.quadrics.push_back(quadric);
  } else if (const auto* mesh = std::get_if<TriangleMeshShape>(&shape.kind)) {
    compiled.index = add_mesh(shape, mesh->positions, mesh->triangles, mesh->normals);
  } else {
    const auto& q = std::get<QuadShape>(shape.kind);
    compiled.index =
        add_mesh(shape, {q.origin, q.origin + q.edge_u, q.origin + q.edge_u + q.edge_v, q.origin + q.edge_v},
                 {{0, 1, 2}, {0, 2, 3}}, {});
  }
}

std::uint32_t Compiler::add_mesh(const ShapeDescription& shape, const std::vector<Vector3>& positions,
                                 const std::vector<std::array<std::uint32_t, 3>>& triangles,
                                 const std::vector<Vector3>& normals) {
  CompiledMesh mesh;
  mesh.first_vertex = static_cast<std::uint32_t>(compiled_.positions.size());
  mesh.vertex_count = static_cast<std::uint32_t>(positions.size());
  mesh.first_triangle = static_cast<std::uint32_t>(compiled_.triangles.size());
  mesh.triangle_count = static_cast<std::uint32_t>(triangles.size());
  mesh.has_normals = !normals.empty();
  mesh.flip_normal = shape.reverse_orientation != (shape.world_from_object.determinant() < 0);
  for (const Vector3& p : positions) compiled_.positions.push_back(to_float(shape.world_from_object.point(p)));
  compiled_.triangles.insert(compiled_.triangles.end(), triangles.begin(), triangles.end());
  if (mesh.has_normals) {
    compiled_.normals.resize(mesh.first_vertex);  // earlier meshes may have none
    for (const Vector3& n : normals) {
      const Vector3 world = normalize(shape.world_from_object.normal(n));
      compiled_.normals.push_back(to_float(shape.reverse_orientation ? -world : world));
    }
  }
  compiled_.meshes.push_back(mesh);
  return static_cast<std::uint32_t>(compiled_.meshes.size() - 1);
}

std::int32_t Compiler::material_index(const MaterialDescription& material) {
  const CompiledMaterial c = compile_material(material);
  const auto same = std::find(compiled_.materials.begin(), compiled_.materials.end(), c);
  if (same != compiled_.materials.end()) return static_cast<std::int32_t>(same - compiled_.materials.begin());
  compiled_.materials.push_back(c);
  return static_cast<std::int32_t>(compiled_.materials.size() - 1);
}

}  // namespace brume

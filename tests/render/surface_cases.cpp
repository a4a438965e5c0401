#include "render/surface_cases.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "compile/compile.h"

namespace brume {

namespace {

constexpr double pi = std::numbers::pi;

Vector3 around(double radius, double phi, double z) { return {radius * std::cos(phi), radius * std::sin(phi), z}; }

}  // namespace

std::vector<Surface> surfaces() {
  const auto sphere = [](double radius, double z_min, double z_max, double phi_max) {
    return [=](double u, double v) {
      const double lowest = std::acos(z_min / radius), highest = std::acos(z_max / radius);
      const double theta = lowest + v * (highest - lowest);
      return around(radius * std::sin(theta), u * phi_max, radius * std::cos(theta));
    };
  };
  const Vector3 p[4] = {{0, 0, 0}, {1, 0.2, 0.1}, {-0.1, 1, 0.3}, {1.2, 1.1, -0.8}};
  const auto patch = [p0 = p[0], p1 = p[1], p2 = p[2], p3 = p[3]](double u, double v) {
    return (1 - v) * ((1 - u) * p0 + u * p1) + v * ((1 - u) * p2 + u * p3);
  };
  const auto bilinear = BilinearMeshShape{{p[0], p[1], p[2], p[3]}, {{0, 1, 2, 3}}};
  BilinearMeshShape stretched = bilinear, flat;
  stretched.uv = {{0, 0}, {2, 0}, {0, 3}, {2, 3}};
  flat.positions = {{0, 0, 1}, {2, 0, 1}, {0, 1, 1}, {2, 1, 1}};
  flat.patches = {{0, 1, 2, 3}};
  TriangleMeshShape triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}}, {{0, 1, 2}}, {}}, mapped = triangle;
  mapped.uv = {{0, 0}, {1, 0}, {0, 1}};
  return {{"sphere", SphereShape{1.3}, sphere(1.3, -1.3, 1.3, 2 * pi)},
          {"cut_sphere", SphereShape{1.3, -0.5, 1.0, 200}, sphere(1.3, -0.5, 1.0, 200 * pi / 180)},
          {"disk", DiskShape{1.2, 0.3, 0.4, 300},
           [](double u, double v) { return around(1.2 - v * 0.8, u * 300 * pi / 180, 0.3); }},
          {"cylinder", CylinderShape{0.7, -0.5, 1.5, 250},
           [](double u, double v) { return around(0.7, u * 250 * pi / 180, -0.5 + 2 * v); }},
          {"upper_cap", CylinderShape{0.7, -0.5, 1.5, 250, true},
           [](double u, double v) { return around(0.7 * (1 - v), u * 250 * pi / 180, 1.5); }},
          {"lower_cap", CylinderShape{0.7, -0.5, 1.5, 250, true},
           [](double u, double v) { return around(0.7 * (1 - v), u * 250 * pi / 180, -0.5); }, true},
          {"quad", QuadShape{{0, 0, 0}, {2, 0, 1}, {0, 1, 0}},
           [](double u, double v) {
             return Vector3{2 * u, v, u};
           }},
          {"patch", bilinear, patch},
          {"stretched_patch", stretched, [patch](double u, double v) { return patch(u / 2, v / 3); }},
          {"flat_patch", flat,
           [](double u, double v) {
             return Vector3{2 * u, v, 1};
           }},
          {"triangle", triangle,
           [](double u, double v) {
             return Vector3{u - v, v, 0.5 * v};
           }},
          {"mapped_triangle", mapped, [](double u, double v) {
             return Vector3{u, v, 0.5 * v};
           }}};
}

std::array<double, 2> random_uv(const Surface& surface, std::mt19937& random) {
  const auto number = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
  const std::string name = surface.name;
  double u = 0.02 + 0.96 * number(), v = 0.02 + 0.96 * number();
  if (name == "stretched_patch") u *= 2, v *= 3;
  if (name == "triangle" && v > u) std::swap(u, v);
  if (name == "mapped_triangle" && u + v > 1) u = 1 - u, v = 1 - v;
  return {u, v};
}

Vector3 PlacedSurface::cross_normal(double u, double v) const {
  constexpr double step = 1e-5;
  return normalize(cross(point(u + step, v) - point(u - step, v), point(u, v + step) - point(u, v - step)));
}

PlacedSurface place_surface(const Surface& surface, int way, const MaterialDescription& material,
                            const TextureDescription& texture, const Relief& relief) {
  const Transform place = translate({0.3, -0.2, 0.5}) * rotate(40, {1, 2, 3}) * scale({1.1, 0.8, -1.3});
  const Transform instance = translate({-2, 1, 0.4}) * rotate(70, {3, 1, 2}) * scale({0.6, -1.2, 0.9});
  PlacedSurface placed{needle_scene(), surface, way == 2 ? instance * place : place};
  ShapeDescription shape;
  shape.kind = surface.shape;
  shape.world_from_object = place;
  shape.reverse_orientation = way == 1;
  shape.material = material;
  shape.relief = relief;
  SceneDescription& s = placed.scene;
  s.textures = {texture};
  if (way < 2) {
    s.shapes = {shape};
  } else {
    s.objects = {{"empty", {}}, {"other", {sphere_shape({0, 0, 0}, 1, "")}}, {"thing", {shape}}};
    s.shapes = {square_facing_z({0, 0, 50}, 1, 0.5f)};
    s.instances = {{"empty", Transform(), {}}, {"other", translate({0, 0, 70}), {}}, {"thing", instance, {}}};
    if (way == 3) s.instances[2].world_from_object = Transform();
  }
  // As in pbrt, a shape's own coordinates that mirror turn the normals of quadrics over, and leave those of meshes on
  // their side of the shape; so do instances with both.
  const bool is_mesh = std::holds_alternative<TriangleMeshShape>(surface.shape) ||
                       std::holds_alternative<BilinearMeshShape>(surface.shape) ||
                       std::holds_alternative<QuadShape>(surface.shape);
  placed.against_cross = ((surface.against_cross != (way == 1)) != (way == 2)) != is_mesh;
  return placed;
}

CompiledScene compiled(const SceneDescription& scene) {
  std::vector<Diagnostic> warnings;
  return compile(scene, 1, warnings);
}

}  // namespace brume

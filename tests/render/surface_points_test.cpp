// Places on shapes: each shape's points, surface parameters and normals, from pbrt's parametrisations, against what
// rays find there, in the world and in an instance.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "compile/compile.h"
#include "intersect/intersector.h"
#include "render/scenes.h"

namespace brume {
namespace {

constexpr double pi = std::numbers::pi;

struct Surface {
  const char* name;
  decltype(ShapeDescription::kind) shape;
  std::function<Vector3(double u, double v)> point;  // in object space
  // The normal is along dp/du x dp/dv, or against it.
  bool against_cross = false;
};

Vector3 around(double radius, double phi, double z) { return {radius * std::cos(phi), radius * std::sin(phi), z}; }

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

CompiledScene compiled(const SceneDescription& scene) {
  std::vector<Diagnostic> warnings;
  return compile(scene, 1, warnings);
}

kernel::vec3 to_float(Vector3 v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
Vector3 to_double(kernel::vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

class SurfacePoints : public ::testing::TestWithParam<Surface> {};

// Catches places and normals that are those of another parametrisation, of the space before the map, or left behind
// in the space of an instance.
TEST_P(SurfacePoints, AreFoundWithTheirParametersAndNormals) {
  const Surface& surface = GetParam();
  const bool stretched = std::string(surface.name) == "stretched_patch";
  const bool triangle = std::string(surface.name).ends_with("triangle");
  const bool is_mesh = std::holds_alternative<TriangleMeshShape>(surface.shape) ||
                       std::holds_alternative<BilinearMeshShape>(surface.shape) ||
                       std::holds_alternative<QuadShape>(surface.shape);
  std::mt19937 random(7);
  const auto number = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
  const Transform place = translate({0.3, -0.2, 0.5}) * rotate(40, {1, 2, 3}) * scale({1.1, 0.8, -1.3});
  const Transform instance = translate({-2, 1, 0.4}) * rotate(70, {3, 1, 2}) * scale({0.6, -1.2, 0.9});
  for (int way = 0; way < 4; ++way) {
    ShapeDescription shape;
    shape.kind = surface.shape;
    shape.world_from_object = place;
    shape.reverse_orientation = way == 1;
    Textured texture;
    texture.texture = 0;
    shape.material = DiffuseMaterial{texture};
    SceneDescription s = needle_scene();
    s.textures = {{"t", false, ConstantTexture{}, {}}};
    if (way < 2) {
      s.shapes = {shape};
    } else {
      s.objects = {{"empty", {}}, {"other", {sphere_shape({0, 0, 0}, 1, "")}}, {"thing", {shape}}};
      s.shapes = {square_facing_z({0, 0, 50}, 1, 0.5f)};
      s.instances = {{"empty", Transform(), {}}, {"other", translate({0, 0, 70}), {}}, {"thing", instance, {}}};
      if (way == 3) s.instances[2].world_from_object = Transform();
    }
    const Transform whole = way == 2 ? instance * place : place;
    const CompiledScene scene = compiled(s);
    const Intersector intersector(scene);
    for (int i = 0; i < 300; ++i) {
      double u = 0.02 + 0.96 * number(), v = 0.02 + 0.96 * number();
      if (stretched) u *= 2, v *= 3;
      if (triangle && std::string(surface.name) == "triangle" && v > u) std::swap(u, v);
      if (std::string(surface.name) == "mapped_triangle" && u + v > 1) u = 1 - u, v = 1 - v;
      const double step = 1e-5;
      const auto at = [&](double a, double b) { return whole.point(surface.point(a, b)); };
      const Vector3 p = at(u, v);
      const Vector3 across = cross(at(u + step, v) - at(u - step, v), at(u, v + step) - at(u, v - step));
      const Vector3 n = normalize(across);
      const Vector3 origin = p + 0.02 * n;
      SurfaceHit hit;
      ASSERT_TRUE(intersector.nearest_surface({to_float(origin), to_float(-n)}, hit)) << u << ' ' << v;
      EXPECT_NEAR(hit.t, 0.02, 2e-5);
      EXPECT_NEAR(length(to_double(hit.position) - p), 0, 2e-5);
      EXPECT_NEAR(hit.uv[0], u, 1e-4);
      EXPECT_NEAR(hit.uv[1], v, 1e-4);
      // As in pbrt, a shape's own coordinates that mirror turn the normals of quadrics over, and leave those of meshes
      // on their side of the shape; so do instances with both.
      const bool against = ((surface.against_cross != (way == 1)) != (way == 2)) != is_mesh;
      EXPECT_NEAR(dot(to_double(hit.normal), n), against ? -1 : 1, 1e-4);
      EXPECT_EQ(hit.normal.x, hit.shading_normal.x);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, SurfacePoints, ::testing::ValuesIn(surfaces()),
                         [](const auto& test) { return std::string(test.param.name); });

// Outwards means outwards: of closed shapes without any mirroring, with one, and in mirroring instances.
TEST(Normals, PointOutOfClosedShapesAlsoInMirroringInstances) {
  for (const Transform& instance : {Transform(), scale({-1, 1, 1}), rotate(30, {1, 2, 3}) * scale({1, -2, 1})})
    for (int kind = 0; kind < 3; ++kind) {
      ShapeDescription shape = box_shape({-1, -1, -1}, {1, 1, 1}, "");
      if (kind == 0) shape.kind = SphereShape{};
      if (kind == 1) shape.kind = CylinderShape{1, -1, 1, 360, true};
      shape.material = DiffuseMaterial{};
      SceneDescription s = needle_scene();
      s.objects = {{"thing", {shape}}};
      s.instances = {{"thing", instance, {}}};
      const CompiledScene scene = compiled(s);
      const Intersector intersector(scene);
      std::mt19937 random(7);
      for (int i = 0; i < 200; ++i) {
        const auto number = [&] { return static_cast<double>(random() >> 8) * 0x1p-23 - 1; };
        const Vector3 d = normalize({number(), number(), number()});
        SurfaceHit hit;
        ASSERT_TRUE(intersector.nearest_surface({{0, 0, 0}, to_float(d)}, hit));
        EXPECT_GT(dot(to_double(hit.normal), d), 0);
      }
    }
}

// With normals at its corners a patch has them interpolated, on the side that the shading normal is on.
TEST(Normals, OfPatchesAreInterpolated) {
  SceneDescription s = needle_scene();
  s.shapes.resize(1);
  BilinearMeshShape patch{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5}}, {{0, 1, 2, 3}}};
  patch.normals = {{0, 0, -1}, {0.5, 0, -1}, {0, 0.5, -1}, {1, 1, -1}};
  s.shapes[0].kind = patch;
  const CompiledScene scene = compiled(s);
  const Intersector intersector(scene);
  SurfaceHit hit;
  ASSERT_TRUE(intersector.nearest_surface({{0.25f, 0.75f, 3}, {0, 0, -1}}, hit));
  Vector3 expected;
  const double weights[4] = {0.75 * 0.25, 0.25 * 0.25, 0.75 * 0.75, 0.25 * 0.75};
  for (std::size_t i = 0; i < 4; ++i) expected = expected + weights[i] * normalize(patch.normals[i]);
  EXPECT_NEAR(length(to_double(hit.shading_normal) - normalize(expected)), 0, 1e-6);
  EXPECT_GT(dot(hit.normal, hit.shading_normal), 0);
}

}  // namespace
}  // namespace brume

// Places on shapes: each shape's points, surface parameters and normals, from pbrt's parametrisations, against what
// rays find there, in the world and in an instance.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "intersect/intersector.h"
#include "render/surface_cases.h"

namespace brume {
namespace {

class SurfacePoints : public ::testing::TestWithParam<Surface> {};

// Catches places and normals that are those of another parametrisation, of the space before the map, or left behind
// in the space of an instance.
TEST_P(SurfacePoints, AreFoundWithTheirParametersAndNormals) {
  std::mt19937 random(7);
  Textured texture;
  texture.texture = 0;
  for (int way = 0; way < surface_ways; ++way) {
    const PlacedSurface placed =
        place_surface(GetParam(), way, DiffuseMaterial{texture}, {"t", false, ConstantTexture{}, {}});
    const CompiledScene scene = compiled(placed.scene);
    const Intersector intersector(scene);
    for (int i = 0; i < 300; ++i) {
      const auto [u, v] = random_uv(GetParam(), random);
      const Vector3 p = placed.point(u, v), n = placed.cross_normal(u, v);
      SurfaceHit hit;
      ASSERT_TRUE(intersector.nearest_surface({to_float(p + 0.02 * n), to_float(-n)}, hit)) << u << ' ' << v;
      EXPECT_NEAR(hit.t, 0.02, 2e-5);
      EXPECT_NEAR(length(to_double(hit.position) - p), 0, 2e-5);
      EXPECT_NEAR(hit.uv[0], u, 1e-4);
      EXPECT_NEAR(hit.uv[1], v, 1e-4);
      EXPECT_NEAR(dot(to_double(hit.normal), n), placed.against_cross ? -1 : 1, 1e-4);
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

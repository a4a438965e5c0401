// Places on shapes: each shape's points, surface parameters and normals, from pbrt's parametrisations, against what
// rays find there, in the world and in an instance.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "intersect/intersector.h"
#include "render/surface_cases.h"
#include "render/surfaces.h"

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

// Rays that leave a plane do not meet it again, nor do shadow rays that end on it, however large it is and however it
// lies, in the world and in an instance. The fault: starts that know nothing of the size of triangles.
TEST(Planes, DoNotShadowThemselves) {
  std::mt19937 random(3);
  const auto number = [&] { return static_cast<double>(random() >> 8) * 0x1p-23 - 1; };
  int met = 0, met_by_twin = 0, ends_met = 0;
  for (const double half : {10.0, 1e2, 1e3, 1e4, 1e5})
    for (const bool in_instance : {false, true})
      for (int tilt = 0; tilt < 10; ++tilt) {
        ShapeDescription plane = square_facing_y({0, 0, 0}, half, 0.5f);
        SceneDescription s = needle_scene();
        const Transform turned = rotate(180 * number(), {number(), number(), number()});
        if (in_instance) {
          plane.world_from_object = scale({0.01, 0.01, 0.01});
          s.objects = {{"plane", {plane}}};
          s.instances = {{"plane", turned * scale({100, 100, 100}), {}}};
        } else {
          plane.world_from_object = turned;
          s.shapes = {plane};
        }
        const CompiledScene scene = compiled(s);
        const Intersector intersector(scene);
        const auto is_met = [&](const Ray& ray) {
          std::uint8_t blocked = 0;
          intersector.occluded({&ray, 1}, {&blocked, 1});
          return blocked;
        };
        for (int i = 0; i < 100; ++i) {
          // Near the middle, where the camera is and the corners are not.
          const double near = std::min(0.5 * half, 10.0);
          const Vector3 eye = turned.point({near * number(), 2 + number(), near * number()});
          const Ray ray{to_float(eye), to_float(normalize(turned.vector({0.3 * number(), -1, 0.3 * number()})))};
          SurfaceHit hit;
          ASSERT_TRUE(intersector.nearest_surface(ray, hit));
          hit = facing(hit, ray.direction);
          const kernel::vec3 p = ray.at(hit.t);
          const kernel::vec3 d = to_float(normalize(turned.vector({number(), 0.1 + std::abs(number()), number()})));
          const kernel::vec3 start = leave_towards(p, hit, d);
          met += is_met({start, d});
          ends_met += is_met({start + 3.0f * d, -d, 3});
          hit.extent = rounding_extent(p, hit.t);
          met_by_twin += is_met({leave_towards(p, hit, d), d});
        }
      }
  EXPECT_EQ(met, 0);
  EXPECT_EQ(ends_met, 0);
  EXPECT_GT(met_by_twin, 500);
}

// Those that face along an axis are met exactly: rays start as near them as from small ones. So thin layers between
// such planes stay what they are.
TEST(Planes, AlongAnAxisKeepRaysNear) {
  for (const bool in_instance : {false, true}) {
    SceneDescription s = needle_scene();
    const ShapeDescription plane = square_facing_y({0, 0, 0}, 1e6, 0.5f);
    s.shapes = {};
    if (in_instance) {
      s.objects = {{"plane", {plane}}};
      s.instances = {{"plane", rotate(30, {1, 2, 3}), {}}};
    } else {
      s.shapes = {plane};
    }
    const CompiledScene scene = compiled(s);
    const Intersector intersector(scene);
    const Transform turned = in_instance ? rotate(30, {1, 2, 3}) : Transform();
    SurfaceHit hit;
    ASSERT_TRUE(
        intersector.nearest_surface({to_float(turned.point({0.3, 2, 0.1})), to_float(turned.vector({0, -1, 0}))}, hit));
    EXPECT_LT(hit.extent, 2.5f);
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

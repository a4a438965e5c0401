// Disks and cylinders as surfaces and as boundaries of media, and spheres under maps that stretch them: chords in
// closed form. Integrator classic, whose answers here are exact. Places and normals on all shapes:
// surface_points_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compile/compile.h"
#include "intersect/intersector.h"
#include "intersect/quadric.h"
#include "render/scenes.h"

namespace brume {
namespace {

// A can of radius 0.8 from z = -1 to 1.5 in its own space, of a cylinder and two disks that face outwards.
std::vector<ShapeDescription> can(const Transform& place) {
  std::vector<ShapeDescription> shapes(3);
  shapes[0].kind = CylinderShape{0.8, -1, 1.5, 360};
  shapes[1].kind = DiskShape{0.8, 1.5, 0, 360};
  shapes[2].kind = DiskShape{0.8, -1, 0, 360};
  shapes[2].reverse_orientation = true;
  for (ShapeDescription& s : shapes) {
    s.world_from_object = place;
    s.material = InterfaceMaterial{};
    s.inside = "smoke";
  }
  return shapes;
}

// The same as one shape.
std::vector<ShapeDescription> capped_cylinder(const Transform& place) {
  std::vector<ShapeDescription> shapes = can(place);
  shapes.resize(1);
  std::get<CylinderShape>(shapes[0].kind).caps = true;
  return shapes;
}

double optical_depth(const Transform& place, Vector3 eye, bool as_one_shape) {
  SceneDescription s = needle_scene(eye);
  s.integrator.name = "classic";
  s.media = {homogeneous_medium("smoke", 0.5f, 0)};
  s.shapes = as_one_shape ? capped_cylinder(place) : can(place);
  s.lights = {sky(1)};
  return -std::log(static_cast<double>(radiance(s)));
}

// Catches boundaries that are missed, met twice, or taken the wrong way.
TEST(Shapes, ACanHoldsItsMedium) {
  for (const bool as_one_shape : {false, true}) {
    const auto depth = [&](const Transform& place, Vector3 eye) { return optical_depth(place, eye, as_one_shape); };
    EXPECT_NEAR(depth(Transform(), {0.1, 0.2, -5}), 0.5 * 2.5, 1e-5);  // through both lids
    EXPECT_NEAR(depth(Transform(), {0.1, 0.2, 0.5}), 0.5 * 1, 1e-5);   // from within
    EXPECT_NEAR(depth(Transform(), {0.1, 0.9, -5}), 0, 1e-6);          // past it
    EXPECT_NEAR(depth(rotate(90, {1, 0, 0}), {0.3, 0.2, -5}), 0.5 * 2 * std::sqrt(0.64 - 0.09), 1e-5);
    EXPECT_NEAR(depth(scale({1, 1, 2}), {0.1, 0.2, -5}), 0.5 * 5, 1e-5);
    // From the side into a lid: in through the wall at height h, out through the lid, at 45 degrees.
    EXPECT_NEAR(depth(rotate(45, {0, 1, 0}) * translate({0, 0, -1.5}), {0.3, 0, -5}),
                0.5 * std::sqrt(2.0) * (0.8 - 0.3 * std::sqrt(2.0)), 1e-5);
  }
}

// A closed box of six bilinear patches whose lid is warped: the chord ends on the lid, z = 1 + 0.5 x y - 0.2 x.
// Catches patches that rays pass between, or whose inside is their outside.
TEST(Shapes, ABoxWithAWarpedLidHoldsItsMedium) {
  BilinearMeshShape box;
  const auto lid = [](double x, double y) { return 1 + 0.5 * x * y - 0.2 * x; };
  for (const double z : {0, 1})
    for (const double y : {0, 1})
      for (const double x : {0, 1}) box.positions.push_back({x, y, z == 0 ? 0 : lid(x, y)});
  // The normal is along (u edge) x (v edge), outwards.
  box.patches = {{0, 2, 1, 3}, {4, 5, 6, 7}, {0, 1, 4, 5}, {2, 6, 3, 7}, {0, 4, 2, 6}, {1, 3, 5, 7}};
  for (const bool mirrored : {false, true}) {
    SceneDescription s = needle_scene();
    s.media = {homogeneous_medium("smoke", 0.5f, 0)};
    s.lights = {sky(1)};
    s.shapes.resize(1);
    s.shapes[0].kind = box;
    s.shapes[0].material = InterfaceMaterial{};
    s.shapes[0].inside = "smoke";
    if (mirrored) {  // from mirrored points, which turn the other way in the shape's own space
      for (Vector3& p : std::get<BilinearMeshShape>(s.shapes[0].kind).positions) p.x = -p.x;
      s.shapes[0].world_from_object = scale({-1, 1, 1});
      s.shapes[0].reverse_orientation = true;
    }
    for (int i = 0; i <= 10; ++i)
      for (int j = 0; j <= 10; ++j) {
        const double x = 0.003 + 0.0994 * i, y = 0.002 + 0.0996 * j;
        s.camera.world_from_camera = translate({x, y, -3});
        EXPECT_NEAR(-std::log(static_cast<double>(radiance(s))), 0.5 * lid(x, y), 1e-5);
      }
  }
}

TEST(Shapes, ADiskHasItsHoleAndItsSector) {
  SceneDescription s = needle_scene();
  s.integrator.name = "classic";
  s.lights = {sky(1)};
  ShapeDescription disk = square_facing_z({0, 0, 0}, 1, 0);
  disk.kind = DiskShape{1, 2, 0.5, 90};
  s.shapes = {disk};
  const auto seen = [&](double x, double y) {
    s.camera.world_from_camera = translate({x, y, 0});
    return radiance(s);
  };
  EXPECT_EQ(seen(0.5, 0.5), 0);
  EXPECT_EQ(seen(0.3, 0.3), 1);
  EXPECT_EQ(seen(0.8, 0.8), 1);
  EXPECT_EQ(seen(-0.5, 0.5), 1);
  EXPECT_EQ(seen(0.5, -0.5), 1);
}

// Random lines against random quadrics under random maps: hits lie on the surface, the normal is at right angles to it,
// and "inwards" is against the normal.
TEST(Shapes, HitsLieOnTheSurfaceAndNormalsStandOnIt) {
  std::mt19937 random(4);
  const auto number = [&] { return static_cast<double>(random() >> 8) * 0x1p-23 - 1; };
  const auto triple = [&] { return Vector3{number(), number(), number()}; };
  int found = 0;
  for (int i = 0; i < 20000; ++i) {
    CompiledQuadric q;
    q.kind = static_cast<CompiledQuadric::Kind>(i % 4);
    q.phi_max = 4;
    q.z_min = -0.6;
    q.z_max = 0.8;
    q.inner_radius = 0.2;
    q.flip_normal = i % 8 < 4;
    q.world_from_object = translate(triple()) * rotate(180 * number(), triple()) *
                          scale({0.5 + std::abs(number()), 0.5 + std::abs(number()), -0.5 - std::abs(number())});
    q.object_from_world = inverse(q.world_from_object);
    const Vector3 origin = 3 * triple(), direction = normalize(q.world_from_object.point(0.7 * triple()) - origin);
    std::array<QuadricHit, 2> hits;
    const int count = quadric_hits(q, origin, direction, hits);
    const Box3 box = quadric_bounds(q);
    for (int k = 0; k < count; ++k) {
      ++found;
      const QuadricHit& hit = hits[static_cast<std::size_t>(k)];
      const Vector3 p = origin + hit.t * direction, o = q.object_from_world.point(p);
      const bool sphere = q.kind == CompiledQuadric::Kind::sphere, disk = q.kind == CompiledQuadric::Kind::disk,
                 saddle = q.kind == CompiledQuadric::Kind::saddle;
      EXPECT_NEAR(saddle ? o.z - o.x * o.y : disk ? o.z : dot(o, o) - (sphere ? 0 : o.z * o.z) - 1, 0, 1e-9);
      EXPECT_TRUE(is_on_quadric(q, o));
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(p[axis], box.lo[axis]);
        EXPECT_LE(p[axis], box.hi[axis]);
      }
      const Vector3 normal = quadric_normal(q, o);
      EXPECT_EQ(hit.inwards, dot(normal, direction) < 0);
      // Two directions within the surface, in object space.
      const Vector3 around = saddle ? Vector3{1, 0, o.y} : disk ? Vector3{1, 0, 0} : Vector3{-o.y, o.x, 0};
      const Vector3 along = saddle   ? Vector3{0, 1, o.x}
                            : disk   ? Vector3{0, 1, 0}
                            : sphere ? cross(o, around)
                                     : Vector3{0, 0, 1};
      EXPECT_NEAR(dot(normal, normalize(q.world_from_object.vector(around))), 0, 1e-6);
      EXPECT_NEAR(dot(normal, normalize(q.world_from_object.vector(along))), 0, 1e-6);
    }
  }
  EXPECT_GT(found, 8000);
}

}  // namespace
}  // namespace brume

// Disks and cylinders as surfaces and as boundaries of media, and spheres under maps that stretch them: chords in
// closed form. Integrator classic, whose answers here are exact.
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

double optical_depth(const Transform& place, Vector3 eye) {
  SceneDescription s = needle_scene(eye);
  s.integrator.name = "classic";
  s.media = {homogeneous_medium("smoke", 0.5f, 0)};
  s.shapes = can(place);
  s.lights = {sky(1)};
  return -std::log(static_cast<double>(radiance(s)));
}

// Catches boundaries that are missed, met twice, or taken the wrong way.
TEST(Shapes, ACanHoldsItsMedium) {
  EXPECT_NEAR(optical_depth(Transform(), {0.1, 0.2, -5}), 0.5 * 2.5, 1e-5);  // through both lids
  EXPECT_NEAR(optical_depth(Transform(), {0.1, 0.2, 0.5}), 0.5 * 1, 1e-5);   // from within
  EXPECT_NEAR(optical_depth(Transform(), {0.1, 0.9, -5}), 0, 1e-6);          // past it
  EXPECT_NEAR(optical_depth(rotate(90, {1, 0, 0}), {0.3, 0.2, -5}), 0.5 * 2 * std::sqrt(0.64 - 0.09), 1e-5);
  EXPECT_NEAR(optical_depth(scale({1, 1, 2}), {0.1, 0.2, -5}), 0.5 * 5, 1e-5);
  // From the side into a lid: in through the wall at height h, out through the lid, at 45 degrees.
  EXPECT_NEAR(optical_depth(rotate(45, {0, 1, 0}) * translate({0, 0, -1.5}), {0.3, 0, -5}),
              0.5 * std::sqrt(2.0) * (0.8 - 0.3 * std::sqrt(2.0)), 1e-5);
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
    q.kind = i % 3 == 0   ? CompiledQuadric::Kind::sphere
             : i % 3 == 1 ? CompiledQuadric::Kind::disk
                          : CompiledQuadric::Kind::cylinder;
    q.phi_max = 4;
    q.inner_radius = 0.2;
    q.flip_normal = i % 2 == 0;
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
      const bool sphere = q.kind == CompiledQuadric::Kind::sphere, disk = q.kind == CompiledQuadric::Kind::disk;
      EXPECT_NEAR(disk ? o.z : dot(o, o) - (sphere ? 0 : o.z * o.z) - 1, 0, 1e-9);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(p[axis], box.lo[axis]);
        EXPECT_LE(p[axis], box.hi[axis]);
      }
      const kernel::vec3 n = quadric_normal(q, p);
      const Vector3 normal{static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z)};
      EXPECT_EQ(hit.inwards, dot(normal, direction) < 0);
      // Two directions within the surface, in object space.
      const Vector3 around = disk ? Vector3{1, 0, 0} : Vector3{-o.y, o.x, 0};
      const Vector3 along = disk ? Vector3{0, 1, 0} : sphere ? cross(o, around) : Vector3{0, 0, 1};
      EXPECT_NEAR(dot(normal, normalize(q.world_from_object.vector(around))), 0, 1e-6);
      EXPECT_NEAR(dot(normal, normalize(q.world_from_object.vector(along))), 0, 1e-6);
    }
  }
  EXPECT_GT(found, 8000);
}

}  // namespace
}  // namespace brume

// Numbers that rays could not be followed through are refused, each where it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/diagnostics.h"
#include "compile/compile.h"
#include "intersect/intersector.h"
#include "render/scenes.h"

namespace brume {
namespace {

using testing::HasSubstr;

// What is wrong with the scene; "" where it compiles.
std::string error_of(const SceneDescription& scene) {
  try {
    std::vector<Diagnostic> warnings;
    compile(scene, 1, warnings);
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

SceneDescription ball_scene() {
  SceneDescription s = needle_scene({0, 0, -10});
  s.lights = {sky(1)};
  s.shapes = {sphere_shape({0, 0, 0}, 1, "")};
  s.shapes[0].material = DiffuseMaterial{};
  return s;
}

SceneDescription grid_scene(double edge, float sigma) {
  SceneDescription s = needle_scene({0, 0, -10});
  s.lights = {sky(1)};
  s.media = {grid_medium("grid", {0, 0, 0}, {edge, edge, edge}, {2, 2, 2}, std::vector<float>(8, 1), sigma, 0)};
  s.shapes = {free_volume("grid")};
  return s;
}

TEST(Range, TheWorldHasAnEnd) {
  EXPECT_EQ(error_of(ball_scene()), "");
  SceneDescription far = ball_scene();
  far.camera.world_from_camera = translate({0, 0, -1e19});
  EXPECT_THAT(error_of(far), HasSubstr("the camera is at (0, 0, -1e+19); coordinates may be at most 1e+18"));
  SceneDescription large = ball_scene();
  large.shapes[0].world_from_object = scale({1e20, 1, 1});
  EXPECT_THAT(error_of(large), HasSubstr("the shape reaches from (-1e+20, -1, -1) to (1e+20, 1, 1)"));
  SceneDescription placed = ball_scene();
  placed.objects = {{"ball", placed.shapes}};
  placed.shapes.clear();
  placed.instances.emplace_back();
  placed.instances[0].object = "ball";
  EXPECT_EQ(error_of(placed), "");
  placed.instances[0].world_from_object = translate({0, 1e20, 0});
  EXPECT_THAT(error_of(placed), HasSubstr("the instance reaches from"));
}

TEST(Range, GridsFitFloats) {
  EXPECT_EQ(error_of(grid_scene(1, 1)), "");
  EXPECT_THAT(error_of(grid_scene(1e19, 1e-30f)), HasSubstr("the volume of medium \"grid\" reaches from"));
  EXPECT_THAT(error_of(grid_scene(1e-20, 1)), HasSubstr("voxels that are too small"));
  EXPECT_THAT(error_of(grid_scene(1, 1e12f)), HasSubstr("too dense: its optical depth is up to 1.73e+12"));
}

// Embree ends the program at such rays.
TEST(Range, RaysThatAreNotOfNumbersMeetNothing) {
  SceneDescription s = ball_scene();
  s.media = {homogeneous_medium("fog", 1, 0)};
  s.shapes[0].inside = "fog";
  std::vector<Diagnostic> warnings;
  const CompiledScene scene = compile(s, 1, warnings);
  const Intersector intersector(scene);
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const Ray good{{0, 0, -10}, {0, 0, 1}, far_away};
  for (const Ray& bad : {Ray{{nan, 0, -10}, {0, 0, 1}, far_away}, Ray{{0, 0, -10}, {0, 0, nan}, far_away},
                         Ray{{0, 0, -infinity}, {0, 0, 1}, far_away}, Ray{{0, 0, -10}, {0, 0, 1}, nan}}) {
    SurfaceHit hit;
    EXPECT_FALSE(intersector.nearest_surface(bad, hit));
    EXPECT_TRUE(intersector.nearest_surface(good, hit));
    const std::array rays{bad, good};
    std::array<std::uint8_t, 2> blocked{};
    intersector.occluded(rays, blocked);
    EXPECT_EQ(blocked, (std::array<std::uint8_t, 2>{0, 1}));
    std::vector<Crossing> crossings;
    intersector.crossings(rays, crossings);
    for (const Crossing& c : crossings) EXPECT_EQ(c.ray, 1);
  }
}

}  // namespace
}  // namespace brume

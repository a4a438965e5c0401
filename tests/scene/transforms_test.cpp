// Transforms against numbers worked out by hand.
#include "scene_test.h"

namespace brume {
namespace {

// Where the transform of the scene's first shape takes a point.
Vector3 placed(const std::string& directives, Vector3 p) {
  const SceneDescription scene = world_of(directives + "\nShape \"sphere\"");
  if (scene.shapes.empty()) return {};
  return scene.shapes.front().world_from_object.point(p);
}

void expect_near(Vector3 a, Vector3 b) { EXPECT_LT(length(a - b), 1e-14) << a.x << ' ' << a.y << ' ' << a.z; }

// Where the camera's frame puts a point of the world.
Vector3 seen(const std::string& directives, Vector3 p_world) {
  const SceneDescription scene = scene_of(directives + "\nCamera \"perspective\"\nWorldBegin");
  return inverse(scene.camera.world_from_camera).point(p_world);
}

TEST(Transforms, ApplyTheLastWrittenFirst) {
  expect_near(placed("Translate 1 2 3 Scale 2 2 2", {1, 1, 1}), {3, 4, 5});
  expect_near(placed("Scale 2 2 2 Translate 1 2 3", {1, 1, 1}), {4, 6, 8});
}

TEST(Transforms, RotateCounterclockwiseSeenAgainstTheAxis) {
  expect_near(placed("Rotate 90  0 0 1", {1, 0, 0}), {0, 1, 0});
  expect_near(placed("Rotate 90  0 3 0", {0, 0, 1}), {1, 0, 0});
  expect_near(placed("Rotate -90  1 0 0", {0, 1, 0}), {0, 0, -1});
  expect_near(placed("Rotate 120  1 1 1", {1, 0, 0}), {0, 1, 0});
}

TEST(Transforms, MatricesAreWrittenByColumns) {
  const std::string matrix = "[0 1 0 0  -1 0 0 0  0 0 1 0  5 6 7 1]";
  expect_near(placed("Translate 100 0 0 Transform " + matrix, {1, 2, 3}), {3, 7, 10});
  expect_near(placed("Translate 100 0 0 ConcatTransform " + matrix, {1, 2, 3}), {103, 7, 10});
  expect_near(placed("Translate 100 0 0 Identity", {1, 2, 3}), {1, 2, 3});
}

TEST(Transforms, BlocksAndNamesBringThemBack) {
  expect_near(placed("Translate 1 0 0 AttributeBegin Translate 5 5 5 AttributeEnd", {0, 0, 0}), {1, 0, 0});
  expect_near(placed("Translate 1 0 0 CoordinateSystem \"a\" Translate 5 5 5 CoordSysTransform \"a\"", {0, 0, 0}),
              {1, 0, 0});
  expect_near(placed("Translate 1 0 0 CoordSysTransform \"world\"", {0, 0, 0}), {0, 0, 0});
}

// pbrt's camera space is left-handed: looking along -z with y up, the world's +x is on the left.
TEST(Transforms, LookAtGivesALeftHandedCamera) {
  const std::string look = "LookAt 0 0 5  0 0 0  0 1 0";
  expect_near(seen(look, {0, 0, 5}), {0, 0, 0});
  expect_near(seen(look, {0, 0, 0}), {0, 0, 5});
  expect_near(seen(look, {0, 1, 0}), {0, 1, 5});
  expect_near(seen(look, {1, 0, 0}), {-1, 0, 5});
  expect_near(seen("Scale -1 1 1 " + look, {1, 0, 0}), {1, 0, 5});
}

TEST(Transforms, TheCameraIsPlacedByTheInverse) {
  const SceneDescription scene = scene_of(
      "Translate 1 2 3 Camera \"perspective\" WorldBegin CoordSysTransform \"camera\" "
      "Shape \"sphere\"");
  expect_near(scene.camera.world_from_camera.point({0, 0, 0}), {-1, -2, -3});
  expect_near(scene.shapes.at(0).world_from_object.point({0, 0, 0}), {-1, -2, -3});
}

TEST(Transforms, WorldBeginStartsFromTheIdentity) {
  const SceneDescription scene = scene_of("Translate 1 2 3 WorldBegin Shape \"sphere\"");
  EXPECT_EQ(scene.shapes.at(0).world_from_object, Transform());
}

// What is there when the shutter opens counts: what ends with EndTime moves nothing, and its block brings All back.
TEST(Transforms, OfTheEndMoveNothing) {
  std::vector<Diagnostic> warnings;
  const SceneDescription scene = scene_of(
      "WorldBegin Translate 1 0 0 AttributeBegin ActiveTransform EndTime Translate 5 0 0 Identity Shape \"sphere\" "
      "ActiveTransform StartTime Translate 0 2 0 Shape \"sphere\" ActiveTransform EndTime AttributeEnd "
      "Translate 0 0 3 Shape \"sphere\"",
      &warnings);
  EXPECT_EQ(warnings.size(), 1u);
  expect_near(scene.shapes.at(0).world_from_object.point({0, 0, 0}), {1, 0, 0});
  expect_near(scene.shapes.at(1).world_from_object.point({0, 0, 0}), {1, 2, 0});
  expect_near(scene.shapes.at(2).world_from_object.point({0, 0, 0}), {1, 0, 3});
}

TEST(Transforms, PlaceLights) {
  const SceneDescription scene = world_of(
      "Translate 1 0 0 Rotate 90 0 0 1 LightSource \"point\" \"point3 from\" [1 0 0]\n"
      "LightSource \"distant\" \"point3 from\" [3 0 0] \"point3 to\" [1 0 0]\n"
      "LightSource \"distant\"");
  expect_near(std::get<PointLight>(scene.lights.at(0).kind).from, {1, 1, 0});
  expect_near(std::get<DistantLight>(scene.lights.at(1).kind).direction_to_light, {0, 1, 0});
  expect_near(std::get<DistantLight>(scene.lights.at(2).kind).direction_to_light, {0, 0, -1});
}

TEST(Transforms, PlaceMediaAtTheirDirective) {
  const SceneDescription scene = world_of(
      "AttributeBegin Translate 0 7 0 MakeNamedMedium \"m\" \"string type\" \"procedural\" AttributeEnd\n"
      "MediumInterface \"m\" \"\" Shape \"volume\"");
  expect_near(scene.media.at(0).world_from_medium.point({0, 0, 0}), {0, 7, 0});
  EXPECT_EQ(scene.shapes.at(0).world_from_object, Transform());
}

}  // namespace
}  // namespace brume

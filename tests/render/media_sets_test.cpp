// Which media are where: the rule of sets, by the transmittance of absorbers, which is known.
#include <gtest/gtest.h>

#include <cmath>

#include "compile/compile.h"
#include "render/agreement_scenes.h"
#include "render/backend.h"

namespace brume {
namespace {

// A view along +z of a sky of radiance 1; the optical depth that it shows.
SceneDescription view(std::vector<MediumDescription> media, std::vector<ShapeDescription> shapes) {
  SceneDescription s = needle_scene({0.05, 0.02, -10});
  s.lights = {sky(1)};
  s.media = std::move(media);
  s.shapes = std::move(shapes);
  return s;
}
float optical_depth(const SceneDescription& scene) { return -std::log(radiance(scene)); }

const Vector3 lo{-1, -1, 0}, hi{1, 1, 2};

TEST(MediaSets, OverlappingShapesAddUp) {
  const auto a = homogeneous_medium("a", 0.3f, 0), b = homogeneous_medium("b", 0.2f, 0);
  EXPECT_NEAR(
      optical_depth(view({a, b}, {box_shape({-1, -1, 0}, {1, 1, 2}, "a"), box_shape({-1, -1, 1}, {1, 1, 4}, "b")})),
      2 * 0.3 + 3 * 0.2, 1e-5);
  // One medium in two overlapping shapes is there twice over.
  EXPECT_NEAR(
      optical_depth(view({a}, {box_shape({-1, -1, 0}, {1, 1, 2}, "a"), box_shape({-1, -1, 1}, {1, 1, 4}, "a")})),
      5 * 0.3, 1e-5);
}

TEST(MediaSets, ABallWithOutsideFogDisplacesTheFog) {
  const auto fog = homogeneous_medium("fog", 0.3f, 0), ball = homogeneous_medium("ball", 0.1f, 0);
  SceneDescription s =
      view({fog, ball}, {box_shape({-2, -2, 0}, {2, 2, 4}, "fog"), box_shape({-1, -1, 1}, {1, 1, 2}, "ball", "fog")});
  EXPECT_NEAR(optical_depth(s), 3 * 0.3 + 1 * 0.1, 1e-5);
  // The same where the ball sticks out of the fog at the near side: there is no fog there to displace, and none
  // appears.
  s.shapes[1] = box_shape({-1, -1, -1}, {1, 1, 1}, "ball", "fog");
  EXPECT_NEAR(optical_depth(s), 3 * 0.3 + 2 * 0.1, 1e-5);
  // An empty bubble in fog.
  s.shapes[1] = box_shape({-1, -1, 1}, {1, 1, 2}, "", "fog");
  EXPECT_NEAR(optical_depth(s), 3 * 0.3, 1e-5);
}

TEST(MediaSets, ReversedOrientationSwapsTheSides) {
  const auto fog = homogeneous_medium("fog", 0.3f, 0);
  ShapeDescription box = box_shape(lo, hi, "", "fog");
  box.reverse_orientation = true;
  EXPECT_NEAR(optical_depth(view({fog}, {box})), 2 * 0.3, 1e-5);
  ShapeDescription sphere = sphere_shape({0.05, 0.02, 0}, 1, "", "fog");
  sphere.reverse_orientation = true;
  EXPECT_NEAR(optical_depth(view({fog}, {sphere})), 2 * 0.3, 1e-5);
  // A mirroring transform keeps the inside inside.
  ShapeDescription mirrored = box_shape(lo, hi, "fog");
  mirrored.world_from_object = scale({-1, 1, 1});
  EXPECT_NEAR(optical_depth(view({fog}, {mirrored})), 2 * 0.3, 1e-5);
}

TEST(MediaSets, AShapeWithOneMediumOnBothSidesChangesNothing) {
  const auto fog = homogeneous_medium("fog", 0.3f, 0);
  EXPECT_NEAR(optical_depth(view({fog}, {box_shape(lo, hi, "fog"), sphere_shape({0, 0, 1}, 0.5, "fog", "fog")})),
              2 * 0.3, 1e-5);
}

TEST(MediaSets, TheCameraInsideIsFound) {
  const auto fog = homogeneous_medium("fog", 0.3f, 0);
  SceneDescription s = view({fog}, {box_shape({-20, -20, -20}, {20, 20, 2}, "fog")});
  EXPECT_NEAR(optical_depth(s), 12 * 0.3, 1e-4);
  // What the Camera directive records is the same fog, not more of it.
  s.camera.medium = "fog";
  EXPECT_NEAR(optical_depth(s), 12 * 0.3, 1e-4);
}

TEST(MediaSets, AMediumThatOnlyTheCameraRecordsIsEverywhere) {
  SceneDescription s = view({homogeneous_medium("fog", 0.3f, 0)}, {square_facing_z({0, 0, 0}, 1, 0.5f)});
  s.camera.medium = "fog";
  s.lights = {point_light({0.05, 0.02, -1}, 1)};
  // Light goes 1 unit through the fog, then 10 back to the camera.
  EXPECT_NEAR(radiance(s), 0.5 / 3.14159265 * std::exp(-11 * 0.3), 2e-5 * 0.01);
}

// As scenes have it that name the fog for the camera: what comes later inherits the interface.
TEST(MediaSets, OpaqueSurfacesThatInheritTheFogLeaveItAsItIs) {
  SceneDescription s = view({homogeneous_medium("fog", 0.3f, 0)}, {square_facing_z({0, 0, 0}, 1, 0.5f)});
  s.camera.medium = "fog";
  s.lights = {point_light({0.05, 0.02, -1}, 1)};
  const double expected = 0.5 / 3.14159265 * std::exp(-11 * 0.3);
  s.shapes[0].outside = "fog";
  EXPECT_NEAR(radiance(s), expected, 2e-5 * 0.01);
  s.shapes[0].reverse_orientation = true;
  EXPECT_NEAR(radiance(s), expected, 2e-5 * 0.01);
  s.shapes.push_back(sphere_shape({0, 0, 3}, 1, "", "fog"));
  s.shapes.back().material = s.shapes[0].material;
  EXPECT_NEAR(radiance(s), expected, 2e-5 * 0.01);
  // The twin: were the square a boundary, as one is that light passes, the fog before it would be there twice.
  s.shapes.push_back(s.shapes[0]);
  s.shapes.back().material = InterfaceMaterial{};
  s.shapes.back().world_from_object = translate({0, 0, 1}) * s.shapes.back().world_from_object;
  s.shapes.back().reverse_orientation = false;
  EXPECT_GT(std::abs(radiance(s) - expected), 0.5 * expected);
}

TEST(MediaSets, WhatLiesOutsideOfTheShapeThatTheCameraIsInIsEverywhereElse) {
  const auto thin = homogeneous_medium("thin", 0.1f, 0), fog = homogeneous_medium("fog", 0.3f, 0);
  // The camera stands at z = -10: 2 units of the thin medium, then 10 of fog to a floor.
  SceneDescription s = view({thin, fog}, {sphere_shape({0, 0, -10}, 2, "thin", "fog")});
  s.shapes.push_back(square_facing_z({0, 0, 2}, 1, 0.5f));
  s.camera.medium = "thin";
  s.lights = {point_light({0.05, 0.02, 1}, 1)};
  EXPECT_NEAR(radiance(s), 0.5 / 3.14159265 * std::exp(-2 * 0.1 - 11 * 0.3), 2e-5 * 0.05);
}

TEST(MediaSets, FreeVolumesAddToAll) {
  const auto fog = homogeneous_medium("fog", 0.3f, 0);
  auto grid = grid_medium("grid", {-1, -1, 1}, {1, 1, 3}, {2, 2, 2}, std::vector<float>(8, 1), 0.2f, 0);
  grid.linear_interpolation = false;
  EXPECT_NEAR(optical_depth(view({fog, grid}, {box_shape(lo, hi, "fog"), free_volume("grid")})), 2 * 0.3 + 2 * 0.2,
              1e-5);
  // Two copies at half the density are the grid.
  auto half = grid;
  half.sigma_a = constant_spectrum(0.1f);
  EXPECT_NEAR(optical_depth(view({half}, {free_volume("grid"), free_volume("grid")})), 2 * 0.2, 1e-5);
  // From the inside: a camera in the middle of the grid sees half of it.
  SceneDescription inside = view({grid}, {free_volume("grid")});
  inside.camera.world_from_camera = translate({0.05, 0.02, 2});
  EXPECT_NEAR(optical_depth(inside), 1 * 0.2, 1e-5);
}

TEST(MediaSets, AFloorInThePlaneOfTheBoundaryIsLitThroughTheMedium) {
  // The floor coincides with the bottom of the box: rounding decides on which side a ray from it starts, and must not
  // matter.
  SceneDescription s = needle_scene();
  s.camera.world_from_camera = translate({0.1, 5, 0.2}) * rotate(90, {1, 0, 0});
  s.media = {homogeneous_medium("fog", 0.4f, 0)};
  s.shapes = {box_shape({-1, 0, -1}, {1, 1, 1}, "fog"), square_facing_y({0, 0, 0}, 3, 1)};
  s.lights = {distant_light({0, 1, 0}, 1)};
  EXPECT_NEAR(radiance(s), std::exp(-0.8) / 3.14159265, 1e-5);
}

TEST(MediaSets, RaysAlongTheEdgesOfAMeshKeepTheirCount) {
  // Straight at the diagonals and edges that triangles share: every pixel of a row across them shows the box's own
  // depth.
  SceneDescription s = view({homogeneous_medium("fog", 0.3f, 0)}, {box_shape(lo, hi, "fog")});
  for (const double x : {0.0, 0.25, -0.5, 0.75})
    for (const double y : {0.0, 0.25, -0.25, x, -x}) {
      s.camera.world_from_camera = translate({x, y, -3});
      s.camera.fov = 1e-9;
      EXPECT_NEAR(optical_depth(s), 2 * 0.3, 1e-4) << x << " " << y;
    }
}

bool has_open_boundary(const SceneDescription& scene) {
  std::vector<Diagnostic> warnings;
  const CompiledScene compiled = compile(scene, 1, warnings);
  const std::unique_ptr<Backend> backend = make_cpu_backend();
  backend->prepare(compiled);
  return backend->open_boundary().has_value();
}

TEST(MediaSets, OpenBoundariesAreFound) {
  const auto fog = homogeneous_medium("fog", 0.3f, 0);
  ShapeDescription water = square_facing_z({0, 0, 0}, 3, 0);
  water.material = DielectricMaterial{};
  water.inside = "fog";
  EXPECT_TRUE(has_open_boundary(view({fog}, {water})));
  ShapeDescription can = sphere_shape({0, 0, 0}, 1, "fog");
  can.kind = CylinderShape{};
  EXPECT_TRUE(has_open_boundary(view({fog}, {can})));
  std::get<CylinderShape>(can.kind).caps = true;
  EXPECT_FALSE(has_open_boundary(view({fog}, {can})));
  std::get<CylinderShape>(can.kind).phi_max = 200;
  EXPECT_TRUE(has_open_boundary(view({fog}, {can})));
  SceneDescription placed = view({fog}, {});
  placed.objects = {{"can", {can}}};
  placed.instances.emplace_back();
  placed.instances[0].object = "can";
  placed.instances[0].world_from_object = translate({0, 5, 0});
  EXPECT_TRUE(has_open_boundary(placed));
  ShapeDescription box = box_shape(lo, hi, "fog");
  box.material = DielectricMaterial{};
  EXPECT_FALSE(has_open_boundary(view({fog}, {box})));
  std::get<TriangleMeshShape>(box.kind).triangles.pop_back();
  EXPECT_TRUE(has_open_boundary(view({fog}, {box})));
}

TEST(MediaSets, NoOpenBoundaryIsFoundWhereNoneIs) {
  for (auto& [name, scene] : agreement_scenes()) {
    SceneDescription unlit = scene;
    unlit.lights = {sky(1)};  // those of the scenes name pictures
    EXPECT_FALSE(has_open_boundary(unlit)) << name;
  }
}

// What counts is how many there are at one place.
TEST(MediaSets, ManyMediaAfterManyOthersAreFew) {
  std::vector<MediumDescription> media;
  std::vector<ShapeDescription> shapes;
  for (int i = 0; i < 12; ++i) {
    const std::string around = "around" + std::to_string(i), ahead = "ahead" + std::to_string(i);
    media.push_back(homogeneous_medium(around, 0.01f, 0));
    media.push_back(homogeneous_medium(ahead, 0.01f, 0));
    ShapeDescription near_ball = sphere_shape({0, 0, -10}, 1 + 0.1 * i, around);
    ShapeDescription far_ball = sphere_shape({0, 0, 0}, 1 + 0.1 * i, ahead);
    shapes.push_back(near_ball);
    shapes.push_back(far_ball);
  }
  double expected = 0;
  for (int i = 0; i < 12; ++i) expected += 0.01 * (1 + 0.1 * i) * 3;
  EXPECT_NEAR(optical_depth(view(media, shapes)), expected, 0.01 * expected);
}

TEST(MediaSets, MoreThanSixteenMediaAreAnError) {
  std::vector<MediumDescription> media;
  std::vector<ShapeDescription> shapes;
  for (int i = 0; i < 17; ++i) {
    const std::string name = std::to_string(i);
    media.push_back(homogeneous_medium(name, 0.01f, 0));
    shapes.push_back(box_shape({-1, -1, -0.01 * i}, {1, 1, 2}, name));
  }
  EXPECT_THROW(radiance(view(media, shapes)), InputError);
  media.pop_back();
  shapes.pop_back();
  EXPECT_GT(radiance(view(media, shapes)), 0);
}

}  // namespace
}  // namespace brume

// Which shapes become regions that rays meet by arithmetic, and that it makes no difference to what is seen.
#include <gtest/gtest.h>

#include <cmath>

#include "compile/compile.h"
#include "compile/triangles_apart.h"
#include "render/scenes.h"

namespace brume {
namespace {

// A view along +z of a sky of radiance 1 through an absorber.
SceneDescription view(ShapeDescription shape) {
  SceneDescription s = needle_scene({0.15, 0.12, -10});
  s.lights = {sky(1)};
  s.media = {homogeneous_medium("fog", 0.3f, 0)};
  s.shapes = {std::move(shape)};
  return s;
}

std::size_t volumes(const SceneDescription& scene) {
  std::vector<Diagnostic> warnings;
  return compile(scene, 1, warnings).volumes.size();
}

ShapeDescription box() { return box_shape({-1, -1, 0}, {1, 1, 2}, "fog"); }
TriangleMeshShape& mesh_of(ShapeDescription& shape) { return std::get<TriangleMeshShape>(shape.kind); }

TEST(Regions, ClosedBoxesBecomeVolumes) {
  EXPECT_EQ(volumes(view(box())), 1u);
  ShapeDescription turned = box();
  turned.world_from_object = translate({0.3, 0.1, 2}) * rotate(35, {1, 2, 3}) * scale({2, 1, 0.5});
  EXPECT_EQ(volumes(view(turned)), 1u);
  ShapeDescription mirrored = box();
  mirrored.world_from_object = scale({-1, 1, 1});
  EXPECT_EQ(volumes(view(mirrored)), 1u);
  // Its inside is what is outside, and the other way round.
  ShapeDescription reversed = box();
  reversed.reverse_orientation = true;
  for (auto& t : mesh_of(reversed).triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(volumes(view(reversed)), 1u);
  ShapeDescription apart = box();
  mesh_of(apart) = triangles_apart(mesh_of(apart));
  EXPECT_EQ(volumes(view(apart)), 1u);
}

TEST(Regions, OthersDoNot) {
  ShapeDescription flipped = box();
  for (auto& t : mesh_of(flipped).triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(volumes(view(flipped)), 0u);
  ShapeDescription one_flipped = box();
  std::swap(mesh_of(one_flipped).triangles[3][1], mesh_of(one_flipped).triangles[3][2]);
  EXPECT_EQ(volumes(view(one_flipped)), 0u);
  ShapeDescription open = box();
  mesh_of(open).triangles.pop_back();
  EXPECT_EQ(volumes(view(open)), 0u);
  ShapeDescription twice = box();  // one triangle twice, another missing
  mesh_of(twice).triangles[11] = mesh_of(twice).triangles[10];
  EXPECT_EQ(volumes(view(twice)), 0u);
  ShapeDescription bent = box();
  mesh_of(bent).positions[7] = {1.2, 1, 2};
  EXPECT_EQ(volumes(view(bent)), 0u);
  ShapeDescription wall = box();
  wall.material = DiffuseMaterial{};
  EXPECT_EQ(volumes(view(wall)), 0u);
  ShapeDescription displacing = box();
  displacing.outside = "fog";
  displacing.inside = "";
  EXPECT_EQ(volumes(view(displacing)), 0u);
  ShapeDescription inside_out = sphere_shape({0, 0, 0}, 1, "fog");
  inside_out.reverse_orientation = true;
  EXPECT_EQ(volumes(view(inside_out)), 0u);
}

// A second shape of the medium, out of sight, that is no region keeps all of the medium's shapes what they are.
ShapeDescription no_region() {
  ShapeDescription shape = box_shape({-1, 50, 0}, {1, 52, 2}, "fog");
  mesh_of(shape).positions[7].x += 0.5;
  return shape;
}

TEST(Regions, SpheresBecomeBalls) {
  ShapeDescription sphere = sphere_shape({0, 0, 0}, 1, "fog");
  EXPECT_EQ(volumes(view(sphere)), 1u);
  sphere.world_from_object = rotate(20, {1, 2, 3}) * scale({1, 2, 0.3});
  EXPECT_EQ(volumes(view(sphere)), 1u);
  SceneDescription s = view(sphere);
  s.shapes.push_back(no_region());
  EXPECT_EQ(volumes(s), 0u);
  // A grid is a box still, where the sphere holds all of it.
  s.media = {grid_medium("fog", {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, {2, 2, 2}, std::vector<float>(8, 1), 0.3f, 0)};
  s.shapes = {sphere_shape({0, 0, 0}, 0.9, "fog")};
  EXPECT_EQ(volumes(s), 1u);
  s.shapes = {sphere_shape({0, 0, 0}, 0.8, "fog")};
  EXPECT_EQ(volumes(s), 0u);
}

TEST(Regions, MayHaveOneHole) {
  SceneDescription s = view(box());
  s.media.push_back(homogeneous_medium("ball", 0.1f, 0));
  s.shapes.push_back(sphere_shape({0, 0, 1}, 0.5, "ball", "fog"));
  EXPECT_EQ(volumes(s), 2u);
  s.shapes[1].inside = "";
  EXPECT_EQ(volumes(s), 1u);
  s.shapes.push_back(sphere_shape({0, 0, 1}, 0.2, "ball", "fog"));
  EXPECT_EQ(volumes(s), 0u);
  // Two regions of one medium are two volumes, but no hole can be cut into both.
  s.shapes = {box(), box_shape({-1, -1, 5}, {1, 1, 7}, "fog")};
  EXPECT_EQ(volumes(s), 2u);
  s.shapes.push_back(sphere_shape({0, 0, 1}, 0.5, "", "fog"));
  EXPECT_EQ(volumes(s), 0u);
  // A medium that is not arithmetic takes its neighbours along.
  s.shapes = {box(), sphere_shape({0, 0, 1}, 0.5, "ball", "fog"), no_region()};
  EXPECT_EQ(volumes(s), 0u);
  // There, the camera would have the fog that the ball displaces around it.
  s.shapes = {box(), sphere_shape({0, 0, -10}, 11, "ball", "fog")};
  EXPECT_EQ(volumes(s), 0u);
}

TEST(Regions, OfGridsAreCutAlongTheGridsAxes) {
  SceneDescription s = view(box());
  s.media = {grid_medium("fog", {-1, -1, 0}, {1, 1, 2}, {4, 4, 4}, std::vector<float>(64, 1), 0.3f, 0)};
  EXPECT_EQ(volumes(s), 1u);
  s.shapes = {box_shape({-5, -5, -5}, {0.5, 5, 1}, "fog")};
  std::vector<Diagnostic> warnings;
  const CompiledScene c = compile(s, 1, warnings);
  ASSERT_EQ(c.volumes.size(), 1u);
  EXPECT_NEAR(c.volumes[0].region.hi[0], 3, 1e-5);
  EXPECT_NEAR(c.volumes[0].region.hi[1], 4, 1e-5);
  EXPECT_NEAR(c.volumes[0].region.hi[2], 2, 1e-5);
  EXPECT_NEAR(c.volumes[0].region.lo[0], 0, 1e-5);
  // A turned box holds the grid whole, or it stays a mesh.
  s.shapes = {box_shape({-5, -5, -5}, {5, 5, 5}, "fog")};
  s.shapes[0].world_from_object = rotate(30, {1, 2, 3});
  EXPECT_EQ(volumes(s), 1u);
  s.shapes = {box_shape({-0.5, -0.5, 0.5}, {0.5, 0.5, 1.5}, "fog")};
  s.shapes[0].world_from_object = rotate(30, {0, 0, 1});
  EXPECT_EQ(volumes(s), 0u);
  // Beside the grid there is nothing.
  s.shapes = {box_shape({3, 3, 3}, {4, 4, 4}, "fog")};
  EXPECT_EQ(volumes(s), 0u);
  EXPECT_EQ(radiance(s), 1);
}

// A box as a mesh, with a thirteenth triangle that has no area.
ShapeDescription as_mesh(ShapeDescription shape) {
  TriangleMeshShape& mesh = mesh_of(shape);
  mesh.positions.push_back(mesh.positions[0]);
  mesh.triangles.push_back({0, 1, static_cast<std::uint32_t>(mesh.positions.size() - 1)});
  return shape;
}

// The largest difference between two pictures of what is seen along rays in all directions.
double difference(const SceneDescription& a, const SceneDescription& b) {
  const auto first = render_film(a, 1).image().pixels, second = render_film(b, 1).image().pixels;
  double worst = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    worst = std::max(worst, static_cast<double>(std::abs(first[i] - second[i])));
  return worst;
}

// The same radiance with the camera outside and inside of volumes and of what they stand for; twins of 1 % more are
// found.
void expect_same(SceneDescription volumes_alone, SceneDescription shapes) {
  for (const double z : {-10.0, 0.7}) {
    for (SceneDescription* s : {&volumes_alone, &shapes}) {
      s->film.width = s->film.height = 24;
      s->integrator.traversal = Traversal::dda;
      s->camera.fov = z < 0 ? 20 : 100;
      s->camera.world_from_camera = translate({0.15, 0.12, z});
    }
    ASSERT_GT(volumes(volumes_alone), 0u);
    ASSERT_EQ(volumes(shapes), 0u);
    EXPECT_LT(difference(volumes_alone, shapes), 2e-5) << z;
    SceneDescription larger = volumes_alone;
    larger.media[0].sigma_a = 1.01f * larger.media[0].sigma_a;
    EXPECT_GT(difference(volumes_alone, larger), 1e-3) << z;
  }
}

TEST(Regions, BoxesLookAsTheirMeshes) {
  for (const bool has_grid : {false, true})
    for (const double angle : {0.0, 35.0}) {
      ShapeDescription shape = box();
      shape.world_from_object = rotate(angle, {1, 2, 3});
      SceneDescription a = view(shape);
      if (has_grid)
        a.media = {
            grid_medium("fog", {-0.2, -0.4, 0.7}, {0.6, 0.4, 1.3}, {2, 2, 2}, {1, 2, 3, 4, 5, 6, 7, 8}, 0.1f, 0)};
      SceneDescription b = a;
      b.shapes = {as_mesh(shape)};
      expect_same(a, b);
    }
}

// A ball, a grid or a box with a ball in it that displaces it, or sticks out of it, and that has a bubble.
TEST(Regions, LookAsTheirBoundaries) {
  for (const bool has_grid : {false, true})
    for (const double x : {0.1, 0.8}) {
      SceneDescription s = view(box());
      if (has_grid)
        s.media = {grid_medium("fog", {-1, -1, 0}, {1, 1, 2}, {2, 2, 2}, {1, 2, 3, 4, 5, 6, 7, 8}, 0.1f, 0)};
      s.media.push_back(homogeneous_medium("ball", 0.7f, 0));
      ShapeDescription ball = sphere_shape({0, 0, 0}, 1, "ball", "fog");
      ball.world_from_object = translate({x, -0.1, 1.2}) * rotate(30, {1, 2, 3}) * scale({0.6, 0.5, 0.4});
      s.shapes.push_back(ball);
      s.shapes.push_back(sphere_shape({x, 0, 1.2}, 0.2, "", "ball"));
      SceneDescription with_shapes = s;
      with_shapes.shapes.push_back(no_region());
      expect_same(s, with_shapes);
    }
}

}  // namespace
}  // namespace brume

// Which meshes become boxes that rays meet by arithmetic, and that it makes no difference to what is seen.
#include <gtest/gtest.h>

#include <cmath>

#include "compile/compile.h"
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

TEST(Boxes, ClosedBoxesBecomeVolumes) {
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
  // Vertices of their own for each triangle.
  ShapeDescription apart = box();
  TriangleMeshShape soup;
  for (const auto& t : mesh_of(apart).triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : t) soup.positions.push_back(mesh_of(apart).positions[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  mesh_of(apart) = soup;
  EXPECT_EQ(volumes(view(apart)), 1u);
}

TEST(Boxes, OthersDoNot) {
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
  EXPECT_EQ(volumes(view(sphere_shape({0, 0, 0}, 1, "fog"))), 0u);
}

TEST(Boxes, OfGridsAreCutAlongTheGridsAxes) {
  SceneDescription s = view(box());
  s.media = {grid_medium("fog", {-1, -1, 0}, {1, 1, 2}, {4, 4, 4}, std::vector<float>(64, 1), 0.3f, 0)};
  EXPECT_EQ(volumes(s), 1u);
  s.shapes = {box_shape({-5, -5, -5}, {0.5, 5, 1}, "fog")};
  std::vector<Diagnostic> warnings;
  const CompiledScene c = compile(s, 1, warnings);
  ASSERT_EQ(c.volumes.size(), 1u);
  EXPECT_NEAR(c.volumes[0].hi[0], 3, 1e-5);
  EXPECT_NEAR(c.volumes[0].hi[1], 4, 1e-5);
  EXPECT_NEAR(c.volumes[0].hi[2], 2, 1e-5);
  EXPECT_NEAR(c.volumes[0].lo[0], 0, 1e-5);
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

// The same radiance along rays in all directions, with the camera outside and inside; the twin is 1 % larger.
TEST(Boxes, LookAsTheirMeshes) {
  for (const bool has_grid : {false, true})
    for (const double angle : {0.0, 35.0}) {
      ShapeDescription shape = box();
      shape.world_from_object = rotate(angle, {1, 2, 3});
      SceneDescription a = view(shape);
      a.film.width = a.film.height = 24;
      a.integrator.traversal = Traversal::dda;
      if (has_grid)
        a.media = {
            grid_medium("fog", {-0.2, -0.4, 0.7}, {0.6, 0.4, 1.3}, {2, 2, 2}, {1, 2, 3, 4, 5, 6, 7, 8}, 0.1f, 0)};
      SceneDescription b = a;
      b.shapes = {as_mesh(shape)};
      ASSERT_EQ(volumes(a), 1u);
      ASSERT_EQ(volumes(b), 0u);
      for (const double z : {-10.0, 0.7}) {
        a.camera.fov = b.camera.fov = z < 0 ? 20 : 100;
        a.camera.world_from_camera = b.camera.world_from_camera = translate({0.15, 0.12, z});
        SceneDescription larger = a;
        larger.media[0].sigma_a = 1.01f * a.media[0].sigma_a;
        const auto first = render_film(a, 1).image().pixels, second = render_film(b, 1).image().pixels,
                   third = render_film(larger, 1).image().pixels;
        double worst = 0, twin = 0;
        for (std::size_t i = 0; i < first.size(); ++i) {
          worst = std::max(worst, static_cast<double>(std::abs(first[i] - second[i])));
          twin = std::max(twin, static_cast<double>(std::abs(first[i] - third[i])));
        }
        EXPECT_LT(worst, 2e-5) << has_grid << " " << angle << " " << z;
        EXPECT_GT(twin, 1e-3);
      }
    }
}

}  // namespace
}  // namespace brume

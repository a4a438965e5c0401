// Displacement: how triangles are split, how vertices move, and what is seen of it.
#include "compile/displace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "compile/compile.h"
#include "image/image.h"
#include "image/temporary_folder.h"
#include "intersect/intersector.h"
#include "render/scenes.h"
#include "scene/read_scene.h"

namespace brume {
namespace {

using Uv = std::array<double, 2>;

constexpr std::size_t plenty = 1000000;

// The square [0, 2]^2 at z = 0, facing +z, with u along x and v along y.
TriangleMeshShape square() {
  return {{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
}

// Closed, its corners shared, normals outwards.
TriangleMeshShape octahedron() {
  TriangleMeshShape mesh;
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  mesh.uv.assign(6, {});
  return mesh;
}

double nothing(Vector3, const Uv&) { return 0; }

// How often each directed edge occurs.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed_edges(const TriangleMeshShape& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  return edges;
}

double longest_edge(const TriangleMeshShape& mesh, const Transform& world_from_object) {
  double longest = 0;
  for (const auto& [edge, count] : directed_edges(mesh))
    longest =
        std::max(longest, length(world_from_object.vector(mesh.positions[edge.second] - mesh.positions[edge.first])));
  return longest;
}

double area(const TriangleMeshShape& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 * length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
  return sum;
}

TEST(Displacement, EdgesAreShortInTheWorld) {
  for (const Transform& place : {Transform(), rotate(40, {1, 2, 3}) * scale({5, 0.2, 1})})
    for (const double edge_length : {10.0, 1.0, 0.11}) {
      const auto mesh = displaced(octahedron(), place, edge_length, nothing, plenty);
      ASSERT_TRUE(mesh);
      EXPECT_LE(longest_edge(*mesh, place), edge_length);
      // No more is split than has to be: halves of an edge that was too long are longer than half the length.
      EXPECT_GT(2.1 * longest_edge(*mesh, place), std::min(edge_length, longest_edge(octahedron(), place)));
      EXPECT_NEAR(area(*mesh), area(octahedron()), 1e-10);
    }
  EXPECT_EQ(displaced(square(), Transform(), 3, nothing, plenty)->triangles.size(), 2u);
}

// Every edge has a triangle on both of its sides, whatever is split first. The twin's triangles do not share corners.
TEST(Displacement, SharedEdgesDoNotCrack) {
  const auto closed = [](const TriangleMeshShape& mesh) {
    const auto edges = directed_edges(mesh);
    for (const auto& [edge, count] : edges)
      if (count != 1 || !edges.contains({edge.second, edge.first})) return false;
    return true;
  };
  const Transform place = rotate(70, {3, 1, 2}) * scale({3, 1, 0.3});
  const auto bumpy = [](Vector3 p, const Uv&) { return 0.1 * std::sin(20 * p.x) * std::cos(17 * p.y + p.z); };
  EXPECT_TRUE(closed(*displaced(octahedron(), place, 0.17, bumpy, plenty)));
  TriangleMeshShape apart;
  for (const auto& t : octahedron().triangles) {
    const auto first = static_cast<std::uint32_t>(apart.positions.size());
    for (const std::uint32_t corner : t) apart.positions.push_back(octahedron().positions[corner]);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  apart.uv.assign(apart.positions.size(), {});
  const auto moved = displaced(apart, place, 0.17, bumpy, plenty);
  EXPECT_FALSE(closed(*moved));
  // But they move as if they did.
  const auto points = [](const TriangleMeshShape& mesh) {
    std::set<std::tuple<double, double, double>> all;
    for (const Vector3& p : mesh.positions)
      all.insert({std::round(1e9 * p.x), std::round(1e9 * p.y), std::round(1e9 * p.z)});
    return all;
  };
  EXPECT_EQ(points(*moved), points(*displaced(octahedron(), place, 0.17, bumpy, plenty)));
}

// Along unit normals, in the mesh's own space: those of the mesh, or where it has none those of its triangles.
TEST(Displacement, VerticesMoveAlongTheirNormals) {
  const auto ramp = [](Vector3, const Uv& uv) { return 0.5 * uv[0] + 0.25 * uv[1]; };
  const auto risen = displaced(square(), scale({7, 7, 7}), 1, ramp, plenty);
  ASSERT_GT(risen->positions.size(), 100u);
  const Vector3 n = normalize({-0.25, -0.125, 1});
  for (std::size_t i = 0; i < risen->positions.size(); ++i) {
    const Vector3& p = risen->positions[i];
    EXPECT_NEAR(p.z, 0.25 * p.x + 0.125 * p.y, 1e-12);
    EXPECT_NEAR(length(risen->normals[i] - n), 0, 1e-12);
    EXPECT_NEAR(risen->uv[i][0], p.x / 2, 1e-12);
    EXPECT_NEAR(risen->uv[i][1], p.y / 2, 1e-12);
  }
  TriangleMeshShape leaning = square();
  leaning.normals.assign(4, {3, 0, 4});
  for (const auto one = displaced(
           leaning, Transform(), 1, [](Vector3, const Uv&) { return 1; }, plenty);
       const Vector3& p : one->positions)
    EXPECT_NEAR(p.z, 0.8, 1e-12);
  for (const auto round = displaced(
           octahedron(), Transform(), 2, [](Vector3, const Uv&) { return 1; }, plenty);
       const Vector3& p : round->positions)
    EXPECT_NEAR(length(p), 2, 1e-12);
}

// Two squares that meet at a right angle: smooth there without normals, an edge with those of the squares.
TEST(Displacement, WhatWasAnEdgeStaysOne) {
  TriangleMeshShape fold{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}},
                         {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}},
                         {},
                         std::vector<Uv>(8)};
  const auto smooth = displaced(fold, Transform(), 2, nothing, plenty);
  EXPECT_EQ(smooth->normals[0], smooth->normals[4]);
  fold.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  const auto edged = displaced(fold, Transform(), 2, nothing, plenty);
  EXPECT_EQ(edged->normals, fold.normals);
}

TEST(Displacement, TrianglesAreBounded) {
  const std::size_t needed = displaced(square(), Transform(), 0.1, nothing, plenty)->triangles.size();
  EXPECT_GT(needed, 1000u);
  EXPECT_TRUE(displaced(square(), Transform(), 0.1, nothing, needed));
  EXPECT_FALSE(displaced(square(), Transform(), 0.1, nothing, needed - 1));
  // Coordinates so large that halves are not shorter come to an end too.
  TriangleMeshShape far = square();
  for (Vector3& p : far.positions) p = p + Vector3{1e20, 0, 0};
  far.positions[1].x = std::nextafter(1e20, 1e21);
  EXPECT_FALSE(displaced(far, Transform(), 0.1, nothing, plenty));
}

// Scenes, their mesh a square in a .ply file and their texture a picture or a number.
class DisplacedScenes : public ::testing::Test {
 protected:
  DisplacedScenes() {
    write_bytes_to(folder_.file("square.ply"),
                   ply("property float u\nproperty float v\n", {" 0 0", " 1 0", " 1 1", " 0 1"}));
    write_bytes_to(folder_.file("bare.ply"), ply("", {"", "", "", ""}));
    Image image{4, 4, {}};
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        for (int c = 0; c < 3; ++c) image.pixels.push_back(0.25f * static_cast<float>(column));
    write_image(folder_.file("steps.pfm"), image, {});
  }

  static std::string ply(const std::string& properties, const std::array<std::string, 4>& uv) {
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" +
           properties + "element face 1\nproperty list uchar int vertex_indices\nend_header\n-1 -1 0" + uv[0] +
           "\n1 -1 0" + uv[1] + "\n1 1 0" + uv[2] + "\n-1 1 0" + uv[3] + "\n4 0 1 2 3\n";
  }

  CompiledScene scene(const std::string& texture, const std::string& shape) {
    std::vector<Diagnostic> warnings;
    const std::string text = "WorldBegin\nTexture \"t\" \"float\" " + texture + "\n" + shape;
    return compile(read_scene_text(text, "test.pbrt", folder_.path(), warnings), 1, warnings);
  }

  static std::string displaced_square(const std::string& edge_length) {
    return "Shape \"plymesh\" \"string filename\" \"square.ply\" \"texture displacement\" \"t\" \"float edgelength\" " +
           edge_length;
  }

  // What a ray from above the point meets, in the scene's own shapes.
  static SurfaceHit hit(const CompiledScene& scene, const Intersector& intersector, float x, float y) {
    SurfaceHit found;
    EXPECT_TRUE(intersector.nearest_surface({{x, y, 10}, {0, 0, -1}, far_away}, found)) << x << ' ' << y;
    EXPECT_EQ(scene.shapes.size(), 1u);
    return found;
  }

  TemporaryFolder folder_;
};

TEST_F(DisplacedScenes, ByAConstantAreTheMovedMesh) {
  const CompiledScene moved = scene("\"constant\" \"float value\" 0.3", "Scale 1 1 2\n" + displaced_square("0.2")),
                      plain = scene("\"constant\"",
                                    "Translate 0 0 0.6\nShape \"plymesh\" \"string filename\" \"square.ply\"");
  EXPECT_GT(moved.triangles.size(), 100u);
  const Intersector of_moved(moved), of_plain(plain);
  for (int i = 0; i < 100; ++i) {
    const float x = 0.197f * static_cast<float>(i % 10) - 0.9f, y = 0.193f * static_cast<float>(i / 10) - 0.9f;
    const SurfaceHit a = hit(moved, of_moved, x, y), b = hit(plain, of_plain, x, y);
    EXPECT_NEAR(a.t, b.t, 1e-5f);
    EXPECT_NEAR(length(a.normal - b.normal), 0, 1e-6f);
    EXPECT_NEAR(length(a.shading_normal - b.shading_normal), 0, 1e-5f);
    EXPECT_EQ(a.from_inside, b.from_inside);
  }
}

// A picture in four steps from left to right; planar, from top to bottom.
TEST_F(DisplacedScenes, FollowTheirTexture) {
  const std::string steps = "\"imagemap\" \"string filename\" \"steps.pfm\" \"string filter\" \"point\" ";
  const CompiledScene by_uv = scene(steps, displaced_square("0.02"));
  const CompiledScene planar = scene(
      steps + "\"string mapping\" \"planar\" \"vector3 v1\" [0 0.5 0] \"float udelta\" 0.5", displaced_square("0.02"));
  const Intersector of_uv(by_uv), of_planar(planar);
  for (int step = 0; step < 4; ++step) {
    const float at = 0.5f * static_cast<float>(step) - 0.75f;
    EXPECT_NEAR(hit(by_uv, of_uv, at, 0.33f).t, 10 - 0.25f * static_cast<float>(step), 1e-5f);
    EXPECT_NEAR(hit(planar, of_planar, 0.33f, at).t, 10 - 0.25f * static_cast<float>(step), 1e-5f);
  }
}

TEST_F(DisplacedScenes, ThatCannotBeAreErrors) {
  const auto error = [&](const std::string& texture, const std::string& shape) {
    return error_of([&] { scene(texture, shape); });
  };
  EXPECT_EQ(error("\"constant\"", "Shape \"plymesh\" \"string filename\" \"bare.ply\" \"texture displacement\" \"t\""),
            "test.pbrt:3:1: error: \"texture displacement\" needs a mesh whose vertices have u and v");
  EXPECT_EQ(error("\"scale\" \"float tex\" 1e38 \"float scale\" 1e38", displaced_square("1")),
            "test.pbrt:3:1: error: \"texture displacement\" is infinite or not a number on the mesh");
  EXPECT_NE(error("\"imagemap\" \"string filename\" \"none.png\"", displaced_square("1")).find("none.png"),
            std::string::npos);
}

}  // namespace
}  // namespace brume

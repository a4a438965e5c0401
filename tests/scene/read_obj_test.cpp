// Meshes of .obj files, what is said of those that are broken, and polygons cut into triangles.
#include "scene/read_obj.h"

#include <cmath>
#include <random>

#include "image/temporary_folder.h"
#include "scene_test.h"

namespace brume {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

class Obj : public testing::Test {
 protected:
  ObjMesh read(const std::string& text) {
    std::filesystem::remove(path_);  // writing over a file would wait for the disk
    std::ofstream(path_, std::ios::binary) << text;
    return read_obj(path_);
  }

  std::string error(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& e) {
      return e.diagnostics().front().message;
    }
    return "no error";
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.file("mesh.obj");
};

const char* const square = R"(# a square of a quad
mtllib square.mtl
o square
v 0 0 0
v 2 0 0 1.0
v 2 \
  3 0
v 0 3 0
vt 0 0
vt 1 0 0
vt 1 1
vt 0 1
vn 0 0 1
g all
usemtl red
s off
l 1 2
f 1/1/1 2/2/1 3/3/1 4/4/1 # all of it
)";

TEST_F(Obj, CornersBecomeVertices) {
  const ObjMesh obj = read(square);
  const std::vector<Vector3> positions = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}};
  const std::vector<std::array<double, 2>> uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  // In the order of their first use.
  EXPECT_EQ(obj.mesh.positions, positions);
  EXPECT_EQ(obj.mesh.uv, uv);
  EXPECT_EQ(obj.mesh.normals, std::vector<Vector3>(4, Vector3{0, 0, 1}));
  EXPECT_EQ(obj.mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_TRUE(obj.names_materials);
  EXPECT_FALSE(obj.lacks_normals_or_uv);
  EXPECT_EQ(obj.skipped_elements, 1u);
}

TEST_F(Obj, IndicesMayCountBackAndLeaveOutNormalsAndUv) {
  const std::string points = "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nvn 0 0 1\r\nvt 0.5 0.25\r\n";
  EXPECT_EQ(read(points + "f -3 -2 -1\r\n").mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_TRUE(read(points + "f 1 2 3\n").mesh.normals.empty());
  EXPECT_EQ(read(points + "f 1//1 2//-1 3//1\n").mesh.normals.size(), 3u);
  EXPECT_TRUE(read(points + "f 1//1 2//1 3//1\n").mesh.uv.empty());
  EXPECT_EQ(read(points + "f 1/1 2/1 3/1\n").mesh.uv[2], (std::array<double, 2>{0.5, 0.25}));
  const ObjMesh mixed = read(points + "f 1//1 2//1 3//1\nf 1 2 3\n");
  EXPECT_TRUE(mixed.lacks_normals_or_uv);
  EXPECT_TRUE(mixed.mesh.normals.empty());
}

TEST_F(Obj, BrokenFilesAreRefusedWithAReason) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(error(""), "has no face");
  EXPECT_EQ(error(points), "has no face");
  EXPECT_EQ(error("\x1f\x8b\x08"), "is compressed by gzip and ends too early");
  EXPECT_EQ(error("v 1 2\n"), "ends before its last value");
  EXPECT_EQ(error("v 1 two 3\n"), "has \"two\" where a number should be");
  EXPECT_EQ(error("v 1 1e39 3\n"), "has a vertex that is not finite");
  EXPECT_EQ(error("vt nan\n"), "has a vertex that is not finite");
  EXPECT_EQ(error(points + "f 1 2\n"), "has a face of 2 corners");
  EXPECT_EQ(error(points + "f 1 2 4\n"), "has a face with the vertex \"4\", and 3 so far");
  EXPECT_EQ(error(points + "f 1 2 0\n"), "has a face with the vertex \"0\", and 3 so far");
  EXPECT_EQ(error(points + "f 1 2 -4\n"), "has a face with the vertex \"-4\", and 3 so far");
  EXPECT_EQ(error(points + "f 1 2 99999999999999999999\n"),
            "has a face with the vertex \"99999999999999999999\", and 3 so far");
  EXPECT_EQ(error(points + "f 1 2 3/1\n"), "has a face with the texture vertex \"1\", and 0 so far");
  EXPECT_EQ(error(points + "f 1 2 3//1\n"), "has a face with the normal \"1\", and 0 so far");
  EXPECT_EQ(error(points + "f 1 2 3/1/1/1\n"), "has a face with the corner \"3/1/1/1\"");
  std::string many = points + "f";
  for (int i = 0; i < 257; ++i) many += " 1";
  EXPECT_EQ(error(many), "has a face of more than 256 corners");
  EXPECT_EQ(read(points + "f 1 2 3").mesh.triangles.size(), 1u);  // without an end of line
}

// Whatever becomes of the bytes, the file is read or refused; and what is read is sound.
TEST_F(Obj, MutantsAreReadOrRefused) {
  std::mt19937 random(20240501);
  int read_well = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string bytes = square;
    for (auto edits = 1 + random() % 3; edits > 0; --edits) {
      const std::size_t at = random() % bytes.size();
      if (random() % 4 == 0)
        bytes.erase(at, 1 + random() % 8);
      else
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
    }
    try {
      const TriangleMeshShape mesh = read(bytes).mesh;
      ++read_well;
      EXPECT_TRUE(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
      EXPECT_TRUE(mesh.uv.empty() || mesh.uv.size() == mesh.positions.size());
      for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t v : triangle) ASSERT_LT(v, mesh.positions.size());
    } catch (const InputError& e) {
      ++refused;
      EXPECT_FALSE(e.diagnostics().front().message.empty());
    }
  }
  EXPECT_GT(read_well, 300);
  EXPECT_GT(refused, 300);
}

double area(const std::vector<Vector3>& polygon) {
  Vector3 sum;
  for (std::size_t i = 0; i < polygon.size(); ++i) sum = sum + cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * length(sum);
}

// Of star-shaped polygons with spikes, tilted in space. A fan from a corner covers more than a concave polygon.
TEST(Triangulate, TheTrianglesOfConcavePolygonsAddUpToTheirArea) {
  std::mt19937 random(3);
  int fans_that_fail = 0;
  for (std::size_t n = 4; n < 60; ++n) {
    std::vector<Vector3> polygon;
    const Transform tilt = rotate(static_cast<double>(random() % 360), {1, 2, 3}) * translate({5, -2, 1});
    for (std::size_t i = 0; i < n; ++i) {
      const double phi = 6.283185307 * static_cast<double>(i) / static_cast<double>(n);
      const double r = 0.2 + static_cast<double>(random() % 100) / 100;
      polygon.push_back(tilt.point({r * std::cos(phi), r * std::sin(phi), 0}));
    }
    const auto covered = [&](const Triangles& triangles) {
      double sum = 0;
      for (const auto& [a, b, c] : triangles)
        sum += 0.5 * length(cross(polygon[b] - polygon[a], polygon[c] - polygon[a]));
      return sum;
    };
    std::vector<Vector3> moved = polygon;
    for (Vector3& p : moved) p = p - polygon[0];
    const Triangles triangles = triangulate(polygon);
    ASSERT_EQ(triangles.size(), n - 2);
    EXPECT_NEAR(covered(triangles), area(moved), 1e-9);
    Triangles fan;
    for (std::uint32_t i = 1; i + 1 < n; ++i) fan.push_back({0, i, i + 1});
    fans_that_fail += covered(fan) > area(moved) + 1e-3;
  }
  EXPECT_GT(fans_that_fail, 40);
}

TEST(Triangulate, DegeneratePolygonsGiveAsManyTriangles) {
  EXPECT_EQ(triangulate(std::vector<Vector3>(7)).size(), 5u);
  EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).size(), 2u);
  EXPECT_EQ(triangulate({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2u);  // crosses itself
}

}  // namespace
}  // namespace brume

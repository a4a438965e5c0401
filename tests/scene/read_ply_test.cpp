// Meshes of .ply files, in all three formats, and what is said of those that are broken.
#include <bit>
#include <cstring>
#include <random>

#include "image/temporary_folder.h"
#include "scene/read_ply.h"
#include "scene_test.h"

namespace brume {
namespace {

// A tetrahedron's corner, with a quad, a pentagon and things that nobody asked for.
struct Sample {
  std::string format;
  bool normals = true;

  std::string header() const {
    std::string text =
        "ply\nformat " + format + " 1.0\ncomment by hand\nelement camera 1\nproperty list uchar char x\n";
    text += "element vertex 5\nproperty float x\nproperty double y\nproperty float z\nproperty uchar red\n";
    if (normals) text += "property float nx\nproperty float ny\nproperty float nz\n";
    return text + "element face 3\nproperty short flags\nproperty list uchar int vertex_indices\nend_header\n";
  }

  template <class T>
  void add(std::string& text, T value) const {
    if (format == "ascii") {
      text += std::to_string(value) + ' ';
      return;
    }
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (format == "binary_big_endian") std::reverse(std::begin(bytes), std::end(bytes));
    text.append(bytes, sizeof value);
  }

  std::string file() const {
    std::string text = header();
    add<std::uint8_t>(text, 2);
    add<std::int8_t>(text, -3);
    add<std::int8_t>(text, 4);
    for (int i = 0; i < 5; ++i) {
      add<float>(text, 0.5f * static_cast<float>(i));
      add<double>(text, -0.25 * i);
      add<float>(text, static_cast<float>(i * i));
      add<std::uint8_t>(text, 200);
      for (int axis = 0; normals && axis < 3; ++axis) add<float>(text, axis == 2 ? 1.0f : 0.0f);
    }
    for (const auto& corners : {std::vector{0, 1, 2}, {1, 2, 3, 4}, {0, 1, 2, 3, 4}}) {
      add<std::int16_t>(text, -7);
      add(text, static_cast<std::uint8_t>(corners.size()));
      for (const int corner : corners) add<std::int32_t>(text, corner);
    }
    return text;
  }
};

class Ply : public testing::Test {
 protected:
  PlyMesh read(const std::string& bytes) {
    std::filesystem::remove(path_);  // writing over a file would wait for the disk
    std::ofstream(path_, std::ios::binary) << bytes;
    return read_ply(path_);
  }

  std::string error(const std::string& bytes) {
    try {
      read(bytes);
    } catch (const InputError& e) {
      return e.diagnostics().front().message;
    }
    return "no error";
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.file("mesh.ply");
};

TEST_F(Ply, AllFormatsHoldTheSameMesh) {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"})
    for (const bool normals : {true, false}) {
      const PlyMesh ply = read(Sample{format, normals}.file());
      ASSERT_EQ(ply.mesh.positions.size(), 5u) << format;
      EXPECT_EQ(ply.mesh.positions[3], (Vector3{1.5, -0.75, 9})) << format;
      EXPECT_EQ(ply.mesh.normals.size(), normals ? 5u : 0u);
      const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {1, 2, 3}, {1, 3, 4}};
      EXPECT_EQ(ply.mesh.triangles, triangles) << format;
      EXPECT_EQ(ply.skipped_faces, 1u);
    }
}

TEST_F(Ply, WindowsLineEndsAndVertexIndexAreFine) {
  std::string text;
  for (const char c : Sample{"ascii"}.file()) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  text.replace(text.find("vertex_indices"), 14, "vertex_index");
  EXPECT_EQ(read(text).mesh.triangles.size(), 3u);
}

TEST_F(Ply, BrokenFilesAreRefusedWithAReason) {
  const std::string good = Sample{"ascii"}.file();
  const auto with = [&](const std::string& old_text, const std::string& text) {
    std::string changed = good;
    changed.replace(changed.find(old_text), old_text.size(), text);
    return error(changed);
  };
  EXPECT_EQ(error(""), "is not a .ply file: it does not begin with the line \"ply\"");
  EXPECT_EQ(error("\x1f\x8b\x08"), "is compressed by gzip and ends too early");
  EXPECT_EQ(error("ply\nformat ascii 1.0\n"), "ends within its header");
  EXPECT_EQ(with("format ascii 1.0\n", ""), "has no line \"format\" in its header");
  EXPECT_EQ(with("ascii", "utf-8"), "has the unknown format \"utf-8\"");
  EXPECT_EQ(with("float x", "real x"), "has a property of an unknown type \"real\"");
  EXPECT_EQ(with("uchar int vertex", "float int vertex"), "has a list whose count is not an integer");
  EXPECT_EQ(with("vertex 5", "vertex many"), "has an element \"vertex\" without a count");
  EXPECT_EQ(with("property float x\n", ""), "has vertices without x, y and z");
  EXPECT_EQ(with("vertex_indices", "corners"), "has faces without a list vertex_indices");
  EXPECT_EQ(with("vertex 5", "vertex 5000000"), "ends before its last value");
  EXPECT_EQ(with("vertex 5", "vertex 5000000000000"),
            "has 5000000000000 of element \"vertex\", which take more than half of the memory");
  EXPECT_EQ(with("4.0000", "four"), "has \"four00\" where a number should be");
  EXPECT_EQ(with("4.000000", "1e39"), "has a vertex that is not finite");
  EXPECT_EQ(with("4.000000", "nan"), "has a vertex that is not finite");
  EXPECT_EQ(with("3 0 1 2", "3 0 1 5"), "has a face with the vertex 5, and 5 vertices in all");
  EXPECT_EQ(with("3 0 1 2", "3 0 1 -1"), "has a face with the vertex -1");
  EXPECT_EQ(with("3 0 1 2", "-3 0 1 2"), "has a list with a count below 0");
  EXPECT_EQ(with("face 3", "face 0"), "has no face of three or four corners");
  EXPECT_EQ(error(good.substr(0, good.size() - 3)), "ends before its last value");
}

// Whatever becomes of the bytes, the file is read or refused; and what is read is sound.
TEST_F(Ply, MutantsAreReadOrRefused) {
  std::mt19937 random(20240501);
  int read_well = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    const char* const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    std::string bytes = Sample{formats[i % 3]}.file();
    for (auto edits = 1 + random() % 3; edits > 0; --edits) {
      const std::size_t at = random() % bytes.size();
      if (random() % 4 == 0)
        bytes.erase(at, 1 + random() % 8);
      else
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
    }
    try {
      const PlyMesh ply = read(bytes);
      ++read_well;
      for (const auto& triangle : ply.mesh.triangles)
        for (const std::uint32_t v : triangle) ASSERT_LT(v, ply.mesh.positions.size());
    } catch (const InputError& e) {
      ++refused;
      EXPECT_FALSE(e.diagnostics().front().message.empty());
    }
  }
  EXPECT_GT(read_well, 300);
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace brume

#include "scene/read_obj.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <tuple>

#include "base/gzip.h"
#include "base/memory.h"
#include "scene/mesh_text.h"

namespace brume {

namespace {

constexpr std::size_t max_corners = 256;

// Indices from 0; -1: none.
struct Corner {
  std::int64_t position = -1, uv = -1, normal = -1;
  bool operator<(const Corner& other) const {
    return std::tie(position, uv, normal) < std::tie(other.position, other.uv, other.normal);
  }
};

// "i" of a face: from 1, or below 0 counted back from the last of `count` so far.
std::int64_t index_of(std::string_view word, std::size_t count, std::string_view what) {
  std::int64_t i = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), i);
  const bool is_number = code == std::errc() && end == word.data() + word.size();
  const auto n = static_cast<std::int64_t>(count);
  if (!is_number || i == 0 || i > n || i < -n)
    throw Fault{fmt::format("has a face with the {} \"{}\", and {} so far", what, word.substr(0, 40), count)};
  return i > 0 ? i - 1 : n + i;
}

class ObjReader {
 public:
  // Lines that end in a backslash go on in the next.
  explicit ObjReader(std::string& text) {
    for (std::size_t at = text.find('\\'); at != std::string::npos; at = text.find('\\', at + 1)) {
      const std::size_t end = at + (text.compare(at + 1, 1, "\r") == 0 ? 2 : 1);
      if (text.compare(end, 1, "\n") == 0) text.replace(at, end - at + 1, end - at + 1, ' ');
    }
    Text lines(text);
    while (!lines.rest().empty()) read_line(Text(lines.line()));
    if (obj_.mesh.triangles.empty()) throw Fault{"has no face"};
    has_normals_ = has_normals_ && !normals_.empty();
    has_uv_ = has_uv_ && !uv_.empty();
    obj_.lacks_normals_or_uv = (any_normal_ && !has_normals_) || (any_uv_ && !has_uv_);
    if (!has_normals_) obj_.mesh.normals.clear();
    if (!has_uv_) obj_.mesh.uv.clear();
  }

  ObjMesh take() { return std::move(obj_); }

 private:
  void read_line(Text words) {
    const std::string_view keyword = words.word();
    if (keyword == "v") {
      positions_.push_back(triple(words));
    } else if (keyword == "vn") {
      normals_.push_back(triple(words));
    } else if (keyword == "vt") {
      const double u = number(words.word());
      const std::string_view v = words.word();
      uv_.push_back(finite_uv(u, v.empty() ? 0 : number(v)));
    } else if (keyword == "f") {
      read_face(words);
    } else if (keyword == "usemtl" || keyword == "mtllib") {
      obj_.names_materials = true;
    } else if (keyword == "p" || keyword == "l") {
      ++obj_.skipped_elements;
    }
  }

  static Vector3 triple(Text& words) {
    const double x = number(words.word()), y = number(words.word()), z = number(words.word());
    return finite(x, y, z);
  }

  void read_face(Text& words) {
    std::vector<std::uint32_t> vertices;
    std::vector<Vector3> polygon;
    for (std::string_view word = words.word(); !word.empty() && word.front() != '#'; word = words.word()) {
      if (vertices.size() == max_corners) throw Fault{fmt::format("has a face of more than {} corners", max_corners)};
      const Corner corner = read_corner(word);
      vertices.push_back(vertex_of(corner));
      polygon.push_back(positions_[static_cast<std::size_t>(corner.position)]);
    }
    if (vertices.size() < 3) throw Fault{fmt::format("has a face of {} corners", vertices.size())};
    for (const auto& [a, b, c] : triangulate(polygon))
      obj_.mesh.triangles.push_back({vertices[a], vertices[b], vertices[c]});
  }

  // "v", "v/vt", "v//vn" or "v/vt/vn".
  Corner read_corner(std::string_view word) const {
    std::array<std::string_view, 3> parts;
    std::size_t count = 0;
    for (std::string_view rest = word;; ++count) {
      if (count == 3) throw Fault{fmt::format("has a face with the corner \"{}\"", word.substr(0, 40))};
      const std::size_t slash = rest.find('/');
      parts[count] = rest.substr(0, slash);
      if (slash == std::string_view::npos) break;
      rest.remove_prefix(slash + 1);
    }
    Corner c;
    c.position = index_of(parts[0], positions_.size(), "vertex");
    if (!parts[1].empty()) c.uv = index_of(parts[1], uv_.size(), "texture vertex");
    if (!parts[2].empty()) c.normal = index_of(parts[2], normals_.size(), "normal");
    return c;
  }

  std::uint32_t vertex_of(const Corner& c) {
    TriangleMeshShape& mesh = obj_.mesh;
    const auto [known, is_new] = vertices_.try_emplace(c, static_cast<std::uint32_t>(mesh.positions.size()));
    if (!is_new) return known->second;
    mesh.positions.push_back(positions_[static_cast<std::size_t>(c.position)]);
    mesh.normals.push_back(c.normal < 0 ? Vector3{} : normals_[static_cast<std::size_t>(c.normal)]);
    mesh.uv.push_back(c.uv < 0 ? std::array<double, 2>{} : uv_[static_cast<std::size_t>(c.uv)]);
    has_normals_ = has_normals_ && c.normal >= 0;
    has_uv_ = has_uv_ && c.uv >= 0;
    any_normal_ = any_normal_ || c.normal >= 0;
    any_uv_ = any_uv_ || c.uv >= 0;
    return known->second;
  }

  std::vector<Vector3> positions_, normals_;
  std::vector<std::array<double, 2>> uv_;
  std::map<Corner, std::uint32_t> vertices_;
  bool has_normals_ = true, has_uv_ = true;  // in all corners so far
  bool any_normal_ = false, any_uv_ = false;
  ObjMesh obj_;
};

}  // namespace

ObjMesh read_obj(const std::string& path) { return read_obj_text(path, read_file_unpacked(path)); }

ObjMesh read_obj_text(const std::string& name, std::string text) {
  try {
    return read_within_memory(name, [&] { return ObjReader(text).take(); });
  } catch (const Fault& fault) {
    throw InputError(name, fault.message);
  }
}

}  // namespace brume

#include "compile/displace.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace brume {

namespace {

// The vertex in the middle of each edge that was split.
class Middles {
 public:
  explicit Middles(TriangleMeshShape& mesh) : mesh_(mesh) {}

  std::uint32_t between(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t edge = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const auto [found, is_new] = middles_.try_emplace(edge, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) {
      mesh_.positions.push_back(0.5 * (mesh_.positions[a] + mesh_.positions[b]));
      mesh_.normals.push_back(normalize(mesh_.normals[a] + mesh_.normals[b]));
      const auto &p = mesh_.uv[a], &q = mesh_.uv[b];
      mesh_.uv.push_back({0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])});
    }
    return found->second;
  }

 private:
  TriangleMeshShape& mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;
};

// The number of the longest of a triangle's edges, the first from its first to its second corner; none where no edge is
// longer than edge_length.
std::optional<std::ptrdiff_t> edge_to_split(const std::array<Vector3, 3>& t, const Transform& world_from_object,
                                            double edge_length) {
  const auto edge = [&](Vector3 a, Vector3 b) { return length(world_from_object.vector(b - a)); };
  const std::array edges{edge(t[0], t[1]), edge(t[1], t[2]), edge(t[2], t[0])};
  const auto longest = std::max_element(edges.begin(), edges.end());
  if (!(*longest > edge_length)) return std::nullopt;
  return longest - edges.begin();
}

std::array<Vector3, 3> corners(const TriangleMeshShape& mesh, const std::array<std::uint32_t, 3>& t) {
  return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

// Whether splitting ends with at most max_triangles: counted first, since many take much memory.
bool can_split(const TriangleMeshShape& mesh, const Transform& world_from_object, double edge_length,
               std::size_t max_triangles) {
  std::size_t count = mesh.triangles.size();
  std::vector<std::array<Vector3, 3>> waiting;
  for (const auto& triangle : mesh.triangles)
    for (waiting.push_back(corners(mesh, triangle)); !waiting.empty();) {
      std::array<Vector3, 3> t = waiting.back();
      waiting.pop_back();
      const auto longest = edge_to_split(t, world_from_object, edge_length);
      if (!longest) continue;
      std::rotate(t.begin(), t.begin() + *longest, t.end());
      const Vector3 middle = 0.5 * (t[0] + t[1]);
      const bool has_middle = middle != t[0] && middle != t[1];  // else there are no shorter edges
      if (++count > max_triangles || !has_middle) return false;
      waiting.push_back({t[0], middle, t[2]});
      waiting.push_back({middle, t[1], t[2]});
    }
  return true;
}

// Halves triangles at their longest edges. Whether an edge is split, and where, follows from its ends alone, so
// triangles that share it go on sharing all of it. Source: M.-C. Rivara, "Algorithms for refining triangular grids
// suitable for adaptive and multigrid techniques", IJNME 20(4), 1984.
void split(TriangleMeshShape& mesh, const Transform& world_from_object, double edge_length) {
  Middles middles(mesh);
  std::vector<std::array<std::uint32_t, 3>> waiting;
  waiting.swap(mesh.triangles);
  while (!waiting.empty()) {
    std::array<std::uint32_t, 3> t = waiting.back();
    const auto longest = edge_to_split(corners(mesh, t), world_from_object, edge_length);
    if (!longest) {
      mesh.triangles.push_back(t);
      waiting.pop_back();
      continue;
    }
    std::rotate(t.begin(), t.begin() + *longest, t.end());
    const std::uint32_t middle = middles.between(t[0], t[1]);
    waiting.back() = {t[0], middle, t[2]};
    waiting.push_back({middle, t[1], t[2]});
  }
}

std::tuple<double, double, double> in_order(Vector3 v) { return {v.x, v.y, v.z}; }

// For each vertex the first one of those at its place with its normal, where there are normals. They differ in their uv
// alone, and are to have one normal.
std::vector<std::uint32_t> first_alike(const TriangleMeshShape& mesh) {
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    if (mesh.positions[a] != mesh.positions[b] || mesh.normals.empty())
      return in_order(mesh.positions[a]) < in_order(mesh.positions[b]);
    return in_order(mesh.normals[a]) < in_order(mesh.normals[b]);
  };
  std::vector<std::uint32_t> order(mesh.positions.size()), first(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), before);
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && !before(order[i - 1], order[i]) ? first[order[i - 1]] : order[i];
  return first;
}

// The mean normals of the triangles about each vertex and those like it, weighted by area.
std::vector<Vector3> mean_normals(const TriangleMeshShape& mesh, const std::vector<std::uint32_t>& first) {
  std::vector<Vector3> normals(mesh.positions.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3 n = cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    for (const std::uint32_t corner : {a, b, c}) normals[first[corner]] = normals[first[corner]] + n;
  }
  // The first come first: the others get theirs to the last bit.
  for (std::size_t i = 0; i < normals.size(); ++i)
    normals[i] = first[i] == i ? normalize(normals[i]) : normals[first[i]];
  return normals;
}

}  // namespace

std::optional<TriangleMeshShape> displaced(TriangleMeshShape mesh, const Transform& world_from_object,
                                           double edge_length, const Displace& displace, std::size_t max_triangles) {
  if (!can_split(mesh, world_from_object, edge_length, max_triangles)) return std::nullopt;
  if (mesh.normals.empty()) mesh.normals = mean_normals(mesh, first_alike(mesh));
  for (Vector3& n : mesh.normals) n = normalize(n);
  split(mesh, world_from_object, edge_length);
  const std::vector<std::uint32_t> first = first_alike(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.positions[i] = mesh.positions[i] + displace(mesh.positions[i], mesh.uv[i]) * mesh.normals[i];
  mesh.normals = mean_normals(mesh, first);
  return mesh;
}

}  // namespace brume

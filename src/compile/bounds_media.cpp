#include "compile/bounds_media.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <vector>

namespace brume {

namespace {

bool is_whole(const SphereShape& s) { return s.z_min <= -s.radius && s.z_max >= s.radius && s.phi_max >= 360; }

// Whether polygons' edges are passed as often one way as the other.
class EdgeBalance {
 public:
  explicit EdgeBalance(const std::vector<Vector3>& positions) : place_(positions.size()) {
    const auto key = [&](std::size_t i) { return std::tuple(positions[i].x, positions[i].y, positions[i].z); };
    std::vector<std::size_t> order(positions.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, key);
    for (std::size_t i = 0; i < order.size(); ++i)
      place_[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? place_[order[i - 1]] : i;
  }

  template <std::size_t n>
  void add(const std::array<std::uint32_t, n>& corners) {
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t from = place_[corners[i]], to = place_[corners[(i + 1) % n]];
      if (from != to) edges_.push_back({std::min(from, to), std::max(from, to), from < to});
    }
  }

  bool is_even() {
    std::ranges::sort(edges_);
    int balance = 0;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const auto& [from, to, upwards] = edges_[i];
      balance += upwards ? 1 : -1;
      const bool is_last =
          i + 1 == edges_.size() || std::get<0>(edges_[i + 1]) != from || std::get<1>(edges_[i + 1]) != to;
      if (is_last && balance != 0) return false;
    }
    return true;
  }

 private:
  std::vector<std::size_t> place_;  // of a position: the same number for all at the same place
  std::vector<std::tuple<std::size_t, std::size_t, bool>> edges_;
};

// Whether rays go on beyond a surface of the material.
bool passes_light(const MaterialDescription& material) {
  const auto* phong = std::get_if<BlinnPhongMaterial>(&material);
  return std::holds_alternative<InterfaceMaterial>(material) || std::holds_alternative<DielectricMaterial>(material) ||
         (phong && !is_zero(phong->refraction));
}

}  // namespace

bool is_closed(const ShapeDescription& shape) {
  if (const auto* sphere = std::get_if<SphereShape>(&shape.kind)) return is_whole(*sphere);
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape.kind)) return cylinder->caps && cylinder->phi_max >= 360;
  if (const auto* mesh = std::get_if<TriangleMeshShape>(&shape.kind)) {
    EdgeBalance edges(mesh->positions);
    for (const auto& triangle : mesh->triangles) edges.add(triangle);
    return edges.is_even();
  }
  if (const auto* patches = std::get_if<BilinearMeshShape>(&shape.kind)) {
    EdgeBalance edges(patches->positions);
    for (const auto& [p00, p10, p01, p11] : patches->patches) edges.add(std::array{p00, p10, p11, p01});
    return edges.is_even();
  }
  return false;
}

bool bounds_media(const ShapeDescription& shape) {
  return shape.inside != shape.outside && !is_cut_out(shape) && (passes_light(shape.material) || is_closed(shape));
}

}  // namespace brume

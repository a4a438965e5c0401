#include "session/grid_extent.h"

#include <algorithm>
#include <array>

#include "volume/kernel_view.h"

namespace brume {

namespace {

using Index = std::array<int, 3>;

bool is_empty(const kernel::BrickGrid& g, Index brick) {
  const auto at = [&](std::size_t axis) { return static_cast<std::uint32_t>(brick[axis] + 1); };
  return kernel::load_u32(g.table, 2 * (at(2) * g.table_xy + at(1) * g.table_x + at(0))) == 0;
}

// Calls f(brick) for each brick that is not empty, in rows along `axis`, and end_row() after each row.
template <class PerBrick, class EndRow>
void for_each_brick(const VolumeGrid& grid, int axis, PerBrick&& f, EndRow&& end_row) {
  const auto a = static_cast<std::size_t>(axis), b = (a + 1) % 3, c = (a + 2) % 3;
  const kernel::BrickGrid g = kernel_view(grid.bricks);
  const Index& bricks = grid.bricks.bricks;
  Index at;
  for (at[c] = 0; at[c] < bricks[c]; ++at[c])
    for (at[b] = 0; at[b] < bricks[b]; ++at[b]) {
      for (at[a] = 0; at[a] < bricks[a]; ++at[a])
        if (!is_empty(g, at)) f(at);
      end_row();
    }
}

// Calls f(voxel within the brick, density) for a brick's voxels.
template <class PerVoxel>
void for_each_voxel(const kernel::BrickGrid& g, Index brick, PerVoxel&& f) {
  Index v;
  for (v[2] = 0; v[2] < brick_edge; ++v[2])
    for (v[1] = 0; v[1] < brick_edge; ++v[1])
      for (v[0] = 0; v[0] < brick_edge; ++v[0])
        f(v, kernel::grid_voxel(g, 8 * brick[0] + v[0], 8 * brick[1] + v[1], 8 * brick[2] + v[2]));
}

Vector3 to_vector(Index v) { return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])}; }

}  // namespace

std::vector<Box3> occupied_boxes(const VolumeGrid& grid) {
  const kernel::BrickGrid g = kernel_view(grid.bricks);
  const float threshold = grid.bricks.max_value / 1000;
  std::vector<Box3> boxes;
  const auto look_at_brick = [&](Index brick) {
    Box3 box;
    for_each_voxel(g, brick, [&](Index v, float density) {
      if (density <= threshold) return;
      const Vector3 lo = to_vector({8 * brick[0] + v[0], 8 * brick[1] + v[1], 8 * brick[2] + v[2]});
      box.include(lo);
      box.include(lo + Vector3{1, 1, 1});
    });
    if (!box.empty()) boxes.push_back(box);
  };
  for_each_brick(grid, 0, look_at_brick, [] {});
  return boxes;
}

float smallest_density(const VolumeGrid& grid) {
  const kernel::BrickGrid g = kernel_view(grid.bricks);
  const Index &first = grid.first_voxel, &end = grid.bricks.voxels;
  float smallest = grid.bricks.max_value;
  for (int z = first[2]; z < end[2]; ++z)
    for (int y = first[1]; y < end[1]; ++y)
      for (int x = first[0]; x < end[0]; ++x) {
        smallest = std::min(smallest, kernel::grid_voxel(g, x, y, z));
        if (smallest == 0) return 0;
      }
  return smallest;
}

double densest_row(const VolumeGrid& grid, int axis) {
  const kernel::BrickGrid g = kernel_view(grid.bricks);
  const auto b = static_cast<std::size_t>((axis + 1) % 3), c = static_cast<std::size_t>((axis + 2) % 3);
  std::array<double, brick_edge * brick_edge> sums{};  // of the rows that cross the present row of bricks
  double densest = 0;
  for_each_brick(
      grid, axis,
      [&](Index brick) {
        for_each_voxel(g, brick, [&](Index v, float density) {
          sums[static_cast<std::size_t>(v[b] + brick_edge * v[c])] += static_cast<double>(density);
        });
      },
      [&] {
        densest = std::max(densest, *std::max_element(sums.begin(), sums.end()));
        sums.fill(0);
      });
  return densest;
}

}  // namespace brume

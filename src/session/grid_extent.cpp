#include "session/grid_extent.h"

#include <algorithm>
#include <array>

#include "volume/kernel_view.h"

namespace brume {

namespace {

using Index = std::array<int, 3>;

// A grid's bricks and voxels. Bricks of one value are not gone through voxel by voxel: a file of a few bytes may stand
// for billions.
class Bricks {
 public:
  explicit Bricks(const BrickGrid& grid) : grid_(grid), view_(kernel_view(grid)) {}

  BrickEntry entry(Index brick) const {
    const auto at = [&](std::size_t axis) { return static_cast<std::size_t>(brick[axis] + 1); };
    return grid_.entry(at(2) * view_.table_xy + at(1) * view_.table_x + at(0));
  }
  bool is_constant(BrickEntry entry) const {
    return std::ranges::binary_search(grid_.constant_bricks, entry.first_word);
  }
  float voxel(Index p) const { return kernel::grid_voxel(view_, p[0], p[1], p[2]); }

  // Calls f(brick, entry) for each brick that is not empty, in rows along `axis`, and end_row() after each row.
  template <class PerBrick, class EndRow>
  void for_each(int axis, PerBrick&& f, EndRow&& end_row) const {
    const auto a = static_cast<std::size_t>(axis), b = (a + 1) % 3, c = (a + 2) % 3;
    const Index& bricks = grid_.bricks;
    Index at;
    for (at[c] = 0; at[c] < bricks[c]; ++at[c])
      for (at[b] = 0; at[b] < bricks[b]; ++at[b]) {
        for (at[a] = 0; at[a] < bricks[a]; ++at[a])
          if (const BrickEntry e = entry(at); e.first_word != 0) f(at, e);
        end_row();
      }
  }

 private:
  const BrickGrid& grid_;
  kernel::BrickGrid view_;
};

Index first_voxel(Index brick) { return {8 * brick[0], 8 * brick[1], 8 * brick[2]}; }

// Calls f(voxel) for those from lo to hi, without hi.
template <class PerVoxel>
void for_each_voxel(Index lo, Index hi, PerVoxel&& f) {
  Index v;
  for (v[2] = lo[2]; v[2] < hi[2]; ++v[2])
    for (v[1] = lo[1]; v[1] < hi[1]; ++v[1])
      for (v[0] = lo[0]; v[0] < hi[0]; ++v[0]) f(v);
}

Vector3 to_vector(Index v) { return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])}; }

}  // namespace

std::vector<Box3> occupied_boxes(const VolumeGrid& grid) {
  const Bricks bricks(grid.bricks);
  const float threshold = grid.bricks.max_value / 1000;
  std::vector<Box3> boxes;
  const auto look_at_brick = [&](Index brick, BrickEntry entry) {
    const Index lo = first_voxel(brick), hi{lo[0] + brick_edge, lo[1] + brick_edge, lo[2] + brick_edge};
    if (bricks.is_constant(entry)) {
      if (bricks.voxel(lo) <= threshold) return;
      const Box3 box{to_vector(lo), to_vector(hi)};
      const bool continues_last = !boxes.empty() && boxes.back().hi == Vector3{box.lo.x, box.hi.y, box.hi.z} &&
                                  boxes.back().lo.y == box.lo.y && boxes.back().lo.z == box.lo.z;
      if (continues_last)
        boxes.back().hi.x = box.hi.x;
      else
        boxes.push_back(box);
      return;
    }
    Box3 box;
    for_each_voxel(lo, hi, [&](Index v) {
      if (bricks.voxel(v) <= threshold) return;
      box.include(to_vector(v));
      box.include(to_vector(v) + Vector3{1, 1, 1});
    });
    if (!box.empty()) boxes.push_back(box);
  };
  bricks.for_each(0, look_at_brick, [] {});
  return boxes;
}

float smallest_density(const VolumeGrid& grid) {
  const Bricks bricks(grid.bricks);
  const Index &first = grid.first_voxel, &end = grid.bricks.voxels;
  float smallest = grid.bricks.max_value;
  Index brick;
  for (brick[2] = first[2] / brick_edge; brick[2] < grid.bricks.bricks[2]; ++brick[2])
    for (brick[1] = first[1] / brick_edge; brick[1] < grid.bricks.bricks[1]; ++brick[1])
      for (brick[0] = first[0] / brick_edge; brick[0] < grid.bricks.bricks[0]; ++brick[0]) {
        Index lo = first_voxel(brick), hi = lo;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          hi[axis] = std::min(lo[axis] + brick_edge, end[axis]);
          lo[axis] = std::max(lo[axis], first[axis]);
        }
        const BrickEntry entry = bricks.entry(brick);
        if (entry.first_word == 0) return 0;
        if (bricks.is_constant(entry)) hi = {lo[0] + 1, lo[1] + 1, lo[2] + 1};
        for_each_voxel(lo, hi, [&](Index v) { smallest = std::min(smallest, bricks.voxel(v)); });
        if (smallest == 0) return 0;
      }
  return smallest;
}

double densest_row(const VolumeGrid& grid, int axis) {
  const Bricks bricks(grid.bricks);
  const auto b = static_cast<std::size_t>((axis + 1) % 3), c = static_cast<std::size_t>((axis + 2) % 3);
  std::array<double, brick_edge * brick_edge> sums{};  // of the rows that cross the present row of bricks
  double densest = 0;
  bricks.for_each(
      axis,
      [&](Index brick, BrickEntry entry) {
        const Index lo = first_voxel(brick), hi{lo[0] + brick_edge, lo[1] + brick_edge, lo[2] + brick_edge};
        if (bricks.is_constant(entry)) {
          const double sum = brick_edge * static_cast<double>(bricks.voxel(lo));
          for (double& s : sums) s += sum;
          return;
        }
        for_each_voxel(lo, hi, [&](Index v) {
          sums[static_cast<std::size_t>(v[b] - lo[b] + brick_edge * (v[c] - lo[c]))] +=
              static_cast<double>(bricks.voxel(v));
        });
      },
      [&] {
        densest = std::max(densest, *std::max_element(sums.begin(), sums.end()));
        sums.fill(0);
      });
  return densest;
}

}  // namespace brume

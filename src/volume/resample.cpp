#include "volume/resample.h"

#include "base/parallel.h"
#include "volume/kernel_view.h"

namespace brume {

VolumeGrid resample(const VolumeGrid& grid, std::array<int, 3> voxels, Storage storage, int threads) {
  const BrickGrid& from = grid.bricks;
  const kernel::BrickGrid view = kernel_view(from);
  std::array<float, 3> step{};  // from voxel to voxel, in the grid's own
  std::array<int, 3> bricks{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    step[axis] = static_cast<float>(from.voxels[axis]) / static_cast<float>(voxels[axis]);
    bricks[axis] = (voxels[axis] - 1) / brick_edge + 1;
  }
  const auto place = [&](int voxel, std::size_t axis) { return (static_cast<float>(voxel) + 0.5f) * step[axis]; };

  BrickGridBuilder builder(voxels, storage);
  const int layer = bricks[0] * bricks[1];
  std::vector<std::array<float, brick_voxels>> values(static_cast<std::size_t>(layer));
  for (int z = 0; z < bricks[2]; ++z) {
    parallel_for(layer, thread_count(threads), [&](int i, int) {
      const int x = i % bricks[0], y = i / bricks[0];
      for (int v = 0; v < brick_voxels; ++v) {
        const int vx = 8 * x + (v & 7), vy = 8 * y + (v >> 3 & 7), vz = 8 * z + (v >> 6);
        const bool is_inside = vx < voxels[0] && vy < voxels[1] && vz < voxels[2];
        values[static_cast<std::size_t>(i)][static_cast<std::size_t>(v)] =
            is_inside ? kernel::grid_linear(view, {place(vx, 0), place(vy, 1), place(vz, 2)}) : 0;
      }
    });
    for (int i = 0; i < layer; ++i)
      builder.set_brick({i % bricks[0], i / bricks[0], z}, values[static_cast<std::size_t>(i)]);
  }

  VolumeGrid to;
  to.name = grid.name;
  to.bricks = builder.finish();
  const auto wide = [&](std::size_t axis) { return static_cast<double>(from.voxels[axis]) / voxels[axis]; };
  to.medium_from_index = grid.medium_from_index * scale({wide(0), wide(1), wide(2)});
  to.support = grid.support;
  return to;
}

}  // namespace brume

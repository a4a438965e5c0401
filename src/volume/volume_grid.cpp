#include "volume/volume_grid.h"

namespace brume {

Box3 support_index(const VolumeGrid& grid, bool linear) {
  const double fade = linear && grid.support == Support::fade ? 0.5 : 0;
  Box3 box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    box.lo[axis] = grid.first_voxel[a] - fade;
    box.hi[axis] = grid.bricks.voxels[a] + fade;
  }
  return box;
}

Vector3 voxel_size(const VolumeGrid& grid) {
  const Transform& t = grid.medium_from_index;
  return {length(t.vector({1, 0, 0})), length(t.vector({0, 1, 0})), length(t.vector({0, 0, 1}))};
}

}  // namespace brume

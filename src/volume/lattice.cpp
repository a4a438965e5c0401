#include "volume/lattice.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"

namespace brume {
namespace {

constexpr double rounding = 1e-9;  // 0.6 * 10 is to be 6 voxels

int voxels_along(double half, int size) { return std::max(1, static_cast<int>(std::ceil(half * size - rounding))); }

Transform medium_from_index(const Lattice& lattice) {
  const double voxel = 2.0 / std::max({lattice.voxels[0], lattice.voxels[1], lattice.voxels[2]});
  return scale({voxel, voxel, voxel}) *
         translate({-0.5 * lattice.voxels[0], -0.5 * lattice.voxels[1], -0.5 * lattice.voxels[2]});
}

}  // namespace

Lattice::Lattice(std::array<double, 3> half, int size)
    : voxels{voxels_along(half[0], size), voxels_along(half[1], size), voxels_along(half[2], size)},
      voxel(2.0f / static_cast<float>(size)) {}

VolumeGrid fill_bricks(const std::string& name, const Lattice& lattice, Storage storage, int threads,
                       const FillBrick& fill) {
  BrickGridBuilder builder(lattice.voxels, storage);
  const auto bricks = [&](std::size_t axis) { return (lattice.voxels[axis] + brick_edge - 1) / brick_edge; };
  const int row = bricks(0), layer = row * bricks(1);
  std::vector<std::array<float, brick_voxels>> values(static_cast<std::size_t>(layer));
  std::vector<char> filled(values.size());  // not vector<bool>: workers write neighbouring elements
  for (int z = 0; z < bricks(2); ++z) {
    parallel_for(layer, thread_count(threads), [&](int i, int) {
      const auto at = static_cast<std::size_t>(i);
      filled[at] = fill({i % row, i / row, z}, values[at]);
    });
    for (int i = 0; i < layer; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (filled[at] != 0) builder.set_brick({i % row, i / row, z}, values[at]);
    }
  }
  VolumeGrid grid;
  grid.name = name;
  grid.bricks = builder.finish();
  grid.medium_from_index = medium_from_index(lattice);
  return grid;
}

VolumeGrid fill_voxels(const std::string& name, const Lattice& lattice, Storage storage, int threads,
                       const std::function<float(NoisePoint)>& value) {
  return fill_bricks(name, lattice, storage, threads, [&](std::array<int, 3> brick, auto& values) {
    bool any = false;
    for (int i = 0; i < brick_voxels; ++i) {
      const auto middle = [&](int voxel, int axis) {
        return static_cast<float>(8 * brick[static_cast<std::size_t>(axis)] + voxel) + 0.5f;
      };
      const float v = value(lattice.place(middle(i & 7, 0), middle((i >> 3) & 7, 1), middle(i >> 6, 2)));
      values[static_cast<std::size_t>(i)] = v;
      any = any || v != 0;
    }
    return any;
  });
}

}  // namespace brume

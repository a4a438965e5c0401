// One ball in each cell of a coarse lattice, of any size up to the largest that leaves nine tenths of the bricks empty.
#include <algorithm>
#include <array>

#include "kernel/scalar.h"
#include "volume/procedural.h"

namespace brume {
namespace {

constexpr int largest_cell = 16;         // bricks along its edge
constexpr float largest_radius = 0.39f;  // of the edge of a cell

// A puff, in voxels.
struct Puff {
  std::array<float, 3> centre;
  float radius;
};

// The values of a brick: 1 at the puff's centre, falling to 0 at its surface.
void fill_brick(const Puff& puff, std::array<int, 3> brick, std::array<float, brick_voxels>& values) {
  std::array<std::array<float, brick_edge>, 3> squared{};  // distances from the centre in radii, by axis
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < brick_edge; ++i) {
      const float place = static_cast<float>(brick[axis] * brick_edge) + static_cast<float>(i) + 0.5f;
      const float radii = (place - puff.centre[axis]) / puff.radius;
      squared[axis][i] = radii * radii;
    }
  for (std::size_t i = 0; i < brick_voxels; ++i)
    values[i] = std::max(0.0f, 1 - squared[0][i & 7] - squared[1][i >> 3 & 7] - squared[2][i >> 6]);
}

}  // namespace

VolumeGrid scattered_puffs(int size, Storage storage) {
  BrickGridBuilder builder({size, size, size}, storage);
  const int bricks = (size - 1) / brick_edge + 1, cell_bricks = std::min(bricks, largest_cell);
  const auto cell_edge = static_cast<float>(cell_bricks * brick_edge);
  std::array<float, brick_voxels> values;
  const auto add_puff = [&](std::array<int, 3> cell, std::uint32_t number) {
    const auto random = [&](std::uint32_t i) { return kernel::random_uniform(0, 0, number, i); };
    Puff puff{{}, largest_radius * cell_edge * (1 - random(3))};
    std::array<int, 3> first{}, last{};  // the bricks that it touches, all in its cell
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float at = puff.radius + (cell_edge - 2 * puff.radius) * random(static_cast<std::uint32_t>(axis));
      puff.centre[axis] = static_cast<float>(cell[axis]) * cell_edge + at;
      const auto brick = [&](float place) { return static_cast<int>(place) / brick_edge; };
      first[axis] = std::max(brick(puff.centre[axis] - puff.radius), cell[axis] * cell_bricks);
      last[axis] = std::min({brick(puff.centre[axis] + puff.radius), (cell[axis] + 1) * cell_bricks - 1, bricks - 1});
    }
    for (int z = first[2]; z <= last[2]; ++z)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x) {
          fill_brick(puff, {x, y, z}, values);
          builder.set_brick({x, y, z}, values);
        }
  };
  const int cells = (bricks - 1) / cell_bricks + 1;
  std::uint32_t number = 0;
  for (int z = 0; z < cells; ++z)
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x) add_puff({x, y, z}, number++);

  VolumeGrid grid;
  grid.name = "density";
  grid.bricks = builder.finish();
  const double voxel = 2.0 / size;
  grid.medium_from_index = translate({-1, -1, -1}) * scale({voxel, voxel, voxel});
  return grid;
}

}  // namespace brume

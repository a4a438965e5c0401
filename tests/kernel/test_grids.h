// Small brick grids of noise for the tests of look-up and traversal.
#pragma once

#include <array>
#include <vector>

#include "kernel/scalar.h"
#include "volume/brick_grid.h"

namespace brume {

// nx ny nz values in [lo, 1), uniform and independent; x fastest.
inline std::vector<float> noise_values(std::array<int, 3> voxels, float lo) {
  std::vector<float> values(static_cast<std::size_t>(voxels[0]) * static_cast<std::size_t>(voxels[1]) *
                            static_cast<std::size_t>(voxels[2]));
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = lo + (1 - lo) * kernel::random_uniform(11, 0, static_cast<std::uint32_t>(i), 0);
  return values;
}

// What the scalar build's look-up takes; the grid must outlive it.
inline kernel::BrickGrid grid_view(const BrickGrid& grid) {
  const auto row = static_cast<std::uint32_t>(grid.bricks[0] + 2),
             layer = row * static_cast<std::uint32_t>(grid.bricks[1] + 2);
  return {grid.table.data(), grid.words.data(), row, layer, static_cast<std::uint32_t>(grid.storage)};
}

}  // namespace brume

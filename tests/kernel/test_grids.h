// Small brick grids of noise for the tests of look-up and traversal.
#pragma once

#include <array>
#include <vector>

#include "kernel/scalar.h"
#include "volume/brick_borders.h"
#include "volume/kernel_view.h"

namespace brume {

// nx ny nz values in [lo, 1), uniform and independent; x fastest.
inline std::vector<float> noise_values(std::array<int, 3> voxels, float lo) {
  std::vector<float> values(static_cast<std::size_t>(voxels[0]) * static_cast<std::size_t>(voxels[1]) *
                            static_cast<std::size_t>(voxels[2]));
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = lo + (1 - lo) * kernel::random_uniform(11, 0, static_cast<std::uint32_t>(i), 0);
  return values;
}

// Grids of the same noise in every storage, their bricks plain and bordered.
inline std::vector<BrickGrid> noise_grids(std::array<int, 3> voxels) {
  std::vector<BrickGrid> grids;
  for (const Storage storage : {Storage::u8, Storage::u16, Storage::f32}) {
    grids.push_back(make_brick_grid(voxels, noise_values(voxels, 0), storage));
    grids.push_back(add_borders(grids.back(), 1));
  }
  return grids;
}

}  // namespace brume

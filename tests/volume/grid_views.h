// Look-ups in a host-side brick grid through the kernel.
#pragma once

#include "kernel/scalar.h"
#include "volume/brick_grid.h"

namespace brume {

inline kernel::BrickGrid kernel_view(const BrickGrid& grid) {
  const auto row = static_cast<std::uint32_t>(grid.bricks[0] + 2),
             rows = static_cast<std::uint32_t>(grid.bricks[1] + 2);
  return {grid.table.data(), grid.words.data(), row, row * rows, static_cast<std::uint32_t>(grid.storage)};
}

}  // namespace brume

// A host-side brick grid as kernels take it.
#pragma once

#include "kernel/scalar.h"
#include "volume/brick_grid.h"

namespace brume {

// The grid must outlive the view.
inline kernel::BrickGrid kernel_view(const BrickGrid& grid) {
  const auto row = static_cast<std::uint32_t>(grid.bricks[0] + 2),
             rows = static_cast<std::uint32_t>(grid.bricks[1] + 2);
  return {grid.table.data(),      grid.words.data(), row, row * rows, static_cast<std::uint32_t>(grid.storage),
          grid.bordered ? 1u : 0u};
}

}  // namespace brume

// Upper bounds of a grid's density, one for each cube of voxels: what tracking steps through (kernel/majorant.inl).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "volume/brick_grid.h"

namespace brume {

struct MajorantCells {
  int edge = brick_edge;      // of a cell, in voxels
  std::array<int, 3> size{};  // cells along each axis, border included
  // Bits of floats, x fastest. A cell's bound holds for the interpolant in the cell and for what one stochastic tap can
  // reach from it, one voxel beyond.
  std::vector<std::uint32_t> cells;
};

// The finest cells, of whole voxels and no finer than min_edge, that take at most max_bytes; on `threads` threads.
MajorantCells make_majorants(const BrickGrid& grid, int min_edge, std::size_t max_bytes, int threads);

}  // namespace brume

// Bricks with borders, for those who look up all eight corners of a cell.
#pragma once

#include "volume/brick_grid.h"

namespace brume {

// The same grid with bordered bricks (kernel/lookup.inl). A value is rounded again where those of its brick's
// neighbours need other levels: its error is then at most a step of the new levels in place of half a step. The grid as
// it is, where bordered bricks would need more than max_brick_words.
BrickGrid add_borders(BrickGrid grid, int threads);

}  // namespace brume

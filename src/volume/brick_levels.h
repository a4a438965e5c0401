// How the values of a brick become levels, packed in words, and levels values again (kernel/lookup.inl).
#pragma once

#include "volume/brick_grid.h"

namespace brume {

// The words of so many values.
std::size_t packed_words(std::size_t values, Storage storage);

// The steps of a table's entry: offset and scale such that each value in [lo, hi] is at most half a step from a level.
// 0 for f32.
std::uint32_t level_steps(float lo, float hi, Storage storage);

// Whether each value in [lo, hi] is at most half a step from a level of the entry's steps.
bool levels_reach(BrickEntry entry, float lo, float hi, Storage storage);

// Packs values as the nearest levels, the first in the lowest bits, into packed_words() words.
void pack_levels(std::span<const float> values, BrickEntry entry, Storage storage, std::span<std::uint32_t> words);

// Value number `index` of the brick.
inline float packed_value(const BrickGrid& grid, BrickEntry entry, std::uint32_t index) {
  const std::uint32_t* words = grid.words.data() + entry.first_word;
  if (grid.storage == Storage::f32) return std::bit_cast<float>(words[index]);
  const std::uint32_t level = grid.storage == Storage::u16 ? words[index >> 1] >> ((index & 1) * 16) & 0xffff
                                                           : words[index >> 2] >> ((index & 3) * 8) & 0xff;
  return static_cast<float>(static_cast<double>(entry.offset()) + static_cast<double>(entry.scale()) * level);
}

}  // namespace brume

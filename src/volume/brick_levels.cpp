#include "volume/brick_levels.h"

#include <algorithm>
#include <bit>

namespace brume {

namespace {

double highest_level(Storage storage) { return storage == Storage::u8 ? 255 : 65535; }

// The upper half of the float that is nearest to x among those not above it that end in 16 zero bits.
std::uint32_t half_float_below(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const bool rounds_up = x < 0 && (bits & 0xffff) != 0;             // cutting bits moves it towards 0
  return (bits >> 16) + (rounds_up && bits < 0xff7f0000u ? 1 : 0);  // the last finite one stays
}

// The same, not below; of a positive number.
std::uint32_t half_float_above(double x) {
  std::uint32_t upper = std::bit_cast<std::uint32_t>(static_cast<float>(x)) >> 16;
  while (static_cast<double>(std::bit_cast<float>(upper << 16)) < x) ++upper;
  return upper;
}

}  // namespace

std::size_t packed_words(std::size_t values, Storage storage) {
  return (values * static_cast<std::size_t>(storage) + 31) / 32;
}

std::uint32_t level_steps(float lo, float hi, Storage storage) {
  if (storage == Storage::f32) return 0;
  BrickEntry entry{0, half_float_below(lo) << 16};
  const double range = static_cast<double>(hi) - static_cast<double>(entry.offset());
  return entry.steps | half_float_above(range / highest_level(storage));
}

bool levels_reach(BrickEntry entry, float lo, float hi, Storage storage) {
  if (storage == Storage::f32) return true;
  const auto offset = static_cast<double>(entry.offset()), scale = static_cast<double>(entry.scale());
  return offset <= static_cast<double>(lo) && static_cast<double>(hi) <= offset + highest_level(storage) * scale;
}

void pack_levels(std::span<const float> values, BrickEntry entry, Storage storage, std::span<std::uint32_t> words) {
  if (storage == Storage::f32) {
    std::ranges::transform(values, words.begin(), [](float v) { return std::bit_cast<std::uint32_t>(v); });
    return;
  }
  const auto offset = static_cast<double>(entry.offset()), scale = static_cast<double>(entry.scale());
  const double steps_per_unit = scale > 0 ? 1 / scale : 0, highest = highest_level(storage);
  const auto bits = static_cast<unsigned>(storage), per_word = 32 / bits;
  std::ranges::fill(words, 0);
  for (unsigned i = 0; i < values.size(); ++i) {
    const double q = std::clamp((static_cast<double>(values[i]) - offset) * steps_per_unit, 0.0, highest);
    words[i / per_word] |= static_cast<std::uint32_t>(q + 0.5) << (i % per_word * bits);
  }
}

}  // namespace brume

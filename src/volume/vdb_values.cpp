#include "volume/vdb_values.h"

#include <array>
#include <bit>
#include <vector>

#include "volume/decompress.h"
#include "volume/half.h"
#include "volume/vdb_file.h"

namespace brume {
namespace {

// What a block's first byte says of the values that are not active.
enum class Inactive : std::uint8_t {
  background,        // all are the background
  minus_background,  // all are its negative
  one_value,         // all are one value, given
  background_signs,  // a mask chooses between the background and its negative
  value_or_background,
  two_values,
  stored,  // they are stored like active ones
};

constexpr bool has_mask(Inactive kind) {
  return kind == Inactive::background_signs || kind == Inactive::value_or_background || kind == Inactive::two_values;
}

constexpr std::size_t largest_block = 32 * 32 * 32;

// Fills `bytes` with a block that may be compressed: a 64-bit size, then the data; a size <= 0 is minus that of raw
// data.
void read_bytes(ByteReader& reader, std::uint32_t compression, std::span<char> bytes) {
  if ((compression & (vdb_zip | vdb_blosc)) == 0) {
    const std::string_view raw = reader.take(bytes.size());
    raw.copy(bytes.data(), raw.size());
    return;
  }
  const auto size = reader.get<std::int64_t>();
  if (size <= 0) {
    if (size != -static_cast<std::int64_t>(bytes.size())) reader.fail("a block of values has the wrong size");
    const std::string_view raw = reader.take(bytes.size());
    raw.copy(bytes.data(), raw.size());
    return;
  }
  const std::string_view packed = reader.take(static_cast<std::uint64_t>(size));
  const bool good = (compression & vdb_blosc) != 0 ? decompress_blosc(packed, bytes.data(), bytes.size())
                                                   : decompress_zip(packed, bytes.data(), bytes.size());
  if (!good) reader.fail("a block of compressed values is damaged");
}

// Reads stored values, active ones or all, to the front of `values`.
void read_stored(ByteReader& reader, const VdbValueFormat& format, std::span<float> values) {
  if (!format.half) {
    read_bytes(reader, format.compression, {reinterpret_cast<char*>(values.data()), values.size_bytes()});
    return;
  }
  if (values.empty()) return;  // such a block of halves has no size either
  std::array<std::uint16_t, largest_block> halves;
  read_bytes(reader, format.compression, {reinterpret_cast<char*>(halves.data()), 2 * values.size()});
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = half_to_float(halves[i]);
}

bool bit(std::span<const std::uint64_t> mask, std::size_t i) { return ((mask[i / 64] >> (i % 64)) & 1) != 0; }

}  // namespace

void read_vdb_values(ByteReader& reader, const VdbValueFormat& format, std::span<const std::uint64_t> active,
                     std::span<float> values) {
  const auto kind = static_cast<Inactive>(reader.get<std::uint8_t>());
  if (kind > Inactive::stored) reader.fail("a node's values are encoded in an unknown way");
  float unchosen = kind == Inactive::background ? format.background : -format.background;
  float chosen = format.background;
  if (kind == Inactive::one_value || kind == Inactive::value_or_background || kind == Inactive::two_values) {
    unchosen = reader.get<float>();
  }
  if (kind == Inactive::two_values) chosen = reader.get<float>();
  std::array<std::uint64_t, largest_block / 64> choice{};
  if (has_mask(kind)) {
    const std::string_view mask = reader.take(active.size_bytes());
    std::memcpy(choice.data(), mask.data(), mask.size());
  }

  std::size_t stored = values.size();
  if ((format.compression & vdb_active_mask) != 0 && kind != Inactive::stored) {
    stored = 0;
    for (const std::uint64_t word : active) stored += static_cast<std::size_t>(std::popcount(word));
  }
  read_stored(reader, format, values.first(stored));
  if (stored == values.size()) return;
  // Spread the stored values to their places, from the last, so that none is overwritten before it has moved.
  for (std::size_t i = values.size(); i-- > 0;) {
    values[i] = bit(active, i) ? values[--stored] : bit(choice, i) ? chosen : unchosen;
  }
}

}  // namespace brume

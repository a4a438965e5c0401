// Blocks of values in a .vdb file: compressed, halved, and with inactive values left out.
#pragma once

#include <cstdint>
#include <span>

#include "volume/byte_reader.h"

namespace brume {

struct VdbValueFormat {
  std::uint32_t compression = 0;  // bits of VdbCompression
  bool half = false;
  float background = 0;
};

// Reads the values of a node with mask `active` of values.size() / 64 words. Throws InputError.
void read_vdb_values(ByteReader& reader, const VdbValueFormat& format, std::span<const std::uint64_t> active,
                     std::span<float> values);

}  // namespace brume

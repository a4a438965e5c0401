// The directory of a .nvdb file, and a grid's buffer as NanoVDB lays it out in memory.
#pragma once

#include <nanovdb/NanoVDB.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "volume/byte_reader.h"
#include "volume/vdb_leaves.h"

namespace brume {

enum class NvdbCodec : std::uint16_t { none = 0, zip = 1, blosc = 2 };

struct NvdbGrid {
  std::string name;
  nanovdb::GridType type{};
  nanovdb::GridClass grid_class{};
  NvdbCodec codec{};
  ActiveVoxels active;            // as the file tells
  std::uint64_t memory_size = 0;  // of the buffer
  std::string_view stored;        // the buffer as the file has it, by its codec
};

// The grids of a file in its order. Throws InputError.
std::vector<NvdbGrid> read_nvdb_directory(ByteReader& reader);

// The buffer's header alone.
nanovdb::GridData read_nvdb_grid_data(const ByteReader& reader, const NvdbGrid& grid);

// NanoVDB's structures want their buffer, and by whole multiples of it each part, aligned like this.
struct alignas(NANOVDB_DATA_ALIGNMENT) NvdbBlock {
  std::byte bytes[NANOVDB_DATA_ALIGNMENT];
};

// The whole buffer, memory_size bytes of it. Not checked for what it holds.
std::vector<NvdbBlock> read_nvdb_buffer(const ByteReader& reader, const NvdbGrid& grid);

}  // namespace brume

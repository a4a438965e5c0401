#include "volume/nvdb_file.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/memory.h"
#include "volume/decompress.h"

namespace brume {
namespace {

// A file's segments begin with "NanoVDB0", or from version 32.6 on "NanoVDB2"; a grid's buffer with "NanoVDB0" or "1".
constexpr std::uint64_t magic_0 = NANOVDB_MAGIC_NUMBER, magic_1 = magic_0 + (std::uint64_t{1} << 56),
                        magic_2 = magic_0 + (std::uint64_t{2} << 56);
constexpr std::uint32_t supported_major = 32, oldest_minor = 3;

// The most that a codec makes of a byte: DEFLATE 1032, LZ4 255.
constexpr std::uint64_t largest_ratio = 1100;
// BLOSC buffers are cut into pieces of this size.
constexpr std::uint64_t blosc_piece = std::uint64_t{1} << 30;

void check_version(const ByteReader& reader, std::uint32_t version) {
  const std::uint32_t major = version >> 21, minor = (version >> 10) & 0x7ffu;
  if (major == supported_major && minor >= oldest_minor) return;
  reader.fail(fmt::format("NanoVDB version {}.{}.{}; versions {}.{} to {}.* can be read{}", major, minor,
                          version & 0x3ffu, supported_major, oldest_minor, supported_major,
                          major < supported_major || minor < oldest_minor ? ": convert it again from .vdb" : ""));
}

// A grid's entry; its name's length comes back in `name_size`, its stored length in `file_size`.
NvdbGrid read_entry(ByteReader& reader, std::uint64_t& file_size) {
  NvdbGrid grid;
  grid.memory_size = reader.get<std::uint64_t>();
  file_size = reader.get<std::uint64_t>();
  reader.take(8);  // hash of the name
  grid.active.count = static_cast<std::int64_t>(reader.get<std::uint64_t>());
  grid.type = static_cast<nanovdb::GridType>(reader.get<std::uint32_t>());
  grid.grid_class = static_cast<nanovdb::GridClass>(reader.get<std::uint32_t>());
  reader.take(6 * sizeof(double));  // box in world space
  for (std::int64_t& corner : grid.active.box.lo) corner = reader.get<std::int32_t>();
  for (std::int64_t& corner : grid.active.box.hi) corner = reader.get<std::int32_t>();
  reader.take(3 * sizeof(double));  // voxel size
  const auto name_size = reader.get<std::uint32_t>();
  reader.take(7 * sizeof(std::uint32_t));  // numbers of nodes and tiles
  reader.take(8);                          // codec and version again
  const std::string_view name = reader.take(name_size);
  grid.name = name.substr(0, name.find('\0'));
  return grid;
}

void check_size(const ByteReader& reader, const NvdbGrid& grid) {
  if (grid.memory_size > std::numeric_limits<std::int64_t>::max() ||
      !can_hold(static_cast<std::int64_t>(grid.memory_size)))
    reader.fail(fmt::format("grid \"{}\" is said to unpack to {} bytes, more than half of this machine's memory",
                            grid.name, grid.memory_size));
  const std::uint64_t ratio = grid.codec == NvdbCodec::none ? 1 : largest_ratio;
  if (grid.memory_size < sizeof(nanovdb::GridData) || grid.memory_size / ratio > grid.stored.size()) {
    reader.fail(fmt::format("grid \"{}\" is said to unpack from {} bytes to {}, which cannot be", grid.name,
                            grid.stored.size(), grid.memory_size));
  }
}

// The data of a packed piece, which its 64-bit size precedes.
std::string_view take_piece(ByteReader& reader) { return reader.take(reader.get<std::uint64_t>()); }

[[noreturn]] void fail_damaged(const ByteReader& reader, const NvdbGrid& grid) {
  reader.fail(fmt::format("grid \"{}\": its compressed data is damaged", grid.name));
}

void read_segment(ByteReader& reader, std::vector<NvdbGrid>& grids) {
  const auto magic = reader.get<std::uint64_t>();
  if (magic != magic_0 && magic != magic_2) reader.fail("not a NanoVDB file: it does not begin with the format's mark");
  check_version(reader, reader.get<std::uint32_t>());
  const auto count = reader.get<std::uint16_t>();
  const auto codec = reader.get<NvdbCodec>();
  if (codec > NvdbCodec::blosc) {
    reader.fail(fmt::format("unknown codec {}; none, ZIP and BLOSC can be read", static_cast<int>(codec)));
  }
  const std::size_t first = grids.size();
  std::vector<std::uint64_t> file_sizes(count);
  for (std::uint64_t& file_size : file_sizes) grids.push_back(read_entry(reader, file_size));
  for (std::size_t i = 0; i < count; ++i) {
    NvdbGrid& grid = grids[first + i];
    grid.codec = codec;
    grid.stored = reader.take(file_sizes[i]);
    check_size(reader, grid);
  }
}

}  // namespace

std::vector<NvdbGrid> read_nvdb_directory(ByteReader& reader) {
  std::vector<NvdbGrid> grids;
  do {
    read_segment(reader, grids);
  } while (!reader.at_end());
  return grids;
}

nanovdb::GridData read_nvdb_grid_data(const ByteReader& reader, const NvdbGrid& grid) {
  alignas(nanovdb::GridData) std::array<char, sizeof(nanovdb::GridData)> bytes;
  ByteReader stored(reader.file(), grid.stored);
  bool good = true;
  switch (grid.codec) {
    case NvdbCodec::none:
      stored.get_all(bytes);
      break;
    case NvdbCodec::zip:
      good = decompress_zip_begin(take_piece(stored), bytes.data(), bytes.size());
      break;
    case NvdbCodec::blosc:
      good = decompress_blosc_begin(take_piece(stored), bytes.data(), bytes.size());
      break;
  }
  if (!good) fail_damaged(reader, grid);
  nanovdb::GridData data;
  std::memcpy(static_cast<void*>(&data), bytes.data(), sizeof data);
  if (data.mMagic != magic_0 && data.mMagic != magic_1) {
    reader.fail(fmt::format("grid \"{}\" does not begin with the format's mark", grid.name));
  }
  check_version(reader, data.mVersion.id());
  if (data.mGridType != grid.type) reader.fail(fmt::format("grid \"{}\" has two different types", grid.name));
  return data;
}

std::vector<NvdbBlock> read_nvdb_buffer(const ByteReader& reader, const NvdbGrid& grid) {
  std::vector<NvdbBlock> buffer((grid.memory_size - 1) / sizeof(NvdbBlock) + 1);
  char* to = reinterpret_cast<char*>(buffer.data());
  ByteReader stored(reader.file(), grid.stored);
  switch (grid.codec) {
    case NvdbCodec::none:
      stored.take(grid.memory_size).copy(to, grid.memory_size);
      break;
    case NvdbCodec::zip:
      if (!decompress_zip(take_piece(stored), to, grid.memory_size)) fail_damaged(reader, grid);
      break;
    case NvdbCodec::blosc:
      for (std::uint64_t done = 0; done < grid.memory_size;) {
        const std::uint64_t size = std::min(blosc_piece, grid.memory_size - done);
        if (!decompress_blosc(take_piece(stored), to + done, size)) fail_damaged(reader, grid);
        done += size;
      }
      break;
  }
  return buffer;
}

}  // namespace brume

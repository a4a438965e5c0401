#include "base/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <new>
#include <span>

#include "base/diagnostics.h"
#include "base/file.h"
#include "base/pieces.h"

namespace brume {

namespace {

constexpr std::size_t largest_step = std::size_t{1} << 30;  // zlib counts with 32 bits

// zlib's state, ended with its scope.
class Inflater {
 public:
  Inflater() {
    if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) throw std::bad_alloc();  // 16: gzip
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream); }
  z_stream stream{};
};

}  // namespace

std::string unpacked(const std::string& name, std::string bytes, std::size_t largest) {
  if (!bytes.starts_with("\x1f\x8b")) return bytes;
  Inflater inflater;
  z_stream& z = inflater.stream;
  Pieces text(name, largest);
  std::size_t taken = 0;
  for (;;) {
    const std::size_t given = std::min(bytes.size() - taken, largest_step);
    const std::span<char> room = text.room();
    z.next_in = reinterpret_cast<Bytef*>(bytes.data() + taken);
    z.avail_in = static_cast<uInt>(given);
    z.next_out = reinterpret_cast<Bytef*>(room.data());
    z.avail_out = static_cast<uInt>(room.size());
    const int status = inflate(&z, Z_NO_FLUSH);
    taken += given - z.avail_in;
    text.filled(room.size() - z.avail_out);
    if (status == Z_STREAM_END && taken == bytes.size()) break;
    if (status == Z_STREAM_END && inflateReset(&z) == Z_OK) continue;  // a file may be several pieces in a row
    if (status == Z_BUF_ERROR) throw InputError(name, "is compressed by gzip and ends too early");
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status != Z_OK) throw InputError(name, "is compressed by gzip and damaged");
  }
  return text.joined();
}

std::string read_file_unpacked(const std::string& path) {
  return read_within_memory(path, [&] { return unpacked(path, read_file(path)); });
}

}  // namespace brume

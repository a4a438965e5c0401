#include "base/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <new>

#include "base/diagnostics.h"
#include "base/file.h"

namespace brume {

namespace {

constexpr std::size_t largest_size = std::size_t{1} << 32;
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

std::string unpacked(const std::string& name, std::string bytes) {
  if (!bytes.starts_with("\x1f\x8b")) return bytes;
  Inflater inflater;
  z_stream& z = inflater.stream;
  std::string text(std::min(4 * bytes.size(), largest_step), '\0');
  std::size_t taken = 0, made = 0;
  for (;;) {
    if (made > largest_size) throw InputError(name, "is compressed by gzip and unpacks to more than 4 GiB");
    if (made == text.size()) text.resize(2 * text.size());
    const std::size_t given = std::min(bytes.size() - taken, largest_step);
    const std::size_t room = std::min(text.size() - made, largest_step);
    z.next_in = reinterpret_cast<Bytef*>(bytes.data() + taken);
    z.avail_in = static_cast<uInt>(given);
    z.next_out = reinterpret_cast<Bytef*>(text.data() + made);
    z.avail_out = static_cast<uInt>(room);
    const int status = inflate(&z, Z_NO_FLUSH);
    taken += given - z.avail_in;
    made += room - z.avail_out;
    if (status == Z_STREAM_END && taken == bytes.size()) break;
    if (status == Z_STREAM_END && inflateReset(&z) == Z_OK) continue;  // a file may be several pieces in a row
    if (status == Z_BUF_ERROR) throw InputError(name, "is compressed by gzip and ends too early");
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status != Z_OK) throw InputError(name, "is compressed by gzip and damaged");
  }
  text.resize(made);
  return text;
}

std::string read_file_unpacked(const std::string& path) { return unpacked(path, read_file(path)); }

}  // namespace brume

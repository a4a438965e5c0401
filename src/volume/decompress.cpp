#include "volume/decompress.h"

#include <blosc.h>
#include <zlib.h>

namespace brume {

bool decompress_zip(std::string_view from, void* to, std::size_t size) {
  uLongf filled = size;
  const int status =
      uncompress(static_cast<Bytef*>(to), &filled, reinterpret_cast<const Bytef*>(from.data()), from.size());
  return status == Z_OK && filled == size;
}

bool decompress_blosc(std::string_view from, void* to, std::size_t size) {
  std::size_t filled = 0;
  if (blosc_cbuffer_validate(from.data(), from.size(), &filled) != 0 || filled != size) return false;
  return blosc_decompress_ctx(from.data(), to, size, 1) == static_cast<int>(size);
}

bool decompress_zip_begin(std::string_view from, void* to, std::size_t size) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return false;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(from.data()));  // zlib does not write to it
  stream.avail_in = static_cast<uInt>(from.size());  // where cut short by more than 4 GiB, still far more than enough
  stream.next_out = static_cast<Bytef*>(to);
  stream.avail_out = static_cast<uInt>(size);
  const int status = inflate(&stream, Z_SYNC_FLUSH);
  inflateEnd(&stream);
  return (status == Z_OK || status == Z_STREAM_END) && stream.avail_out == 0;
}

bool decompress_blosc_begin(std::string_view from, void* to, std::size_t size) {
  std::size_t whole = 0, item_size = 0;
  int flags = 0;
  if (blosc_cbuffer_validate(from.data(), from.size(), &whole) != 0 || whole < size) return false;
  blosc_cbuffer_metainfo(from.data(), &item_size, &flags);
  if (item_size != 4) return false;
  return blosc_getitem(from.data(), 0, static_cast<int>(size / 4), to) == static_cast<int>(size);
}

}  // namespace brume

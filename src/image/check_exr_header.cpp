#include "image/check_exr_header.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace brume {

namespace {

// A file is: magic number, version with flags, attributes (name, type, size, value; the first two end with a 0 byte), a
// 0 byte, the rest. Numbers are little-endian. Source: "OpenEXR File Layout" of the OpenEXR documentation.
constexpr std::uint32_t magic = 20000630, tiled = 0x200, deep = 0x800, multi_part = 0x1000;

[[noreturn]] void fail(const char* what) { throw std::runtime_error(what); }

std::string_view take(std::string_view& rest, std::size_t size) {
  if (size > rest.size()) fail("its header is damaged");
  const std::string_view bytes = rest.substr(0, size);
  rest.remove_prefix(size);
  return bytes;
}

template <class Number>
Number take_number(std::string_view& rest) {
  Number value;
  std::memcpy(&value, take(rest, sizeof value).data(), sizeof value);
  return value;
}

std::string_view take_word(std::string_view& rest) {
  const std::size_t length = rest.find('\0');
  if (length == std::string_view::npos) fail("its header is damaged");
  return take(rest, length + 1).substr(0, length);
}

// Deflate, the densest of OpenEXR's lossless codecs, packs at most 1032 bytes into one, and a pixel has three values of
// two bytes at least. Readers hold blocks of 16 or 32 rows, even of a picture of one row. A picture of more pixels than
// a .png may have does not reach that density: real ones of such a size have pixels that differ.
bool can_hold(std::size_t file_bytes, std::array<std::int32_t, 4> window) {
  const std::int64_t width = std::int64_t{window[2]} - window[0] + 1, height = std::int64_t{window[3]} - window[1] + 1;
  if (width <= 0 || height <= 0 || width > 1 << 24 || height > 1 << 24) return false;
  const std::int64_t bytes = static_cast<std::int64_t>(file_bytes), pixels = width * std::max<std::int64_t>(height, 32);
  return pixels <= bytes * 1032 / 6 + 65536 && pixels <= std::max(std::int64_t{1} << 26, 8 * bytes);
}

}  // namespace

void check_exr_header(std::string_view bytes) {
  std::string_view rest = bytes;
  if (rest.size() < 8 || take_number<std::uint32_t>(rest) != magic) fail("it is not an OpenEXR file");
  if (take_number<std::uint32_t>(rest) & (tiled | deep | multi_part))
    fail("it is a tiled, deep or multi-part file; plain scanline pictures can be read");
  bool has_window = false;
  for (std::string_view name = take_word(rest); !name.empty(); name = take_word(rest)) {
    take_word(rest);  // the type
    std::string_view value = take(rest, take_number<std::uint32_t>(rest));
    if (name != "dataWindow") continue;
    has_window = true;
    const auto x0 = take_number<std::int32_t>(value), y0 = take_number<std::int32_t>(value);
    const auto x1 = take_number<std::int32_t>(value), y1 = take_number<std::int32_t>(value);
    if (!can_hold(bytes.size(), {x0, y0, x1, y1})) fail("its header gives a size that the file cannot hold");
  }
  if (!has_window) fail("its header is damaged");
}

}  // namespace brume

// PFM: a header of three lines, then rows of floats from the bottom up; a negative scale means little-endian.
#include <fmt/format.h>

#include <bit>

#include "image/formats.h"

namespace brume {

static_assert(std::endian::native == std::endian::little);

std::string encode_pfm(const Image& image) {
  std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", image.width, image.height);
  const std::size_t row = static_cast<std::size_t>(image.width) * 3;
  for (int y = image.height - 1; y >= 0; --y)
    bytes.append(reinterpret_cast<const char*>(image.pixels.data() + static_cast<std::size_t>(y) * row),
                 row * sizeof(float));
  return bytes;
}

}  // namespace brume

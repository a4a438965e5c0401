#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "image/formats.h"

namespace brume {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

// Takes the header's next word and the one white character behind it.
std::string_view next_word(std::string_view& rest) {
  while (!rest.empty() && is_space(rest.front())) rest.remove_prefix(1);
  std::size_t length = 0;
  while (length < rest.size() && !is_space(rest[length])) ++length;
  const std::string_view word = rest.substr(0, length);
  rest.remove_prefix(std::min(length + 1, rest.size()));
  return word;
}

template <class Number>
Number parse(std::string_view word) {
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) throw std::runtime_error("its header is damaged");
  return value;
}

float load_float(const char* bytes, bool little_endian) {
  char b[4];
  std::memcpy(b, bytes, 4);
  if (!little_endian) std::reverse(b, b + 4);
  float value;
  std::memcpy(&value, b, 4);
  return value;
}

}  // namespace

Image decode_pfm(std::string_view bytes) {
  const std::string_view magic = next_word(bytes);
  if (magic != "PF" && magic != "Pf") throw std::runtime_error("it is not a PFM file");
  const std::size_t channels = magic == "PF" ? 3 : 1;
  Image image;
  image.width = parse<int>(next_word(bytes));
  image.height = parse<int>(next_word(bytes));
  const float scale = parse<float>(next_word(bytes));
  if (image.width <= 0 || image.height <= 0 || !std::isfinite(scale) || scale == 0)
    throw std::runtime_error("its header is damaged");

  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  // By division, since the product of both and of 12 may pass 64 bits.
  if (height > bytes.size() / (4 * channels) / width) throw std::runtime_error("it ends before its last pixel");
  image.pixels.resize(width * height * 3);
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t i = 0; i < width * 3; ++i) {
      const std::size_t from = ((height - 1 - y) * width * channels) + (channels == 3 ? i : i / 3);
      image.pixels[y * width * 3 + i] = std::abs(scale) * load_float(bytes.data() + 4 * from, scale < 0);
    }
  return image;
}

}  // namespace brume

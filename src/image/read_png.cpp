// PNG by libpng, of all its kinds: palettes and greys become RGB, alpha is left out. As in write_png.cpp, the functions
// that libpng can leave by longjmp hold no destructors.
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "image/formats.h"

namespace brume {

namespace {

struct Input {
  std::string_view rest;
  std::string error;
};

struct Header {
  png_uint_32 width = 0, height = 0;
  int bits_per_pixel = 0;  // in the file
};

void on_error(png_structp png, png_const_charp message) {
  auto* input = static_cast<Input*>(png_get_error_ptr(png));
  try {
    input->error = message;
  } catch (...) {  // out of memory: the caller sees a failure without words
  }
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep to, size_t size) {
  auto* input = static_cast<Input*>(png_get_io_ptr(png));
  if (size > input->rest.size()) png_error(png, "the file ends too early");
  std::memcpy(to, input->rest.data(), size);
  input->rest.remove_prefix(size);
}

bool read_header(png_structp png, png_infop info, Input& input, Header& header) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_read_fn(png, &input, on_read);
  png_read_info(png, info);
  header.width = png_get_image_width(png, info);
  header.height = png_get_image_height(png, info);
  header.bits_per_pixel = png_get_bit_depth(png, info) * png_get_channels(png, info);
  return true;
}

// To 3 values of 8 or 16 bits a pixel; `row_bytes` is then the size of a row.
bool set_up(png_structp png, png_infop info, size_t& row_bytes, int& bits) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_expand(png);
  png_set_strip_alpha(png);
  png_set_gray_to_rgb(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  row_bytes = png_get_rowbytes(png, info);
  bits = png_get_bit_depth(png, info);
  return true;
}

bool read_rows(png_structp png, png_bytep* rows) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_read_image(png, rows);
  png_read_end(png, nullptr);
  return true;
}

// IEC 61966-2-1, or a power.
double linear_value(double stored, double gamma) {
  if (gamma != 0) return std::pow(stored, gamma);
  return stored <= 0.04045 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4);
}

// Deflate packs at most 1032 bytes into one.
void check_size(const Header& h, std::size_t file_bytes) {
  constexpr std::uint64_t max_pixels = std::uint64_t{1} << 26;
  const std::uint64_t pixels = std::uint64_t{h.width} * h.height;
  if (pixels > max_pixels) throw std::runtime_error("it has more than 67108864 pixels");
  if (pixels * static_cast<unsigned>(h.bits_per_pixel) / 8 > std::uint64_t{file_bytes} * 1032)
    throw std::runtime_error("it is too short for its size");
}

// libpng makes room for a chunk before it reads it: none may claim more than the file has. A chunk is: length
// (big-endian), name of 4 bytes, data, check sum of 4 bytes. Where the signature is wrong, libpng says so.
void check_chunks(std::string_view bytes) {
  constexpr std::size_t signature = 8, around_data = 12;
  if (bytes.size() < signature || png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, signature)) return;
  std::string_view name;
  for (std::string_view rest = bytes.substr(signature); !rest.empty() && name != "IEND";) {
    if (rest.size() < around_data) throw std::runtime_error("the file ends too early");
    const std::size_t length = png_get_uint_32(reinterpret_cast<png_const_bytep>(rest.data()));
    if (length > rest.size() - around_data) throw std::runtime_error("the file ends too early");
    name = rest.substr(4, 4);
    rest.remove_prefix(length + around_data);
  }
}

struct Reader {
  Input input;
  png_structp png = nullptr;
  png_infop info = nullptr;

  explicit Reader(std::string_view bytes) : input{bytes, {}} {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, on_error, on_warning);
    info = png ? png_create_info_struct(png) : nullptr;
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }

  void check(bool done) const {
    if (!done) throw std::runtime_error(input.error.empty() ? "out of memory" : input.error);
  }
};

}  // namespace

Image decode_png(std::string_view bytes, double gamma) {
  check_chunks(bytes);
  Reader reader(bytes);
  Header header;
  size_t row_bytes = 0;
  int bits = 0;
  reader.check(reader.info && read_header(reader.png, reader.info, reader.input, header));
  check_size(header, bytes.size());
  reader.check(set_up(reader.png, reader.info, row_bytes, bits));
  std::vector<png_byte> values(row_bytes * header.height);
  std::vector<png_bytep> rows(header.height);
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = values.data() + y * row_bytes;
  reader.check(read_rows(reader.png, rows.data()));

  const std::size_t levels = std::size_t{1} << bits;
  std::vector<float> linear(levels);
  for (std::size_t i = 0; i < levels; ++i)
    linear[i] = static_cast<float>(linear_value(static_cast<double>(i) / static_cast<double>(levels - 1), gamma));
  Image image{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  image.pixels.resize(std::size_t{header.width} * header.height * 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = linear[bits == 8 ? values[i] : values[2 * i] * std::size_t{256} + values[2 * i + 1]];
  return image;
}

}  // namespace brume

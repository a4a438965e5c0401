// PNG by libpng: 8 bits, with the chunk that says sRGB. libpng reports errors by longjmp, which must not cross C++
// frames that hold destructors: encode() is the only function that it can leave in this way, and it has none.
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "image/formats.h"

namespace brume {

namespace {

// What libpng's callbacks write to, and what goes into the file.
struct Output {
  std::string bytes;
  std::string error;
};

struct Input {
  png_uint_32 width, height;
  const png_byte* const* rows;
  png_textp texts;
  int text_count;
};

void on_error(png_structp png, png_const_charp message) {
  auto* output = static_cast<Output*>(png_get_error_ptr(png));
  try {
    output->error = message;
  } catch (...) {  // out of memory: the caller sees a failure without words
  }
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_write(png_structp png, png_bytep data, size_t size) {
  auto* output = static_cast<Output*>(png_get_io_ptr(png));
  bool done = true;
  try {
    output->bytes.append(reinterpret_cast<const char*>(data), size);
  } catch (...) {
    done = false;
  }
  if (!done) png_error(png, "out of memory");  // outside the handler, which longjmp must not leave
}

bool encode(png_structp png, png_infop info, const Input& input, Output& output) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &output, on_write, nullptr);
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(png, info, input.width, input.height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_text(png, info, input.texts, input.text_count);
  png_write_info(png, info);
  for (png_uint_32 y = 0; y < input.height; ++y) png_write_row(png, input.rows[y]);
  png_write_end(png, info);
  return true;
}

png_text text(const char* key, std::string& value) {
  png_text t{};
  t.compression = PNG_TEXT_COMPRESSION_NONE;
  t.key = const_cast<png_charp>(key);  // libpng copies both
  t.text = value.data();
  t.text_length = value.size();
  return t;
}

std::string comment(const ImageMetadata& metadata) {
  return fmt::format("{} samples per pixel, seed {}, {:.1f} s{}{}", metadata.samples_per_pixel, metadata.seed,
                     metadata.render_time_seconds,
                     metadata.exposure == 0 ? "" : fmt::format(", exposure {:+g}", metadata.exposure),
                     metadata.partial ? ", partial: stopped before its end" : "");
}

void to_rec709(ColourSpace space, std::vector<float>& pixels) {
  const Matrix3 matrix = rec709_from(space, Whites::kept);
  for (std::size_t i = 0; i + 2 < pixels.size(); i += 3) {
    const Vector3 rgb = matrix * Vector3{static_cast<double>(pixels[i]), static_cast<double>(pixels[i + 1]),
                                         static_cast<double>(pixels[i + 2])};
    for (int c = 0; c < 3; ++c) pixels[i + static_cast<std::size_t>(c)] = static_cast<float>(rgb[c]);
  }
}

}  // namespace

std::uint8_t srgb_from_linear(float linear) {
  if (!(linear > 0)) return 0;
  const double x = std::min(static_cast<double>(linear), 1.0);
  const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

std::string encode_png(const Image& image, const ImageMetadata& metadata) {
  std::vector<float> pixels = image.pixels;
  if (metadata.colour_space != ColourSpace::srgb) to_rec709(metadata.colour_space, pixels);
  const auto gain = static_cast<float>(std::exp2(metadata.exposure));
  std::vector<png_byte> values(pixels.size());
  std::transform(pixels.begin(), pixels.end(), values.begin(),
                 [gain](float value) { return srgb_from_linear(gain * value); });
  std::vector<const png_byte*> rows;
  for (int y = 0; y < image.height; ++y)
    rows.push_back(values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) * 3);
  std::string software = metadata.software, made = comment(metadata);
  png_text texts[] = {text("Software", software), text("Comment", made)};
  const Input input{static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), rows.data(), texts,
                    metadata.samples_per_pixel > 0 ? 2 : 1};  // a plot was not sampled

  Output output;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  const bool done = info && encode(png, info, input, output);
  png_destroy_write_struct(&png, &info);
  if (!done) throw std::runtime_error(output.error.empty() ? "out of memory" : output.error);
  return std::move(output.bytes);
}

}  // namespace brume

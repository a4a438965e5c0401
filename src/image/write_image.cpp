#include <fmt/format.h>

#include "base/diagnostics.h"
#include "base/file.h"
#include "image/formats.h"

namespace brume {

void check_image_suffix(const std::string& path) {
  const std::string s = suffix(path);
  if (s == ".exr" || s == ".png" || s == ".pfm") return;
  throw InputError(path,
                   fmt::format("{}; pictures are written as {}",
                               s.empty() ? "no suffix" : fmt::format("unknown suffix \"{}\"", s), image_suffixes));
}

void write_image(const std::string& path, const Image& image, const ImageMetadata& metadata) {
  check_image_suffix(path);
  const std::string s = suffix(path);
  std::string bytes;
  try {
    bytes = s == ".exr" ? encode_exr(image, metadata) : s == ".png" ? encode_png(image, metadata) : encode_pfm(image);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError(path, fmt::format("cannot be written: {}", e.what()));
  }
  write_file_atomically(path, bytes);
}

}  // namespace brume

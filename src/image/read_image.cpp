#include <string_view>

#include "base/diagnostics.h"
#include "base/file.h"
#include "base/memory.h"
#include "image/formats.h"

namespace brume {

namespace {

// OpenEXR begins with `Cannot read image file "". ` and the like: it has no name for what it reads from memory.
std::string without_empty_name(const std::string& message) {
  constexpr std::string_view nameless = "image file \"\". ";
  const std::size_t at = message.find(nameless);
  return at == std::string::npos ? message : message.substr(at + nameless.size());
}

// What `decode` makes of the file's bytes; what it throws becomes an InputError.
template <class Decode>
auto decode_file(const std::string& path, Decode&& decode) {
  const std::string bytes = read_file(path);
  try {
    return read_within_memory(path, [&] { return decode(bytes); });
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError(path, "cannot be read: " + without_empty_name(e.what()));
  }
}

}  // namespace

Image read_image(const std::string& path) {
  const std::string s = suffix(path);
  if (s != ".exr" && s != ".pfm") throw InputError(path, "pictures are read from .exr and .pfm files");
  return decode_file(path, s == ".exr" ? decode_exr : decode_pfm);
}

ExrHeader read_exr_header(const std::string& path) { return decode_file(path, decode_exr_header); }

Image read_encoded_image(const std::string& path, double gamma) {
  const std::string s = suffix(path);
  if (s == ".png") return decode_file(path, [gamma](std::string_view bytes) { return decode_png(bytes, gamma); });
  if (s != ".exr" && s != ".pfm") throw InputError(path, "pictures are read from .exr, .pfm and .png files");
  return read_image(path);
}

ImageMetadata read_image_metadata(const std::string& path) {
  if (suffix(path) != ".exr") throw InputError(path, "only .exr files say how they were made");
  return decode_file(path, decode_exr_metadata);
}

}  // namespace brume

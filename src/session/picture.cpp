#include "session/picture.h"

#include "base/file.h"
#include "session/errors.h"

namespace brume {

void Picture::write(const std::string& path, double exposure) const {
  with_public_errors([&] {
    ImageMetadata file_metadata = metadata ? metadata->image : ImageMetadata{};
    file_metadata.exposure = exposure;
    write_image(path, Image{width, height, pixels, variance, alpha, depth}, file_metadata);
  });
}

void Picture::check_output(const std::string& path) {
  with_public_errors([&] {
    check_writable(path);
    check_image_suffix(path);
  });
}

}  // namespace brume

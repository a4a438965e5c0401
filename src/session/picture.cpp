#include "session/picture.h"

#include "base/file.h"
#include "session/errors.h"

namespace brume {

void Picture::write(const std::string& path) const {
  with_public_errors([&] {
    write_image(path, Image{width, height, pixels, variance, alpha, depth},
                metadata ? metadata->image : ImageMetadata{});
  });
}

void Picture::check_output(const std::string& path) {
  with_public_errors([&] {
    check_image_suffix(path);
    check_writable(path);
  });
}

}  // namespace brume

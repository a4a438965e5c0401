// A picture in memory and its files.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/geometry.h"

namespace brume {

// Scene-linear Rec.709, rows from the top, three floats a pixel.
struct Image {
  int width = 0, height = 0;
  std::vector<float> pixels;  // width * height * 3
};

// What a picture's file says of how it was made.
struct ImageMetadata {
  int samples_per_pixel = 0;
  double render_time_seconds = 0;
  Transform camera_from_world;  // EXR worldToCamera
  // EXR worldToNDC, a projective matrix for columns: x, y in [0, 1] across the picture, y down, after division by w.
  std::array<std::array<double, 4>, 4> ndc_from_world{};
  std::uint32_t seed = 0;
  bool partial = false;  // the render was interrupted
  bool half = true;      // EXR only: 16-bit floats
  std::string software;
};

// Writes .exr, .png (sRGB, 8 bits) or .pfm by the suffix of `path`, whole or not at all. Throws InputError for another
// suffix (naming the three) and for whatever the file system refuses.
void write_image(const std::string& path, const Image& image, const ImageMetadata& metadata);

// Reads .exr (channels R, G, B) or .pfm. Throws InputError.
Image read_image(const std::string& path);

}  // namespace brume

// A picture in memory and its files.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/colour_space.h"
#include "base/geometry.h"

namespace brume {

// Scene-linear, in Rec.709 or in the colour space of its metadata; rows from the top, three floats a pixel.
struct Image {
  int width = 0, height = 0;
  std::vector<float> pixels;      // width * height * 3
  std::vector<float> variance{};  // of each of the pixels' values; NaN where it is not known; empty: of none
  // One a pixel, or empty. Alpha is the share of the pixel that surfaces and media cover, what they let through left
  // out; depth the mean distance along the camera's axis of what covers it, in world units, infinite where nothing
  // does.
  std::vector<float> alpha{}, depth{};
};

// What a picture's file says of how it was made. A PNG holds it as text, a PFM has no place for it.
struct ImageMetadata {
  int samples_per_pixel = 0;
  double render_time_seconds = 0;
  Transform camera_from_world;  // EXR worldToCamera
  // EXR worldToNDC, a projective matrix for columns: x, y in [0, 1] across the picture, y down, after division by w.
  // Of perspective cameras only.
  std::optional<std::array<std::array<double, 4>, 4>> ndc_from_world{};
  std::uint32_t seed = 0;
  ColourSpace colour_space = ColourSpace::srgb;  // of the pixels; EXR chromaticities. A PNG is turned into sRGB
  // EXR only, of a picture that is a part of a larger one (dataWindow within displayWindow): the place of its first
  // pixel, and the size of the whole; 0: it is whole.
  int x = 0, y = 0, whole_width = 0, whole_height = 0;
  bool partial = false;  // not all of the samples asked for
  bool half = true;      // EXR only: 16-bit floats
  double exposure = 0;   // PNG only: in stops; values are multiplied by 2^exposure
  std::string software;
};

// The suffixes that write_image knows, ready to be shown.
constexpr const char* image_suffixes = ".exr, .png and .pfm";

// Throws InputError unless `path` ends in one of them.
void check_image_suffix(const std::string& path);

// Writes .exr, .png (sRGB, 8 bits, opaque) or .pfm by the suffix of `path`, whole or not at all. Into an .exr go alpha
// as channel A, depth as Z and the variance as the layer Variance (channels Variance.R, .G and .B), the latter two as
// 32-bit floats; the others have no place for them. Throws InputError for another suffix (naming the three) and for
// whatever the file system refuses.
void write_image(const std::string& path, const Image& image, const ImageMetadata& metadata);

// Reads .exr (channels R, G and B of a flat picture, and A, Z and its layer Variance where there are) or .pfm (a grey
// one gives three equal channels). Throws InputError.
Image read_image(const std::string& path);

// The same, and .png, of at most 2^26 pixels, whose values of 8 or 16 bits stand for linear ones: by sRGB's curve where
// `gamma` is 0, else as these to that power. Alpha is left out. Throws InputError.
Image read_encoded_image(const std::string& path, double gamma);

// What an .exr says of how it was made; what it does not say is as in a new ImageMetadata. Throws InputError.
ImageMetadata read_image_metadata(const std::string& path);

// The sRGB encoding (IEC 61966-2-1) of a linear value in 8 bits; what lies outside [0, 1] is clamped, NaN gives 0.
std::uint8_t srgb_from_linear(float linear);

}  // namespace brume

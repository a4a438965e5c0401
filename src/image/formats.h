// The file formats by themselves, from and to bytes in memory: a writer that never touches the disk has no write error
// to miss. Each throws std::exception with what is wrong, without the file's name.
#pragma once

#include <string>
#include <string_view>

#include "image/exr_header.h"
#include "image/image.h"

namespace brume {

std::string encode_exr(const Image& image, const ImageMetadata& metadata);
std::string encode_png(const Image& image, const ImageMetadata& metadata);
std::string encode_pfm(const Image& image);

Image decode_exr(std::string_view bytes);
ExrHeader decode_exr_header(std::string_view bytes);
ImageMetadata decode_exr_metadata(std::string_view bytes);
Image decode_pfm(std::string_view bytes);
// 0 is sRGB's gamma (see read_encoded_image).
Image decode_png(std::string_view bytes, double gamma);

}  // namespace brume

// The header of an OpenEXR file, as text to be shown.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace brume {

struct ExrAttribute {
  std::string name, type;  // as the file has them
  std::string value;       // empty where the type is none of int, float, double, string and m44f
};

struct ExrHeader {
  std::array<int, 4> data_window{}, display_window{};         // x0 y0 x1 y1, both ends included
  std::vector<std::pair<std::string, std::string>> channels;  // name and "half", "float" or "uint"
  std::vector<ExrAttribute> attributes;                       // those that every file has left out
};

// Throws InputError.
ExrHeader read_exr_header(const std::string& path);

}  // namespace brume

#include <fmt/format.h>

#include "base/file.h"
#include "image/exr_header.h"
#include "image/image.h"
#include "scene/messages.h"
#include "session/describe_file.h"

namespace brume {

namespace {

// x0, y0 to x1, y1, both included, as OpenEXR has windows.
std::string text(const std::array<int, 4>& window) {
  return fmt::format("({}, {}) to ({}, {})", window[0], window[1], window[2], window[3]);
}

std::string describe_exr(const std::string& path) {
  const ExrHeader header = read_exr_header(path);
  const auto& [x0, y0, x1, y1] = header.data_window;
  std::string lines = fmt::format("{}: picture of {} x {} pixels\n", path, x1 - x0 + 1, y1 - y0 + 1);
  lines += fmt::format("  data window {}, display window {}\n", text(header.data_window), text(header.display_window));
  lines += "  channels:";
  const char* separator = " ";
  for (const auto& [name, type] : header.channels) {
    lines += fmt::format("{}{} {}", separator, printable(name), type);
    separator = ", ";
  }
  lines += "\n";
  for (const ExrAttribute& a : header.attributes) {
    const std::string value = a.type == "string" ? printable(a.value) : a.value;
    lines += fmt::format("  {}: {}\n", printable(a.name), value.empty() ? "of type " + printable(a.type) : value);
  }
  return lines;
}

}  // namespace

std::string describe_picture(const std::string& path) {
  if (suffix(path) == ".exr") return describe_exr(path);
  const Image image = read_image(path);
  return fmt::format("{}: picture of {} x {} pixels\n", path, image.width, image.height);
}

}  // namespace brume

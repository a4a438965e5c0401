// What the readers of .ply and .obj files share.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "base/geometry.h"

namespace brume {

// What is wrong with the file, without its name.
struct Fault {
  std::string message;
};

// The text of a file, taken from its front.
class Text {
 public:
  explicit Text(std::string_view rest) : rest_(rest) {}

  // The next line, without its end, which may be that of any system.
  std::string_view line() {
    const std::size_t length = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, length);
    rest_.remove_prefix(std::min(length + 1, rest_.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  // The next word, "" at the end.
  std::string_view word() {
    constexpr std::string_view blanks = " \t\r\n";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(blanks));
    rest_.remove_prefix(word.size());
    return word;
  }

  std::string_view bytes(std::size_t count) {
    if (count > rest_.size()) return {};
    const std::string_view bytes = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return bytes;
  }

  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

// The number that the word is. Throws Fault.
double number(std::string_view word);

// Coordinates that a float can hold. Throw Fault.
Vector3 finite(double x, double y, double z);
std::array<double, 2> finite_uv(double u, double v);

}  // namespace brume

#include "scene/mesh_text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace brume {

double number(std::string_view word) {
  if (word.empty()) throw Fault{"ends before its last value"};
  double value = 0;
  const char* begin = word.data() + (word.front() == '+' ? 1 : 0);
  const auto [end, code] = std::from_chars(begin, word.data() + word.size(), value);
  if (code != std::errc() || end != word.data() + word.size())
    throw Fault{fmt::format("has \"{}\" where a number should be", word.substr(0, 40))};
  return value;
}

Vector3 finite(double x, double y, double z) {
  for (const double v : {x, y, z})
    if (!(std::abs(v) <= static_cast<double>(std::numeric_limits<float>::max())))  // also where it is not a number
      throw Fault{"has a vertex that is not finite"};
  return {x, y, z};
}

std::array<double, 2> finite_uv(double u, double v) {
  finite(u, v, 0);
  return {u, v};
}

}  // namespace brume

// A parameter that something takes by name.
#pragma once

#include <map>
#include <string>

namespace brume {

struct ParameterInfo {
  std::string name, meaning;
  std::string unit;  // "1" for numbers without one
  double lo = 0, hi = 0, fallback = 0;
  bool ends_included = true;  // whether lo and hi themselves are allowed
};

using ParameterValues = std::map<std::string, double>;

}  // namespace brume

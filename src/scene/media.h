// What the readers of media share.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "scene/description.h"
#include "scene/parameters.h"

namespace brume {

// The values that cells may have, and whether others are taken as 0, with a warning, or are an error.
struct CellRange {
  Range range;
  bool sanitize = false;
};

// One value for each cell, or three where the type is rgb, x fastest, from a parameter of many; empty where it is
// missing or at fault.
std::vector<float> read_cells(ParameterList& p, std::string_view name, const std::array<int, 3>& resolution,
                              const CellRange& allowed, ParameterType type = ParameterType::float_);

// What the parameter names, `fallback` where it is not given.
GivenName grid_name(ParameterList& p, std::string_view parameter, const std::string& fallback);

// Le, Lescale and what makes emission of temperatures, of a medium whose kind has been read.
void read_emission(ParameterList& p, MediumDescription& medium);

}  // namespace brume

// The phase functions by kind: their names, parameters and ranges, and how a scene's values become the four numbers p
// that the kernel takes. Generated from the folder phase/: a new file there is a new phase function here.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace brume {

// A parameter that a scene may give, from lo to hi; the ends themselves are allowed only where ends_included.
struct PhaseParameter {
  std::string_view name, meaning, unit;
  double lo = 0, hi = 0;
  float fallback = 0;
  bool ends_included = false;
};

constexpr int max_phase_parameters = 4;
using PhasePrepared = std::array<float, 4>;

struct PhaseFunction {
  std::string_view name, meaning;
  PhaseParameter parameters[max_phase_parameters] = {};  // the first with an empty name ends the list
};

struct PhaseEntry {
  PhaseFunction table;
  // From one value for each parameter, in the table's order and within its ranges.
  PhasePrepared (*prepare)(const float* values);
};

// All phase functions, in alphabetical order; the index is the kind.
std::span<const PhaseEntry> phase_functions();

// The kind of the phase function called `name`, or -1.
int phase_kind(std::string_view name);

}  // namespace brume

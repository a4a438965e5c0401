// Indices of refraction that scenes give by the name of a spectrum.
#pragma once

#include <span>
#include <string_view>

#include "base/spectrum.h"

namespace brume {

// By its complex index, eta + i k.
struct Metal {
  std::string_view name;
  Spectrum eta, k;
};
std::span<const Metal> metals();
// The metal of a conductor that names none.
const Metal& copper();

struct Glass {
  std::string_view name;
  float eta;
};
std::span<const Glass> glasses();

}  // namespace brume

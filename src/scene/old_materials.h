// Materials of pbrt-v3 and before, as those of today.
#pragma once

#include <string_view>
#include <vector>

#include "scene/parameters.h"

namespace brume {

struct OldMaterial {
  std::string_view name, now;
  std::vector<Parameter> defaults{};        // where they are not those of today
  std::vector<std::string_view> dropped{};  // parameters without a counterpart
};

// Null for a name that is none of them.
const OldMaterial* find_old_material(std::string_view name);

// Gives parameters the names and defaults that the counterpart takes; those without one are warned of.
void translate(const OldMaterial& material, ParameterList& p);

}  // namespace brume

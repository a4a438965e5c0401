// Names and values that callers give, held against what there is.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "brume/parameter.h"

namespace brume {

// The index of `name` among `valid`. Throws Error, which calls it a `what` and names the nearest or all.
std::size_t find_name(const std::string& what, const std::string& name, const std::vector<std::string_view>& valid);

// A value for each parameter of `owner`: what `given` has, else the default. Throws Error for a name that is none of
// theirs and for a value out of range.
std::vector<float> parameter_values(const std::string& owner, const std::vector<ParameterInfo>& parameters,
                                    const ParameterValues& given);

}  // namespace brume

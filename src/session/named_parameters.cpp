#include "session/named_parameters.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/diagnostics.h"
#include "session/errors.h"

namespace brume {

namespace {

// "; did you mean NAME?", or the names.
std::string advice(const std::string& name, const std::vector<std::string_view>& valid) {
  const std::string_view nearest = nearest_name(name, valid);
  if (!nearest.empty()) return fmt::format("; did you mean {}?", nearest);
  return valid.empty() ? "; it has none" : fmt::format("; known are {}", fmt::join(valid, ", "));
}

// The value as a float, which is what is computed with and must be in range too.
float checked(const std::string& owner, const ParameterInfo& p, double value) {
  const auto rounded = static_cast<float>(value);
  const auto in_range = [&](double v) { return p.ends_included ? v >= p.lo && v <= p.hi : v > p.lo && v < p.hi; };
  if (!in_range(value) || !in_range(static_cast<double>(rounded)))
    fail(fmt::format("{} of {} must be {} {} {} {}, found {}", p.name, owner, p.ends_included ? "from" : "above", p.lo,
                     p.ends_included ? "to" : "and below", p.hi, value));
  return rounded;
}

}  // namespace

std::size_t find_name(const std::string& what, const std::string& name, const std::vector<std::string_view>& valid) {
  const auto found = std::find(valid.begin(), valid.end(), name);
  if (found == valid.end()) fail(fmt::format("unknown {} \"{}\"{}", what, name, advice(name, valid)));
  return static_cast<std::size_t>(found - valid.begin());
}

std::vector<float> parameter_values(const std::string& owner, const std::vector<ParameterInfo>& parameters,
                                    const ParameterValues& given) {
  std::vector<float> values;
  std::vector<std::string_view> names;
  for (const ParameterInfo& p : parameters) {
    const auto found = given.find(p.name);
    values.push_back(checked(owner, p, found == given.end() ? p.fallback : found->second));
    names.push_back(p.name);
  }
  for (const auto& [name, value] : given)
    if (std::find(names.begin(), names.end(), name) == names.end())
      fail(fmt::format("{} has no parameter \"{}\"{}", owner, name, advice(name, names)));
  return values;
}

}  // namespace brume

#include "brume/phase.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernel/phase_table.h"
#include "kernel/scalar.h"
#include "session/named_parameters.h"

namespace brume {

namespace {

struct PhaseKernel {
  float (*eval)(float mu, kernel::vec4 p);
  float (*mean_cosine)(kernel::vec4 p);
};
// In the order of phase_functions().
constexpr PhaseKernel kernels[] = {
#define PHASE(name) {kernel::name##_eval, kernel::name##_mean_cosine},
#include "kernel/phase_list.inl"
#undef PHASE
};

std::vector<ParameterInfo> parameters_of(const PhaseFunction& phase) {
  std::vector<ParameterInfo> parameters;
  for (const PhaseParameter& p : phase.parameters)
    if (!p.name.empty())
      parameters.push_back({std::string(p.name), std::string(p.meaning), std::string(p.unit), p.lo, p.hi,
                            static_cast<double>(p.fallback), p.ends_included});
  return parameters;
}

}  // namespace

std::vector<PhaseInfo> phase_infos() {
  std::vector<PhaseInfo> infos;
  for (const PhaseEntry& entry : phase_functions())
    infos.push_back({std::string(entry.table.name), std::string(entry.table.meaning), parameters_of(entry.table)});
  return infos;
}

PhaseCurve phase_curve(const std::string& name, const ParameterValues& parameters, int count) {
  std::vector<std::string_view> names;
  for (const PhaseEntry& entry : phase_functions()) names.push_back(entry.table.name);
  const std::size_t kind = find_name("phase function", name, names);
  const PhaseEntry& entry = phase_functions()[kind];
  const std::vector<ParameterInfo> infos = parameters_of(entry.table);
  const std::vector<float> values = parameter_values(name, infos, parameters);
  const PhasePrepared q = entry.prepare(values.data());
  const kernel::vec4 p{q[0], q[1], q[2], q[3]};

  PhaseCurve curve;
  curve.title = name;
  for (std::size_t i = 0; i < infos.size(); ++i)
    curve.title +=
        fmt::format(", {} = {:g}{}", infos[i].name, values[i], infos[i].unit == "1" ? "" : " " + infos[i].unit);
  curve.mean_cosine = static_cast<double>(kernels[kind].mean_cosine(p));
  for (int i = 0; i < count; ++i) {
    const double angle = 180.0 * i / (count - 1), mu = std::cos(angle * std::numbers::pi / 180);
    curve.angles.push_back(angle);
    curve.values.push_back(static_cast<double>(kernels[kind].eval(static_cast<float>(mu), p)));
  }
  return curve;
}

Decades decades(const PhaseCurve& curve) {
  const auto [least, most] = std::minmax_element(curve.values.begin(), curve.values.end());
  const auto exponent = [](double value) { return std::log10(std::max(value, 1e-12)); };
  const int lo = static_cast<int>(std::floor(exponent(*least)));
  return {lo, std::max(lo + 1, static_cast<int>(std::ceil(exponent(*most))))};
}

}  // namespace brume

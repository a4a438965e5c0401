// Every phase function of the folder src/kernel/phase over a spread of its parameters, and its density in double.
#pragma once

#include <array>
#include <cmath>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/phase_table.h"
#include "kernel/scalar.h"

namespace brume {

struct PhaseCase {
  std::string name;  // "henyey_greenstein_2"
  kernel::vec4 p;
  float (*eval)(float mu, kernel::vec4 p);
  float (*sample)(float u, kernel::vec4 p);
  float (*mean_cosine)(kernel::vec4 p);
};

// How GoogleTest shows and names a case.
inline void PrintTo(const PhaseCase& phase, std::ostream* out) { *out << phase.name; }
constexpr auto phase_case_name = [](const auto& parameter) { return parameter.param.name; };

// Where in a parameter's range the cases lie; for -1 to 1: -0.99, -0.75, ..., 0.99.
constexpr std::array<double, 9> phase_spread{0.005, 0.125, 0.4, 0.5, 0.5005, 0.65, 0.755, 0.875, 0.995};

using PhaseValues = std::array<float, max_phase_parameters>;

// Values besides the spread: ends of ranges, and what even steps do not reach.
struct ChosenPhase {
  std::string_view name;
  PhaseValues values;
};
constexpr std::array chosen_phases{
    ChosenPhase{"draine", {1e-4f, 250}},
    ChosenPhase{"draine", {-0.95f, 250}},
    ChosenPhase{"draine", {0.95f, 20}},
    ChosenPhase{"mie", {0.1f}},
    ChosenPhase{"mie", {1.5f}},
    ChosenPhase{"two_lobe", {0.9f, -0.5f, 1}},
    ChosenPhase{"two_lobe", {0.9f, -0.5f, 0}},
};

// The phase function `name` at values for its parameters.
inline PhaseCase phase_case(std::string_view name, const PhaseValues& values) {
#define PHASE(name) {#name, {}, kernel::name##_eval, kernel::name##_sample, kernel::name##_mean_cosine},
  static const std::vector<PhaseCase> kinds = {
#include "kernel/phase_list.inl"
  };
#undef PHASE
  const auto kind = static_cast<std::size_t>(phase_kind(name));
  PhaseCase phase = kinds[kind];
  const PhasePrepared p = phase_functions()[kind].prepare(values.data());
  phase.p = {p[0], p[1], p[2], p[3]};
  return phase;
}

// The i-th values of the spread, which each parameter takes in another order.
inline PhaseValues spread_values(const PhaseFunction& table, std::size_t i) {
  PhaseValues values{};
  for (std::size_t j = 0; j < values.size(); ++j) {
    const PhaseParameter& parameter = table.parameters[j];
    const double at = phase_spread[(i * (2 * j + 1) + j) % phase_spread.size()];
    values[j] = static_cast<float>(parameter.lo + at * (parameter.hi - parameter.lo));
  }
  return values;
}

inline std::vector<PhaseCase> phase_cases() {
  std::vector<PhaseCase> cases;
  for (const PhaseEntry& entry : phase_functions()) {
    const bool has_parameters = !entry.table.parameters[0].name.empty();
    std::vector<PhaseValues> all;
    for (std::size_t i = 0; i < (has_parameters ? phase_spread.size() : 1); ++i)
      all.push_back(spread_values(entry.table, i));
    for (const ChosenPhase& chosen : chosen_phases)
      if (chosen.name == entry.table.name) all.push_back(chosen.values);
    for (std::size_t i = 0; i < all.size(); ++i) {
      cases.push_back(phase_case(entry.table.name, all[i]));
      cases.back().name.append("_").append(std::to_string(i));
    }
  }
  return cases;
}

// The case of Henyey-Greenstein at mean cosine g.
inline PhaseCase henyey_greenstein_case(float g) { return phase_case("henyey_greenstein", {g}); }

// The density of mu in double, 2 pi eval(mu), where its power -2/3 is linear between neighbouring floats, as that of
// Henyey-Greenstein is everywhere: near the peak of a narrow lobe rounding mu to a float would change the density by
// more than the tests allow, and so would a straight line across the peak's curve.
inline double phase_density(const PhaseCase& phase, double mu) {
  const float below = std::nextafter(static_cast<float>(mu), -2.0f);
  const float a = std::fmax(below, -1.0f);
  const float b = std::fmin(std::nextafter(static_cast<float>(mu), 2.0f), 1.0f);
  const double fraction = (mu - a) / (static_cast<double>(b) - a);
  const auto power = [&](float x) {
    const double density = phase.eval(x, phase.p);
    return 1 / std::cbrt(density * density);
  };
  const double power_here = (1 - fraction) * power(a) + fraction * power(b);
  return 2 * 3.14159265358979324 / (power_here * std::sqrt(power_here));
}

// Points from -1 to 1 that crowd towards both ends, as lobes do: between them a density is nearly straight. Each lies
// halfway between two floats (the ends apart), so that no sample falls on one.
inline std::vector<double> phase_lattice() {
  constexpr int halvings = 17, parts = 64;
  std::vector<double> positive{0};
  for (int k = 0; k <= halvings; ++k) {
    const double begin = 1 - std::ldexp(1.0, -k);
    const double end = k == halvings ? 1 : 1 - std::ldexp(1.0, -k - 1);
    for (int i = 1; i <= parts; ++i) positive.push_back(begin + (end - begin) * i / parts);
  }
  std::vector<double> lattice;
  for (std::size_t i = positive.size(); i-- > 1;) lattice.push_back(-positive[i]);
  lattice.insert(lattice.end(), positive.begin(), positive.end());
  for (std::size_t i = 1; i + 1 < lattice.size(); ++i) {
    const float f = static_cast<float>(lattice[i]);
    lattice[i] = 0.5 * (static_cast<double>(f) + std::nextafter(f, 2.0f));
  }
  return lattice;
}

// The integral of weight(mu) times the density over [lo, hi] by three-point Gauss-Legendre quadrature.
template <class Weight>
double phase_integral(const PhaseCase& phase, double lo, double hi, Weight weight) {
  const double middle = 0.5 * (lo + hi), reach = 0.5 * (hi - lo) * 0.774596669241483377;
  const auto f = [&](double mu) { return weight(mu) * phase_density(phase, mu); };
  return (hi - lo) / 18 * (5 * f(middle - reach) + 8 * f(middle) + 5 * f(middle + reach));
}

// The same over the whole range of mu.
template <class Weight>
double phase_integral(const PhaseCase& phase, Weight weight) {
  const std::vector<double> lattice = phase_lattice();
  double sum = 0;
  for (std::size_t i = 0; i + 1 < lattice.size(); ++i) sum += phase_integral(phase, lattice[i], lattice[i + 1], weight);
  return sum;
}

}  // namespace brume

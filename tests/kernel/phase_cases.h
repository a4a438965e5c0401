// Every phase function of the folder src/kernel/phase over a spread of its parameters, and its density in double.
#pragma once

#include <array>
#include <cmath>
#include <ostream>
#include <span>
#include <string>
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

inline std::vector<PhaseCase> phase_cases() {
  std::vector<PhaseCase> cases;
#define PHASE(name) {#name, {}, kernel::name##_eval, kernel::name##_sample, kernel::name##_mean_cosine},
  const std::vector<PhaseCase> kinds = {
#include "kernel/phase_list.inl"
  };
#undef PHASE
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    const PhaseEntry& entry = phase_functions()[kind];
    const bool has_parameters = !entry.table.parameters[0].name.empty();
    for (std::size_t i = 0; i < (has_parameters ? phase_spread.size() : 1); ++i) {
      std::array<float, max_phase_parameters> values{};
      for (std::size_t j = 0; j < values.size(); ++j) {  // a different order of the spread for each parameter
        const PhaseParameter& parameter = entry.table.parameters[j];
        const double at = phase_spread[(i * (2 * j + 1) + j) % phase_spread.size()];
        values[j] = static_cast<float>(parameter.lo + at * (parameter.hi - parameter.lo));
      }
      const PhasePrepared p = entry.prepare(values.data());
      PhaseCase phase = kinds[kind];
      phase.name.append("_").append(std::to_string(i));
      phase.p = {p[0], p[1], p[2], p[3]};
      cases.push_back(phase);
    }
  }
  return cases;
}

// The case of Henyey-Greenstein at mean cosine g.
inline PhaseCase henyey_greenstein_case(float g) {
  return {"henyey_greenstein",
          {g, 0, 0, 0},
          kernel::henyey_greenstein_eval,
          kernel::henyey_greenstein_sample,
          kernel::henyey_greenstein_mean_cosine};
}

// The density of mu in double, 2 pi eval(mu), linear between neighbouring floats: near the peak of a narrow lobe
// rounding mu to a float would change the density by more than the tests allow.
inline double phase_density(const PhaseCase& phase, double mu) {
  const float below = std::nextafter(static_cast<float>(mu), -2.0f);
  const float a = std::fmax(below, -1.0f);
  const float b = std::fmin(std::nextafter(static_cast<float>(mu), 2.0f), 1.0f);
  const double fraction = (mu - a) / (static_cast<double>(b) - a);
  const double density = (1 - fraction) * phase.eval(a, phase.p) + fraction * phase.eval(b, phase.p);
  return 2 * 3.14159265358979324 * density;
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

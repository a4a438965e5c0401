// What the statistical tests of the kernels share.
#pragma once

#include <cmath>
#include <span>

namespace brume {

// The significance at which each of `tests` tests is made so that all of them together are wrong with probability
// `significance` (Sidak's correction).
inline double sidak(double significance, int tests) { return 1 - std::pow(1 - significance, 1.0 / tests); }

// The probability of a chi-squared statistic at least this large. Relative error a few percent for 100 degrees of
// freedom or more. Source: E. B. Wilson and M. M. Hilferty, PNAS 17, 1931.
inline double chi_squared_p_value(double statistic, double freedom) {
  const double v = 2 / (9 * freedom);
  const double z = (std::cbrt(statistic / freedom) - (1 - v)) / std::sqrt(v);
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

// The probability of a standard normal at least as far from 0.
inline double normal_p_value(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

// Pearson's statistic of counts against probabilities that sum to 1.
inline double chi_squared(std::span<const double> counts, std::span<const double> probabilities, double total) {
  double sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = total * probabilities[i];
    sum += (counts[i] - expected) * (counts[i] - expected) / expected;
  }
  return sum;
}

// How far out samples of `actual` stand in a chi-squared test against `probabilities`: the noncentrality.
inline double noncentrality(std::span<const double> actual, std::span<const double> probabilities, double total) {
  double sum = 0;
  for (std::size_t i = 0; i < actual.size(); ++i)
    sum += (actual[i] - probabilities[i]) * (actual[i] - probabilities[i]) / probabilities[i];
  return total * sum;
}

}  // namespace brume

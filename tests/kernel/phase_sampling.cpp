// Every phase function's sampler follows its own density: Pearson's chi-squared test of 10^6 samples, significance 0.01
// with Sidak's correction over all cases. The faults this catches: a sampler for another parameter (1 % in g at g =
// 0.75), and one whose distribution function is off by one percent.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "kernel/phase_cases.h"
#include "kernel/statistics.h"

namespace brume {
namespace {

constexpr int samples = 1000000;
constexpr double bin_mass = 1.0 / 150;

struct Bins {
  std::vector<double> upper;  // the bins' upper ends; the last is 1
  std::vector<double> probabilities;
};

// Intervals of mu that hold about 1/150 each of the density.
Bins make_bins(const PhaseCase& phase) {
  Bins bins;
  const std::vector<double> lattice = phase_lattice();
  double mass = 0;
  for (std::size_t i = 0; i + 1 < lattice.size(); ++i) {
    mass += phase_integral(phase, lattice[i], lattice[i + 1], [](double) { return 1.0; });
    if (mass < bin_mass && i + 2 < lattice.size()) continue;
    bins.upper.push_back(lattice[i + 1]);
    bins.probabilities.push_back(mass);
    mass = 0;
  }
  return bins;
}

// The density's mass in bins that were made for another one.
std::vector<double> masses(const PhaseCase& phase, const Bins& bins) {
  std::vector<double> result(bins.upper.size());
  const std::vector<double> lattice = phase_lattice();
  std::size_t bin = 0;
  for (std::size_t i = 0; i + 1 < lattice.size(); ++i) {
    if (lattice[i] >= bins.upper[bin]) ++bin;
    result[bin] += phase_integral(phase, lattice[i], lattice[i + 1], [](double) { return 1.0; });
  }
  return result;
}

// The bin that mu lies in. Each step is a selection, not a branch that a random mu would make unpredictable.
std::size_t bin_of(const Bins& bins, double mu) {
  std::size_t bin = 0;
  for (std::size_t step = std::bit_floor(bins.upper.size()); step > 0; step /= 2) {
    const std::size_t next = std::min(bin + step, bins.upper.size() - 1);
    bin = bins.upper[next - 1] < mu ? next : bin;
  }
  return bin;
}

// The p-value of the samples of `sampled` under the density of `phase`. `distort` is applied to the uniform numbers.
template <class Distort>
double p_value(const PhaseCase& phase, const PhaseCase& sampled, Distort distort) {
  const Bins bins = make_bins(phase);
  EXPECT_GE(bins.upper.size(), 100u);
  EXPECT_GE(samples * *std::min_element(bins.probabilities.begin(), bins.probabilities.end()), 5);
  std::vector<double> counts(bins.upper.size());
  for (int i = 0; i < samples; ++i) {
    const float u = kernel::random_uniform(1, 2, static_cast<std::uint32_t>(i), 3);
    const float mu = sampled.sample(distort(u), sampled.p);
    EXPECT_TRUE(mu >= -1 && mu <= 1) << mu;
    ++counts[bin_of(bins, static_cast<double>(mu))];
  }
  const double statistic = chi_squared(counts, bins.probabilities, samples);
  return chi_squared_p_value(statistic, static_cast<double>(counts.size() - 1));
}

float as_is(float u) { return u; }

double significance() { return sidak(0.01, static_cast<int>(phase_cases().size())); }

class PhaseSampling : public testing::TestWithParam<PhaseCase> {};

TEST_P(PhaseSampling, FollowsTheDensity) { EXPECT_GT(p_value(GetParam(), GetParam(), as_is), significance()); }

// A distribution function that is off by eps u (1 - u): noncentrality eps^2 / 3 a sample, 533 here; where u also
// chooses between two lobes that are alike, a quarter of that.
TEST_P(PhaseSampling, DistortedTwinIsRejected) {
  const auto distort = [](float u) { return u + 0.04f * u * (1 - u); };
  EXPECT_LT(p_value(GetParam(), GetParam(), distort), significance());
}

TEST_P(PhaseSampling, EndsOfTheRangeStayInRange) {
  for (const float u : {0.0f, 5.9604645e-8f, 0.5f, 0.99999994f}) {
    const float mu = GetParam().sample(u, GetParam().p);
    EXPECT_TRUE(mu >= -1 && mu <= 1) << "u " << u << " mu " << mu;
  }
}

INSTANTIATE_TEST_SUITE_P(Folder, PhaseSampling, testing::ValuesIn(phase_cases()), phase_case_name);

TEST(PhaseSamplingTwin, OnePercentInGIsRejected) {
  const PhaseCase phase = henyey_greenstein_case(0.75f), twin = henyey_greenstein_case(0.7575f);
  const Bins bins = make_bins(phase);
  EXPECT_GE(noncentrality(masses(twin, bins), bins.probabilities, samples), 100);
  EXPECT_LT(p_value(phase, twin, as_is), significance());
}

}  // namespace
}  // namespace brume

// Every phase function's mean cosine is that of its density, by quadrature to 1e-5, and that of its samples, to four
// standard errors. The fault this catches: a mean cosine that is not the lobe's, such as Schlick's k in place of it.
#include <gtest/gtest.h>

#include "kernel/phase_cases.h"

namespace brume {
namespace {

constexpr double tolerance = 1e-5;
constexpr int samples = 1000000;

double density_mean(const PhaseCase& phase) {
  return phase_integral(phase, [](double mu) { return mu; });
}

struct Mean {
  double value = 0, standard_error = 0;
};

Mean sample_mean(const PhaseCase& phase) {
  double sum = 0, sum_of_squares = 0;
  for (int i = 0; i < samples; ++i) {
    const double mu = phase.sample(kernel::random_uniform(4, 5, static_cast<std::uint32_t>(i), 6), phase.p);
    sum += mu;
    sum_of_squares += mu * mu;
  }
  const double mean = sum / samples;
  return {mean, std::sqrt((sum_of_squares / samples - mean * mean) / samples)};
}

class PhaseMeanCosine : public testing::TestWithParam<PhaseCase> {};

TEST_P(PhaseMeanCosine, IsTheDensitys) {
  EXPECT_NEAR(GetParam().mean_cosine(GetParam().p), density_mean(GetParam()), tolerance);
}

TEST_P(PhaseMeanCosine, IsTheSamples) {
  const Mean mean = sample_mean(GetParam());
  const double expected = GetParam().mean_cosine(GetParam().p);
  EXPECT_LE(std::abs(mean.value - expected), 4 * mean.standard_error)
      << "mean " << mean.value << " error " << mean.standard_error << " expected " << expected;
}

INSTANTIATE_TEST_SUITE_P(Folder, PhaseMeanCosine, testing::ValuesIn(phase_cases()), phase_case_name);

TEST(PhaseMeanCosineTwin, ParameterInPlaceOfTheMeanIsRejected) {
  PhaseCase twin{"schlick", {0.6f, 0, 0, 0}, kernel::schlick_eval, kernel::schlick_sample, nullptr};
  const double k = twin.p.x;
  const Mean mean = sample_mean(twin);
  EXPECT_GT(std::abs(density_mean(twin) - k), 8 * tolerance);
  EXPECT_GT(std::abs(mean.value - k), 8 * mean.standard_error);
}

TEST(PhaseMeanCosineTwin, OnePercentIsRejected) {
  const PhaseCase phase = henyey_greenstein_case(0.75f);
  const Mean mean = sample_mean(phase);
  EXPECT_GT(std::abs(density_mean(phase) - 0.7575), 8 * tolerance);
  EXPECT_GT(std::abs(mean.value - 0.7575), 8 * mean.standard_error);
}

// Where the closed form hands over to the series.
TEST(SchlickMeanCosine, IsSmoothAcrossTheSeriesEnd) {
  for (const double k : {0.49999, 0.5, 0.50001, -0.49999, -0.5}) {
    const double exact = 1 / k + (1 - k * k) / (2 * k * k) * std::log((1 - k) / (1 + k));
    EXPECT_NEAR(kernel::schlick_mean_cosine({static_cast<float>(k), 0, 0, 0}), exact, 1e-6);
  }
}

}  // namespace
}  // namespace brume

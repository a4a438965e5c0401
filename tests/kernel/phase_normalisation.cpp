// Every phase function integrates to 1 over the sphere, to 1e-5. The fault this catches: a wrong factor in front.
#include <gtest/gtest.h>

#include "kernel/phase_cases.h"

namespace brume {
namespace {

constexpr double tolerance = 1e-5;

class PhaseNormalisation : public testing::TestWithParam<PhaseCase> {};

double sphere_integral(const PhaseCase& phase) {
  return phase_integral(phase, [](double) { return 1.0; });
}

TEST_P(PhaseNormalisation, IntegratesToOne) { EXPECT_NEAR(sphere_integral(GetParam()), 1, tolerance); }

TEST_P(PhaseNormalisation, IsNowhereNegative) {
  for (const double mu : phase_lattice()) EXPECT_GE(GetParam().eval(static_cast<float>(mu), GetParam().p), 0.0f);
}

INSTANTIATE_TEST_SUITE_P(Folder, PhaseNormalisation, testing::ValuesIn(phase_cases()), phase_case_name);

// 0.0796 in place of 1 / (4 pi) = 0.0795775: 3e-4 too much.
float rounded_factor_eval(float mu, kernel::vec4 p) {
  return 0.0796f / 0.0795774715f * kernel::henyey_greenstein_eval(mu, p);
}

TEST(PhaseNormalisationTwin, RoundedFactorIsRejected) {
  PhaseCase twin = henyey_greenstein_case(0.75f);
  twin.eval = rounded_factor_eval;
  EXPECT_GT(std::abs(sphere_integral(twin) - 1), 8 * tolerance);
}

}  // namespace
}  // namespace brume

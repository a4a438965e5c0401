// All numbers of the table in cases.h, by every integrator that solves the whole of light transport, volpath on every
// instruction set of the machine. Each case has twins with its fault planted, which must be rejected.
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "lanes/instruction_set.h"
#include "render/cases.h"
#include "render/path_tracers.h"
#include "sanitized.h"

namespace brume {
namespace {

// Standard errors, relative to what is expected: with every commit and in the nightly tests.
constexpr double usual_error = 1e-3, nightly_error = 2e-4;
// Samples that compare a lower instruction set with the best one.
constexpr int few = 10000, nightly_few = 4 * few;

class Transport : public ::testing::TestWithParam<std::tuple<Case, const char*>> {
 protected:
  void SetUp() override {
    const auto& [c, integrator] = GetParam();
    case_ = c;
    case_.scene.integrator.name = integrator;
    for (const char letter : case_.name + integrator)
      case_.scene.sampler.seed = case_.scene.sampler.seed * 31 + static_cast<std::uint32_t>(letter);
  }
  void TearDown() override { use_instruction_set(""); }

  // The sets below the best; none where the integrator has no lanes. Under sanitizers one set is enough, since the
  // others run the same code.
  std::vector<InstructionSet> lower_sets() const {
    if (sanitized || case_.scene.integrator.name != "volpath") return {};
    std::vector<InstructionSet> all = available_instruction_sets();
    all.erase(all.begin());
    return all;
  }

  // Paths are the same on all sets but for rounding: what a lower set finds follows from the best one's estimate and
  // from the difference between them over few samples. `scene` is what the lower set renders.
  Estimates on_lower_set(const InstructionSet& set, const Estimates& on_best, const SceneDescription& scene,
                         int samples) const {
    use_instruction_set("");
    return corrected(
        on_best, case_.scene, [&] { ASSERT_TRUE(use_instruction_set(set.name)); }, scene, samples);
  }

  void expect_case(double error, int samples) const {
    const Estimates found = expect_estimates(case_.scene, case_.expected, error);
    for (const InstructionSet& set : lower_sets()) {
      SCOPED_TRACE(set.title);
      expect_estimates(on_lower_set(set, found, case_.scene, samples), case_.expected, error);
    }
  }

  Case case_;
};

class NightlyTransport : public Transport {};
class TransportTwins : public Transport {};

TEST_P(Transport, IsAsTheTableSays) { expect_case(usual_error, few); }
TEST_P(NightlyTransport, IsAsTheTableSays) { expect_case(nightly_error, nightly_few); }

TEST_P(TransportTwins, AreRejected) {
  SceneDescription faulty = case_.scene;
  case_.fault.plant(faulty);
  expect_rejected(faulty, case_.expected, usual_error);
  // Faults of one set alone. What the best finds is not in question here. Where few samples do not tell, they would
  // have failed the test all the same, by the standard error of a difference between paths that part.
  Estimates right{};
  for (std::size_t c = 0; c < case_.expected.size(); ++c) right[c].mean = case_.expected[c].value;
  for (const InstructionSet& set : lower_sets()) {
    SCOPED_TRACE(set.title);
    double furthest = 0;
    for (const int samples : {few, nightly_few})
      if (furthest <= 8) furthest = furthest_out(on_lower_set(set, right, faulty, samples), case_.expected);
    EXPECT_GT(furthest, 8);
  }
}

std::string case_name(const ::testing::TestParamInfo<std::tuple<Case, const char*>>& test) {
  const auto& [c, integrator] = test.param;
  return c.name + "_" + integrator;
}
std::string twin_name(const ::testing::TestParamInfo<std::tuple<Case, const char*>>& test) {
  const auto& [c, integrator] = test.param;
  return c.name + "_with_" + c.fault.name + "_" + integrator;
}

// Whether a case takes "reference" about a minute or more to the usual error. That is for the night; volpath finds the
// same numbers with every commit.
bool is_long(const std::tuple<Case, const char*>& test) {
  constexpr std::string_view rows[] = {"04_HG", "05_HG", "10_HG", "15_shells_far", "16_shells"};
  const auto& [c, integrator] = test;
  return integrator == std::string_view("reference") &&
         std::any_of(std::begin(rows), std::end(rows), [&](std::string_view row) { return c.name.starts_with(row); });
}

std::vector<std::tuple<Case, const char*>> cases_that(bool are_long) {
  std::vector<std::tuple<Case, const char*>> cases;
  for (const Case& c : transport_cases())
    for (const char* integrator : {"reference", "volpath"})
      if (is_long({c, integrator}) == are_long) cases.emplace_back(c, integrator);
  return cases;
}

auto all_cases() { return ::testing::Combine(::testing::ValuesIn(transport_cases()), path_tracers()); }
INSTANTIATE_TEST_SUITE_P(Cases, Transport, ::testing::ValuesIn(cases_that(false)), case_name);
INSTANTIATE_TEST_SUITE_P(NightlyLongCases, Transport, ::testing::ValuesIn(cases_that(true)), case_name);
INSTANTIATE_TEST_SUITE_P(NightlyCases, NightlyTransport, all_cases(), case_name);
INSTANTIATE_TEST_SUITE_P(Cases, TransportTwins, all_cases(), twin_name);

}  // namespace
}  // namespace brume

// All numbers of the table in cases.h, by every integrator that solves the whole of light transport, volpath on every
// instruction set of the machine. Each case has twins with its fault planted, which must be rejected.
#include <gtest/gtest.h>

#include <array>

#include "lanes/instruction_set.h"
#include "render/cases.h"

namespace brume {
namespace {

struct PathTracer {
  std::string integrator;
  std::string instruction_set;
  std::string name() const { return integrator + (instruction_set.empty() ? "" : "_" + instruction_set); }
};
void PrintTo(const PathTracer& p, std::ostream* out) { *out << p.name(); }

std::vector<PathTracer> path_tracers_on_every_set() {
  std::vector<PathTracer> all{{"reference", ""}};
  for (const InstructionSet& set : available_instruction_sets()) {
    all.push_back({"volpath", std::string(set.name)});
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    break;  // they take minutes, and the other sets run the same code
#endif
  }
  return all;
}

// Standard errors by the length of paths, relative to what is expected. The aim is 0.1 % with every commit and 0.02 %
// in the nightly tests; they are larger where a case would take minutes, or hours: where every flight of many asks
// Embree for surfaces or spheres, more so for the reference and on the lower instruction sets.
using Precision = std::array<double, 4>;

class Transport : public ::testing::TestWithParam<std::tuple<Case, PathTracer>> {
 protected:
  void SetUp() override {
    std::tie(case_, path_tracer_) = GetParam();
    ASSERT_TRUE(use_instruction_set(path_tracer_.instruction_set));
    SceneDescription& s = case_.scene;
    s.integrator.name = path_tracer_.integrator;
    for (const char letter : case_.name + path_tracer_.name())
      s.sampler.seed = s.sampler.seed * 31 + static_cast<std::uint32_t>(letter);
  }
  void TearDown() override { use_instruction_set(""); }

  // Of three: for the reference, for volpath on the best instruction set, and on the others.
  const Precision& by_path_tracer(const Precision& reference, const Precision& best, const Precision& other) const {
    if (path_tracer_.instruction_set.empty()) return reference;
    return path_tracer_.instruction_set == available_instruction_sets().front().name ? best : other;
  }
  void expect_case(const Precision& precision) const {
    expect_estimates(case_.scene, case_.expected, precision[static_cast<std::size_t>(case_.paths)]);
  }

  Case case_;
  PathTracer path_tracer_;
};

class NightlyTransport : public Transport {};
class TransportTwins : public Transport {};

TEST_P(Transport, IsAsTheTableSays) {
  expect_case(by_path_tracer(Precision{1e-3, 1e-3, 3e-3, 1e-2}, Precision{1e-3, 1e-3, 1e-3, 5e-3},
                             Precision{1e-3, 5e-3, 5e-3, 2e-2}));
}
TEST_P(NightlyTransport, IsAsTheTableSays) {
  expect_case(by_path_tracer(Precision{2e-4, 5e-4, 1e-3, 2e-3}, Precision{2e-4, 5e-4, 5e-4, 2e-3},
                             Precision{5e-4, 1e-3, 1e-3, 5e-3}));
}
TEST_P(TransportTwins, AreRejected) {
  case_.fault.plant(case_.scene);
  expect_rejected(case_.scene, case_.expected, case_.paths == Paths::longest ? 5e-3 : 1e-3);
}

std::string case_name(const ::testing::TestParamInfo<std::tuple<Case, PathTracer>>& test) {
  const auto& [c, path_tracer] = test.param;
  return c.name + "_" + path_tracer.name();
}
std::string twin_name(const ::testing::TestParamInfo<std::tuple<Case, PathTracer>>& test) {
  const auto& [c, path_tracer] = test.param;
  return c.name + "_with_" + c.fault.name + "_" + path_tracer.name();
}

auto all_cases() {
  return ::testing::Combine(::testing::ValuesIn(transport_cases()), ::testing::ValuesIn(path_tracers_on_every_set()));
}
INSTANTIATE_TEST_SUITE_P(Cases, Transport, all_cases(), case_name);
INSTANTIATE_TEST_SUITE_P(NightlyCases, NightlyTransport, all_cases(), case_name);
INSTANTIATE_TEST_SUITE_P(Cases, TransportTwins, all_cases(), twin_name);

}  // namespace
}  // namespace brume

// The SIMD build against the scalar build, function by function, on every instruction set of the machine. The
// differences come from fused multiply-adds alone: sets without the instruction agree with the scalar build to the bit,
// and so does everything that has no fma in it. The fault this catches: an operator of the lanes, or a step of a
// kernel, that is not the scalar's.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <map>
#include <string>

#include "kernel/call_agreement.h"
#include "kernel/test_grids.h"
#include "lanes/instruction_set.h"

namespace brume {

// How GoogleTest shows a set.
inline void PrintTo(const InstructionSet& set, std::ostream* out) { *out << set.title; }

namespace {

// Whether the lanes compute what the scalar build does, to the bit.
bool without_fma(const InstructionSet& set) {
#ifdef __FMA__
  return false;
#else
  return set.name == "scalar" || set.name == "sse4";
#endif
}

class LanesAgree : public testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override { ASSERT_TRUE(use_instruction_set(GetParam().name)); }
  void TearDown() override { use_instruction_set(""); }

  void compare(int call, const TestGrid& grid) {
    const CallShape shape = call_shapes()[static_cast<std::size_t>(call)];
    const auto found = agreements_.find(shape.name);
    ASSERT_NE(found, agreements_.end()) << "no stated bound for " << shape.name;
    const std::vector<float> in = make_arguments(shape, found->second);
    std::vector<float> scalar(static_cast<std::size_t>(call_count * shape.outputs)), lanes(scalar.size());
    call_scalar(call, call_count, in.data(), scalar.data(), grid);
    call_lanes(call, call_count, in.data(), lanes.data(), grid);
    const Agreement within = without_fma(GetParam()) ? Agreement{} : found->second;
    std::string first;
    EXPECT_EQ(disagreements(shape, scalar, lanes, within, first), 0) << first;
  }

  const std::map<std::string, Agreement, std::less<>> agreements_ = agreements();
};

TEST_P(LanesAgree, WidthIsTheSets) { EXPECT_EQ(call_lane_count(), GetParam().lanes); }

TEST_P(LanesAgree, EveryKernelFunction) {
  std::vector<std::uint32_t> blackbody;
  for (const float value : noise_values({3, 2121, 1}, 0)) blackbody.push_back(std::bit_cast<std::uint32_t>(value));
  for (const BrickGrid& grid : noise_grids({20, 17, 19})) {
    const kernel::BrickGrid view = kernel_view(grid);
    const int calls = static_cast<int>(call_shapes().size());
    for (int call = 0; call < calls; ++call)
      compare(call, {view.table, view.bricks, view.table_x, view.table_xy, view.bits, view.bordered, blackbody.data()});
  }
}

INSTANTIATE_TEST_SUITE_P(Machine, LanesAgree, testing::ValuesIn(available_instruction_sets()),
                         [](const auto& set) { return std::string(set.param.name); });

// A relative fault of 1e-6 in an argument of exp, as a wrong constant in the reduction would make.
TEST(LanesAgreeTwin, SlightlyOtherArgumentIsRejected) {
  const std::vector<CallShape> shapes = call_shapes();
  int call = 0;
  while (shapes[static_cast<std::size_t>(call)].name != "exp_natural") ++call;
  const Agreement agreement = agreements()["exp_natural"];
  std::vector<float> in = make_arguments(shapes[static_cast<std::size_t>(call)], agreement);
  std::vector<float> scalar(in.size()), lanes(in.size());
  call_scalar(call, call_count, in.data(), scalar.data(), {});
  for (float& x : in) x *= 1.000001f;
  call_lanes(call, call_count, in.data(), lanes.data(), {});
  std::string first;
  EXPECT_GT(disagreements(shapes[static_cast<std::size_t>(call)], scalar, lanes, agreement, first), call_count / 2);
}

}  // namespace
}  // namespace brume

// The SPIR-V build against the scalar build, function by function, on every Vulkan device of the machine (lavapipe,
// where it has no other). The fault this catches: an operator of the GLSL dialect, or of a driver, that is not the
// scalar build's. Where there is no device the tests are skipped.
#include <gtest/gtest.h>

#include <array>
#include <bit>

#include "kernel/call_agreement.h"
#include "kernel/compute_shader.h"
#include "kernel/test_grids.h"

namespace brume {
namespace {

constexpr std::array voxels{20, 17, 19};

// A brick grid of noise and a table of black bodies' colours, for the scalar build and as the shader's words.
class Grids {
 public:
  explicit Grids(BrickGrid grid) : grid_(std::move(grid)) {
    for (const float value : noise_values({3, 2121, 1}, 0)) blackbody_.push_back(std::bit_cast<std::uint32_t>(value));
    for (const auto* part : {&grid_.table, &grid_.words, &blackbody_}) {
      begins_.push_back(static_cast<std::uint32_t>(words_.size()));
      words_.insert(words_.end(), part->begin(), part->end());
    }
  }

  TestGrid scalar() const {
    const kernel::BrickGrid view = kernel_view(grid_);
    return {view.table, view.bricks, view.table_x, view.table_xy, view.bits, view.bordered, blackbody_.data()};
  }
  const std::vector<std::uint32_t>& words() const { return words_; }
  // The push constants that follow the number of the call and of its sets.
  std::array<std::uint32_t, 7> places() const {
    const kernel::BrickGrid view = kernel_view(grid_);
    return {begins_[0], begins_[1], view.table_x, view.table_xy, view.bits, view.bordered, begins_[2]};
  }

 private:
  BrickGrid grid_;
  std::vector<std::uint32_t> blackbody_, words_, begins_;
};

constexpr std::size_t pushed = 9;

std::vector<float> call_shader(ComputeShader& shader, int call, const std::vector<float>& in, std::size_t results,
                               const Grids& grids) {
  std::vector<std::uint32_t> push{static_cast<std::uint32_t>(call), call_count};
  for (const std::uint32_t place : grids.places()) push.push_back(place);
  std::vector<std::uint32_t> arguments;
  for (const float x : in) arguments.push_back(std::bit_cast<std::uint32_t>(x));
  std::vector<float> out;
  for (const std::uint32_t bits : shader.run(call_count / 64, push, grids.words(), arguments, results))
    out.push_back(std::bit_cast<float>(bits));
  return out;
}

// Compares one function; returns the number of results that disagree, where its arguments are times `factor` for the
// shader.
int shader_disagreements(ComputeShader& shader, int call, const Grids& grids, float factor, std::string& first) {
  const CallShape shape = call_shapes()[static_cast<std::size_t>(call)];
  const Agreement within = agreements().at(std::string(shape.name));
  std::vector<float> in = make_arguments(shape, within);
  std::vector<float> scalar(static_cast<std::size_t>(call_count * shape.outputs));
  call_scalar(call, call_count, in.data(), scalar.data(), grids.scalar());
  if (factor != 1)
    for (float& x : in) x *= factor;
  return disagreements(shape, scalar, call_shader(shader, call, in, scalar.size(), grids), within, first);
}

TEST(ShaderAgrees, EveryKernelFunction) {
  const std::vector<std::string> devices = vulkan_device_names();
  if (devices.empty()) GTEST_SKIP() << "no Vulkan device";
  for (std::size_t device = 0; device < devices.size(); ++device) {
    SCOPED_TRACE(devices[device]);
    ComputeShader shader(device, BRUME_KERNEL_CALLS_SPIRV, pushed);
    for (BrickGrid& grid : noise_grids(voxels)) {
      const Grids grids(std::move(grid));
      const int calls = static_cast<int>(call_shapes().size());
      for (int call = 0; call < calls; ++call) {
        std::string first;
        EXPECT_EQ(shader_disagreements(shader, call, grids, 1, first), 0) << first;
      }
    }
  }
}

// A relative fault of 1e-6 in an argument of exp, as a wrong constant in the reduction would make.
TEST(ShaderAgreesTwin, SlightlyOtherArgumentIsRejected) {
  if (vulkan_device_names().empty()) GTEST_SKIP() << "no Vulkan device";
  ComputeShader shader(0, BRUME_KERNEL_CALLS_SPIRV, pushed);
  int call = 0;
  while (call_shapes()[static_cast<std::size_t>(call)].name != "exp_natural") ++call;
  std::string first;
  EXPECT_GT(shader_disagreements(shader, call, Grids(noise_grids(voxels).front()), 1.000001f, first), call_count / 2);
}

}  // namespace
}  // namespace brume

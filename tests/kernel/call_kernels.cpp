#include "kernel/call_kernels.h"

#include "kernel/scalar.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/call_kernels.cpp"
#include <hwy/foreach_target.h>

#include "lanes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brume {
namespace HWY_NAMESPACE {

#include "kernel/cpp_kernel_calls.inl"

void call_lanes(int call, int count, const float* in, float* out, const TestGrid& grid) {
  const KernelCall& kernel_call = kernel_calls[call];
  F arguments[most_inputs], results[most_outputs];
  for (int n = 0; n < count; n += lane_count()) {
    for (int i = 0; i < kernel_call.inputs; ++i) arguments[i] = load_lanes(in + i * count + n);
    kernel_call.function(arguments, results, grid);
    for (int i = 0; i < kernel_call.outputs; ++i) store_lanes(results[i], out + i * count + n);
  }
}

int call_lane_count() { return lane_count(); }

}  // namespace HWY_NAMESPACE
}  // namespace brume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brume {
namespace kernel {

#include "kernel/cpp_kernel_calls.inl"

}  // namespace kernel

std::vector<CallShape> call_shapes() {
  std::vector<CallShape> shapes;
  for (const kernel::KernelCall& call : kernel::kernel_calls) shapes.push_back({call.name, call.inputs, call.outputs});
  return shapes;
}

void call_scalar(int call, int count, const float* in, float* out, const TestGrid& grid) {
  const kernel::KernelCall& kernel_call = kernel::kernel_calls[call];
  float arguments[most_inputs], results[most_outputs];
  for (int n = 0; n < count; ++n) {
    for (int i = 0; i < kernel_call.inputs; ++i) arguments[i] = in[i * count + n];
    kernel_call.function(arguments, results, grid);
    for (int i = 0; i < kernel_call.outputs; ++i) out[i * count + n] = results[i];
  }
}

HWY_EXPORT(call_lanes);
HWY_EXPORT(call_lane_count);
void call_lanes(int call, int count, const float* in, float* out, const TestGrid& grid) {
  HWY_DYNAMIC_DISPATCH(call_lanes)(call, count, in, out, grid);
}
int call_lane_count() { return HWY_DYNAMIC_DISPATCH(call_lane_count)(); }

}  // namespace brume
#endif

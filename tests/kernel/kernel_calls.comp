// The GLSL build of kernel_calls.inl: one of its functions, number `call`, for `count` sets of arguments, one each
// invocation. Argument i of set n is at[i * count + n] of the arguments, and so are the results.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Table { uint words[]; };
layout(std430, binding = 1) readonly buffer Arguments { uint arguments[]; };
layout(std430, binding = 2) writeonly buffer Results { uint results[]; };

// A brick grid and a table of black bodies' colours, as places in `words`.
struct TestGrid {
  uint table, bricks, table_x, table_xy, bits, bordered, blackbody;
};
layout(push_constant) uniform Dispatch {
  uint call, count;
  TestGrid grid;
};

#include "kernel/dialect.glsl"
uint load_u32(uint array, uint index) { return words[array + index]; }
uint load_u32(uint array, int index) { return words[array + uint(index)]; }
void load_u32_pair(uint array, uint index, out uint first, out uint second) {
  first = words[array + index];
  second = words[array + index + 1u];
}
#include "kernel/all.inl"
#include "kernel/phase_dispatch.glsl"

float a[14], r[48];
#define KERNEL_CALL(name) void call_##name()
#define EVAL(name, mu, p) phase_eval(kind_##name, mu, p)
#define SAMPLE(name, u, p) phase_sample(kind_##name, u, p)
#define MEAN_COSINE(name, p) phase_mean_cosine(kind_##name, p)
#include "kernel/kernel_calls.inl"

void load(uint inputs, uint n) {
  for (uint i = 0; i < inputs; ++i) a[i] = uintBitsToFloat(arguments[i * count + n]);
}
void store(uint outputs, uint n) {
  for (uint i = 0; i < outputs; ++i) results[i * count + n] = floatBitsToUint(r[i]);
}

void main() {
  uint n = gl_GlobalInvocationID.x;
  if (n >= count) return;
  uint number = 0;
#define CALL(name, inputs, outputs) \
  if (number++ == call) {           \
    load(inputs, n);                \
    call_##name();                  \
    store(outputs, n);              \
  }
#include "kernel/kernel_call_list.inl"
}

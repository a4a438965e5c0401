// The functions of kernel_calls.inl, run on arrays by the scalar build and by the SIMD build.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace brume {

// A brick grid's words, as every build's BrickGrid takes them, and a table of black bodies' colours.
struct TestGrid {
  const std::uint32_t* table = nullptr;
  const std::uint32_t* bricks = nullptr;
  std::uint32_t table_x = 0, table_xy = 0, bits = 0, bordered = 0;
  const std::uint32_t* blackbody = nullptr;
};

struct CallShape {
  std::string_view name;
  int inputs = 0, outputs = 0;
};

constexpr int most_inputs = 14, most_outputs = 48, widest_lanes = 16;

// All of them, in the order of kernel_calls.inl.
std::vector<CallShape> call_shapes();

// Runs call number `call` on `count` (a multiple of 16) sets of arguments: argument i of set n is in[i * count + n],
// and so are the results in `out`.
void call_scalar(int call, int count, const float* in, float* out, const TestGrid& grid);
void call_lanes(int call, int count, const float* in, float* out, const TestGrid& grid);

// The lanes that call_lanes works with on the instruction set now chosen.
int call_lane_count();

}  // namespace brume

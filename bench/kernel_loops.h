// What bench/kernel_loops.inl works on.
#pragma once

#include <cstdint>

namespace brume {

enum class Loop { nearest, linear, dda, march };

// Cells or points along each ray in the dda and march loops.
constexpr int bench_steps = 64;

// A brick grid's words.
struct BenchGrid {
  const std::uint32_t* table;
  const std::uint32_t* words;
  std::uint32_t table_x, table_xy, bits, bordered;
};

// Origins, then directions: six arrays of `count` floats, one after the other. count is a multiple of 16.
struct BenchRays {
  const float* data;
  int count;
  float step;  // between the points of the march
};

}  // namespace brume

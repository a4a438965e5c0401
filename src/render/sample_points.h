// The first random numbers of many samples at once, in SIMD lanes: the same as RandomStream's for zsobol.
#pragma once

#include <cstdint>

#include "compiled/compiled_scene.h"

namespace brume {

// The samples of which numbers are wanted: pixels of the whole picture.
struct SampleColumns {
  std::uint32_t* x = nullptr;
  std::uint32_t* y = nullptr;
  std::uint32_t* sample = nullptr;
};

// points[d][i] = number d of sample i, in [0, 1), for d < dimensions (even). Columns have room for whole vectors.
void find_sample_points(const CompiledScene& scene, const SampleColumns& samples, std::uint32_t count, int dimensions,
                        float* const* points);

}  // namespace brume

#include "render/sample_points.h"

#include "render/random_keys.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/sample_points.cpp"
#include <hwy/foreach_target.h>

#include "lanes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brume {
namespace HWY_NAMESPACE {

void sample_point_lanes(std::uint32_t seed, std::uint32_t picture_width, bool is_sobol, std::uint32_t samples_per_pixel,
                        const SampleColumns& samples, std::uint32_t count, int dimensions, float* const* points) {
  for (std::uint32_t i = 0; i < count; i += static_cast<std::uint32_t>(lane_count())) {
    const U x = load_lanes(samples.x + i), y = load_lanes(samples.y + i), sample = load_lanes(samples.sample + i);
    for (int pair = 0; 2 * pair < dimensions; ++pair) {
      U first, second;
      if (is_sobol) {
        sobol_pair(U(seed), x, y, U(samples_per_pixel), sample, U(static_cast<std::uint32_t>(pair)), first, second);
      } else {
        const RandomWords words = random_words(U(seed), y * U(picture_width) + x, sample,
                                               U(random_keys::points + static_cast<std::uint32_t>(pair)));
        first = words.x;
        second = words.y;
      }
      store_lanes(uniform_from_bits(first), points[2 * pair] + i);
      store_lanes(uniform_from_bits(second), points[2 * pair + 1] + i);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace brume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include "render/random_stream.h"

namespace brume {

HWY_EXPORT(sample_point_lanes);

void find_sample_points(const CompiledScene& scene, const SampleColumns& samples, std::uint32_t count, int dimensions,
                        float* const* points) {
  HWY_DYNAMIC_DISPATCH(sample_point_lanes)
  (scene.seed, static_cast<std::uint32_t>(scene.width), scene.sampler == SamplerKind::zsobol,
   RandomStream::points_per_pixel(scene), samples, count, dimensions, points);
}

}  // namespace brume
#endif

// The random numbers of one sample of one pixel: what integrators draw from. A number is a function of the seed, the
// pixel, the sample and how many were drawn before it.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "compiled/compiled_scene.h"
#include "kernel/scalar.h"

namespace brume {

// Sampler `independent` is kernel/random.inl throughout. `zsobol` takes the first numbers from kernel/sobol.inl, whose
// pairs of dimensions are best where they belong together, and the rest as `independent` does.
class RandomStream {
 public:
  static constexpr std::uint32_t sobol_dimensions = 16;

  // Sample `sample` of the scene's pixel (x, y). The scene's number of samples a pixel decides how zsobol lays out its
  // points; samples beyond it are as good each on its own, and start another net every 2^20 at the latest.
  RandomStream(const CompiledScene& scene, int x, int y, int sample)
      : seed_(scene.seed),
        x_(static_cast<std::uint32_t>(x)),
        y_(static_cast<std::uint32_t>(y)),
        pixel_(y_ * static_cast<std::uint32_t>(scene.width) + x_),
        sample_(static_cast<std::uint32_t>(sample)),
        samples_(std::bit_ceil(static_cast<std::uint32_t>(std::clamp(scene.samples_per_pixel, 1, 1 << 20)))),
        sobol_left_(scene.sampler == SamplerKind::zsobol ? sobol_dimensions : 0) {}

  // 32 random bits that depend on no other number's; takes none of zsobol's dimensions.
  std::uint32_t next_bits() { return kernel::random_bits(seed_, pixel_, sample_, hashed_++); }

  // In [0, 1).
  float next() {
    if (sobol_left_ == 0) return kernel::uniform_from_bits(next_bits());
    if (sobol_left_-- % 2 != 0) return kernel::uniform_from_bits(second_);
    std::uint32_t first;
    kernel::sobol_pair(seed_, x_, y_, samples_, sample_, (sobol_dimensions - sobol_left_) / 2, first, second_);
    return kernel::uniform_from_bits(first);
  }

  // Two numbers for one choice in two dimensions: for zsobol a pair that is well distributed over the square.
  struct Pair {
    float u, v;
  };
  Pair next_pair() {
    sobol_left_ -= sobol_left_ % 2;
    const float u = next();
    return {u, next()};
  }

 private:
  std::uint32_t seed_, x_, y_, pixel_, sample_, samples_;
  std::uint32_t hashed_ = 0;  // numbers drawn from the hash
  std::uint32_t sobol_left_;  // dimensions; where odd, the next is second_
  std::uint32_t second_ = 0;
};

}  // namespace brume

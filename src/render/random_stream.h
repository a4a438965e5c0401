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

  // How many of zsobol's points in a row belong to a pixel.
  static std::uint32_t points_per_pixel(const CompiledScene& scene) {
    return std::bit_ceil(static_cast<std::uint32_t>(std::clamp(scene.samples_per_pixel, 1, 1 << 20)));
  }

  // Sample `sample` of the scene's pixel (x, y). The scene's number of samples a pixel decides how zsobol lays out its
  // points; samples beyond it are as good each on its own, and start another net every 2^20 at the latest.
  RandomStream(const CompiledScene& scene, int x, int y, int sample)
      : seed_(scene.seed),
        x_(static_cast<std::uint32_t>(x)),
        y_(static_cast<std::uint32_t>(y)),
        pixel_(y_ * static_cast<std::uint32_t>(scene.width) + x_),
        sample_(static_cast<std::uint32_t>(sample)),
        samples_(points_per_pixel(scene)),
        sobol_end_(scene.sampler == SamplerKind::zsobol ? sobol_dimensions : 0) {}

  // Goes on with `pairs` pairs of zsobol's dimensions, from number `first` on, and then with the hash's numbers from
  // `hashed` on: for integrators that give every event of a path its own numbers.
  void skip_to(std::uint32_t first, std::uint32_t pairs, std::uint32_t hashed) {
    const bool has_points = sobol_end_ > 0;
    next_dimension_ = has_points ? 2 * first : 0;
    sobol_end_ = has_points ? next_dimension_ + 2 * pairs : 0;
    hashed_ = hashed;
  }

  // 32 random bits that depend on no other number's; takes none of zsobol's dimensions.
  std::uint32_t next_bits() { return kernel::random_bits(seed_, pixel_, sample_, hashed_++); }

  // In [0, 1).
  float next() {
    if (next_dimension_ == sobol_end_) return kernel::uniform_from_bits(next_bits());
    const std::uint32_t dimension = next_dimension_++;
    if (dimension % 2 != 0) return kernel::uniform_from_bits(second_);
    std::uint32_t first;
    kernel::sobol_pair(seed_, x_, y_, samples_, sample_, dimension / 2, first, second_);
    return kernel::uniform_from_bits(first);
  }

  // Two numbers for one choice in two dimensions: for zsobol a pair that is well distributed over the square.
  struct Pair {
    float u, v;
  };
  Pair next_pair() {
    next_dimension_ += next_dimension_ % 2;
    const float u = next();
    return {u, next()};
  }

 private:
  std::uint32_t seed_, x_, y_, pixel_, sample_, samples_;
  std::uint32_t hashed_ = 0;          // numbers drawn from the hash
  std::uint32_t next_dimension_ = 0;  // zsobol's; where odd, it is second_
  std::uint32_t sobol_end_;           // where zsobol's dimensions end
  std::uint32_t second_ = 0;
};

}  // namespace brume

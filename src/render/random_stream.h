// The random numbers of one sample of one pixel, dimension after dimension (see kernel/random.inl).
#pragma once

#include <cstdint>

#include "kernel/scalar.h"

namespace brume {

class RandomStream {
 public:
  RandomStream(std::uint32_t seed, std::uint32_t pixel, std::uint32_t sample)
      : seed_(seed), pixel_(pixel), sample_(sample) {}

  std::uint32_t next_bits() { return kernel::random_bits(seed_, pixel_, sample_, dimension_++); }
  // In [0, 1).
  float next() { return kernel::uniform_from_bits(next_bits()); }

 private:
  std::uint32_t seed_, pixel_, sample_, dimension_ = 0;
};

}  // namespace brume

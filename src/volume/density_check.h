// What is wrong with the values of a grid that is to be a density: how many are negative or not finite, and where the
// first of them is.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "base/diagnostics.h"

namespace brume {

class DensityCheck {
 public:
  // Takes the value of `voxels` voxels, the first of them at `voxel`.
  void check(float value, std::array<std::int64_t, 3> voxel, std::int64_t voxels = 1) {
    if (value >= 0 && std::isfinite(value)) return;
    if (count_ == 0) {
      first_value_ = value;
      first_voxel_ = voxel;
    }
    count_ += voxels;
  }

  bool failed() const { return count_ > 0; }

  // Throws InputError where a value was bad.
  void finish(const std::string& file, const std::string& grid_name) const {
    if (!failed()) return;
    throw InputError(file,
                     fmt::format("grid \"{}\" cannot be rendered: {} of its values are negative or not finite, the "
                                 "first {} at voxel ({}, {}, {})",
                                 grid_name, count_, first_value_, first_voxel_[0], first_voxel_[1], first_voxel_[2]));
  }

 private:
  std::int64_t count_ = 0;
  float first_value_ = 0;
  std::array<std::int64_t, 3> first_voxel_{};
};

}  // namespace brume

// What is wrong with the values of a grid that is to be a density: how many are negative or not finite, and where the
// first of them is.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "base/diagnostics.h"
#include "volume/volume_grid.h"

namespace brume {

class DensityCheck {
 public:
  explicit DensityCheck(BadValues bad_values) : bad_values_(bad_values) {}

  // The value of `voxels` voxels, the first of them at `voxel`; 0 for a bad one.
  float checked(float value, std::array<std::int64_t, 3> voxel, std::int64_t voxels = 1) {
    if (value >= 0 && std::isfinite(value)) return value;
    if (count_ == 0) {
      first_value_ = value;
      first_voxel_ = voxel;
    }
    count_ += voxels;
    return 0;
  }

  // Whether finish() will throw.
  bool failed() const { return count_ > 0 && bad_values_ == BadValues::rejected; }

  // Tells of the values that were taken as 0, "" where there were none. Throws InputError where they are rejected.
  std::string finish(const std::string& file, const std::string& grid_name) const {
    if (count_ == 0) return {};
    const std::string found =
        fmt::format("{} of its values are negative or not finite, the first {} at voxel ({}, {}, {})", count_,
                    first_value_, first_voxel_[0], first_voxel_[1], first_voxel_[2]);
    if (failed())
      throw InputError(file, fmt::format("grid \"{}\" cannot be rendered: {}; \"bool sanitize\" true of the medium, or "
                                         "--sanitize, takes them as 0",
                                         grid_name, found));
    return fmt::format("grid \"{}\" of {}: {}; they are taken as 0", grid_name, file, found);
  }

 private:
  BadValues bad_values_;
  std::int64_t count_ = 0;
  float first_value_ = 0;
  std::array<std::int64_t, 3> first_voxel_{};
};

}  // namespace brume

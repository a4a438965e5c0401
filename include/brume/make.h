// Making procedural volumes as OpenVDB files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "brume/parameter.h"

namespace brume {

struct VolumeKindInfo {
  std::string name, meaning;
  std::vector<ParameterInfo> parameters;
};

// The kinds that make_volume knows.
std::vector<VolumeKindInfo> volume_kinds();

struct VolumeRecipe {
  std::string kind;            // a name of volume_kinds()
  int size = 128;              // voxels along the longest side, 8 to 2048
  std::uint32_t seed = 0;      // which one of the kind
  ParameterValues parameters;  // those left out have their usual values
  bool half = false;           // 16-bit floats in the file
  int threads = 0;             // 0: one per core; the file is the same for any number
};

// Makes a volume and writes it to a .vdb file, whole or not at all: grid "density" and, for a fire, "temperature" in
// kelvin. Returns lines that say what the file holds. Throws Error, before anything is made, where the recipe or the
// file's name makes no sense.
std::string make_volume(const VolumeRecipe& recipe, const std::string& path);

}  // namespace brume

// Procedural volumes by kind: their names and parameters, as scenes and the command line give them.
// src/volume/procedural.h makes the volumes.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/geometry.h"

namespace brume {

// A parameter from lo to hi, both included.
struct ProceduralParameter {
  std::string_view name, meaning, unit;
  double lo = 0, hi = 0;
  float fallback = 0;
};

constexpr int max_procedural_parameters = 2;

struct ProceduralKind {
  std::string_view name, meaning;
  std::array<ProceduralParameter, max_procedural_parameters>
      parameters{};              // the first with an empty name ends the list
  bool has_temperature = false;  // a second grid, "temperature", in kelvin
};

enum class ProceduralName { cloud, smoke, fog, fire };

inline constexpr std::array<ProceduralKind, 4> procedural_kinds{{
    {"cloud", "a cumulus, flat below and billowing above", {{{"billows", "how far the billows swell", "1", 0, 1, 1}}}},
    {"smoke",
     "a plume that rises from a small source and rolls up",
     {{{"turbulence", "how far eddies tear it", "1", 0, 1, 0.5f}, {"spread", "how fast it widens", "1", 0, 1, 0.5f}}}},
    {"fog",
     "a layer on the ground, thinner and patchier upwards",
     {{{"height", "part of the box in which it thins to 1/e", "1", 0.05, 1, 0.3f},
       {"patchiness", "how much it varies from place to place", "1", 0, 1, 0.5f}}}},
    {"fire",
     "a flame, with its temperatures in a second grid",
     {{{"turbulence", "how far eddies tear it", "1", 0, 1, 0.5f},
       {"temperature", "of the hottest place", "K", 1000, 3000, 2000}}},
     true},
}};

constexpr int min_procedural_size = 8, max_procedural_size = 2048;

// A procedural volume, with one value for each parameter of its kind.
struct Procedural {
  ProceduralName kind = ProceduralName::cloud;
  int size = 128;          // voxels along the longest side
  std::uint32_t seed = 0;  // which one of the kind
  std::array<float, max_procedural_parameters> values{};
  bool operator==(const Procedural&) const = default;

  constexpr const ProceduralKind& table() const { return procedural_kinds[static_cast<std::size_t>(kind)]; }
};

// The usual values.
constexpr Procedural usual_procedural(ProceduralName kind, int size = 128, std::uint32_t seed = 0) {
  Procedural p{kind, size, seed, {}};
  for (std::size_t i = 0; i < p.values.size(); ++i) p.values[i] = p.table().parameters[i].fallback;
  return p;
}

// pbrt's medium "cloud": noise in a box, dense at the bottom (y = 0) and gone at the top (y = 1).
struct NoiseCloud {
  double density = 1, wispiness = 1, frequency = 5;
  Vector3 p0{0, 0, 0}, p1{1, 1, 1};  // p0 below p1 on all axes
  int size = 128;                    // voxels along the longest side
  bool operator==(const NoiseCloud&) const = default;
};

}  // namespace brume

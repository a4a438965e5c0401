// Paths through a volume in a white furnace: what tracking costs, without lights, surfaces and film.
#pragma once

#include <cstdint>
#include <vector>

#include "render/scatter.h"
#include "volume/volume_grid.h"

namespace brume {

// The grid, two units across, as the one medium: optical depth 100 across at its densest, albedo 1, henyey_greenstein
// with g = 0.85.
CompiledScene furnace_scene(VolumeGrid grid, int threads);

class FurnacePaths {
 public:
  explicit FurnacePaths(const CompiledScene& scene);

  // Brings all paths to their next collision and scatters them there; those that leave the volume begin anew. Returns
  // the number of events: steps through cells of majorants, and look-ups of the density.
  std::int64_t advance();

  // Adds the stretches that the paths are about to cross.
  void append_stretches(TrackTasks& to);

 private:
  void start(std::uint32_t path);

  const CompiledScene& scene_;
  Intersector intersector_;
  MediaAlongRay media_along_ray_;
  MediumTasks media_;
  ColumnMemory memory_;
  PathColumns paths_;
  ShadowColumns shadows_;
  ScatterJob job_;
  std::vector<float> random_;
  std::uint32_t started_ = 0;
};

}  // namespace brume

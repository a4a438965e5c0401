#include "volume/procedural.h"

#include <fmt/format.h>

#include <stdexcept>

namespace brume {

VolumeGrid procedural_density(const Procedural& procedural, Storage storage, int threads) {
  if (procedural.size < 1 || procedural.size > max_procedural_size)
    throw std::invalid_argument(
        fmt::format("a procedural volume has from 1 to {} voxels along its longest side", max_procedural_size));
  switch (procedural.kind) {
    case ProceduralName::smoke:
      return make_smoke(procedural, storage, threads);
    case ProceduralName::fog:
      return make_fog(procedural, storage, threads);
    case ProceduralName::fire:
      return make_fire(procedural, storage, threads);
    case ProceduralName::cloud:
      break;
  }
  return make_cloud(procedural, storage, threads);
}

VolumeGrid procedural_temperature(const Procedural& procedural, Storage storage, int threads) {
  if (!procedural.table().has_temperature) throw std::invalid_argument("a kind without temperatures");
  return make_fire_temperature(procedural, storage, threads);
}

std::vector<VolumeGrid> procedural_grids(const Procedural& procedural, Storage storage, int threads) {
  std::vector<VolumeGrid> grids;
  grids.push_back(procedural_density(procedural, storage, threads));
  if (procedural.table().has_temperature) grids.push_back(procedural_temperature(procedural, storage, threads));
  return grids;
}

}  // namespace brume

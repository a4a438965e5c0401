#include "render/paths.h"

namespace brume {

PathColumns::PathColumns(ColumnMemory& memory) : ray(memory.rays()) {
  flight.t = memory.floats();
  flight.medium = memory.integers();
  flight.passed = memory.floats();
  for (auto* columns : {&flight.weight, &throughput, &rescale, &radiance, &gathered}) memory.make_floats(*columns);
  direction_density = memory.floats();
  depth = memory.words();
  flight.depth = depth;
  target = memory.words();
  for (float*& column : points) column = memory.floats();
}

ShadowColumns::ShadowColumns(ColumnMemory& memory) : ray(memory.rays()), lead(memory.rays()), path(memory.words()) {
  memory.make_floats(value);
}

}  // namespace brume

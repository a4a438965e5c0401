// Emission from place to place: black bodies at temperatures of a grid, and how much each cell of a grid emits.
#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "compile/compiler.h"
#include "scene/colour.h"

namespace brume {

namespace {

// The table of kernel/emission.inl.
std::vector<std::uint32_t> blackbody_table() {
  constexpr int last = 2120;
  std::vector<std::uint32_t> table;
  for (int i = 0; i <= last; ++i) {
    const Spectrum colour = blackbody_emission(400 * std::exp(i / 384.0));
    for (int c = 0; c < channel_count; ++c) table.push_back(std::bit_cast<std::uint32_t>(colour[c]));
  }
  return table;
}

// Part of the chances to look for emission that goes to all cells with density alike: values at the voxels' centres do
// not tell all of what is between them.
constexpr float density_share = 0.05f;

// A medium is thin where a free path is longer than this. (Of a procedural flame of extinction 0.3, 2 and 15, whose
// diagonal is 2.4, the error is 1/15, 1/2.7 and 1/1.1 of that of collisions alone; of gathering along flights alone it
// is the same, a tenth more and 2.8 times as large.)
constexpr double thin_in_diagonals = 0.1;

// CompiledEmissionFactor::cells.
std::vector<std::uint32_t> emission_cells(const CompiledGrid& grid, const CompiledMedium& medium,
                                          const kernel::EmissionField& field, float thin, int threads) {
  const auto row = static_cast<int>(grid.majorant_row), layer = static_cast<int>(grid.majorant_layer);
  const int layers = static_cast<int>(grid.majorants.size()) / layer;
  const int edge = static_cast<int>(std::lround(1 / grid.majorant_cells_per_voxel));
  std::array<int, 3> voxels{};
  for (std::size_t axis = 0; axis < 3; ++axis) voxels[axis] = static_cast<int>(std::floor(grid.bounds_hi[axis]));
  const kernel::BrickGrid density = grid.view();
  const auto emitted = [&](int x, int y, int z) {
    const float d = kernel::grid_voxel(density, x, y, z);
    if (d == 0) return 0.0f;
    const auto middle = [](int i) { return static_cast<float>(i) + 0.5f; };
    return d * sum(emission_at(medium, field, {middle(x), middle(y), middle(z)}));
  };
  const auto cell_mean = [&](std::array<int, 3> cell) {
    std::array<int, 3> lo{}, hi{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lo[axis] = std::max(0, (cell[axis] - 1) * edge);
      hi[axis] = std::min(voxels[axis], cell[axis] * edge);
    }
    float total = 0;
    for (int z = lo[2]; z < hi[2]; ++z)
      for (int y = lo[1]; y < hi[1]; ++y)
        for (int x = lo[0]; x < hi[0]; ++x) total += emitted(x, y, z);
    return total / static_cast<float>(edge * edge * edge);
  };

  std::vector<float> means(grid.majorants.size());
  parallel_for(layers, threads, [&](int z, int) {
    for (int y = 0; y < layer / row; ++y)
      for (int x = 0; x < row; ++x) {
        const auto at = static_cast<std::size_t>(z * layer + y * row + x);
        if (grid.majorants[at] != 0) means[at] = cell_mean({x, y, z});
      }
  });
  double all_emitted = 0, all_density = 0;
  for (std::size_t i = 0; i < means.size(); ++i) {
    all_emitted += static_cast<double>(means[i]);
    all_density += static_cast<double>(std::bit_cast<float>(grid.majorants[i]));
  }
  const double by_density = all_emitted > 0 ? density_share * all_emitted / std::max(all_density, 1e-30) : 1;
  std::vector<std::uint32_t> cells(means.size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    const auto majorant = std::bit_cast<float>(grid.majorants[i]);
    const float weight = means[i] + static_cast<float>(by_density) * majorant;
    const float share = kernel::emission_along_flights(majorant * max_value(medium.sigma_t), thin);
    cells[i] = std::bit_cast<std::uint32_t>(share * weight);
  }
  return cells;
}

double world_diagonal(const CompiledGrid& grid, const Transform& world_from_index) {
  Vector3 diagonal;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    diagonal[axis] = static_cast<double>(grid.bounds_hi[a] - grid.bounds_lo[a]);
  }
  return length(world_from_index.vector(diagonal));
}

}  // namespace

void Compiler::add_emission_factor(const MediumDescription& medium, const LoadedGrid& density, CompiledMedium& c) {
  CompiledEmissionFactor factor;
  const auto own_from_index = [&](const LoadedGrid& grid) {
    return inverse(grid.medium_from_index) * density.medium_from_index;
  };
  if (medium.temperatures) {
    const LoadedGrid temperature = temperature_grid(medium);
    if (temperature.index < 0) {
      c.emission = {};
      return;
    }
    factor.temperature = temperature.index;
    factor.temperature_from_index = own_from_index(temperature);
    factor.temperature_offset = static_cast<float>(medium.temperatures->offset);
    factor.temperature_scale = static_cast<float>(medium.temperatures->scale);
    if (compiled_.blackbody.empty()) compiled_.blackbody = blackbody_table();
  }
  if (const LoadedGrid strength = strength_grid(medium); strength.index >= 0) {
    factor.strength = strength.index;
    factor.strength_from_index = own_from_index(strength);
  }
  c.emission_factor = static_cast<int>(compiled_.emission_factors.size());
  const CompiledGrid& grid = compiled_.grids[static_cast<std::size_t>(c.grid)];
  factor.thin = static_cast<float>(thin_in_diagonals * world_diagonal(grid, inverse(c.index_from_world)));
  compiled_.emission_factors.push_back(factor);
  compiled_.emission_factors.back().cells =
      emission_cells(grid, c, emission_field(compiled_, c), factor.thin, threads_);
}

}  // namespace brume

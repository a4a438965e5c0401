#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "compile/compile.h"
#include "compile/compiler.h"
#include "kernel/phase_table.h"
#include "volume/majorant_cells.h"
#include "volume/procedural.h"
#include "volume/read_volume.h"

namespace brume {

namespace {

// Where a medium's grid comes from, as text: media that say the same share the grid.
std::string grid_key(const MediumDescription& medium) {
  if (const auto* file = std::get_if<FileMedium>(&medium.kind))
    return fmt::format("file {}\n{}\n{} {}", file->filename, file->grid, medium.storage_bits,
                       medium.linear_interpolation);
  if (const auto* made = std::get_if<ProceduralMedium>(&medium.kind)) {
    const Procedural& p = made->procedural;
    return fmt::format("{} {} {} {} {} {}", p.table().name, p.size, p.seed, fmt::join(p.values, " "),
                       medium.storage_bits, medium.linear_interpolation);
  }
  return "medium " + medium.name;
}

VolumeGrid load_uniform_grid(const UniformGridMedium& u, Storage storage) {
  VolumeGrid grid;
  grid.bricks = make_brick_grid(u.resolution, u.density, storage);
  const Vector3 size = u.p1 - u.p0;
  grid.medium_from_index =
      translate(u.p0) * scale({size.x / u.resolution[0], size.y / u.resolution[1], size.z / u.resolution[2]});
  grid.support = Support::cut;
  return grid;
}

VolumeGrid load_grid(const MediumDescription& medium, int threads) {
  const auto storage = static_cast<Storage>(medium.storage_bits);
  if (const auto* file = std::get_if<FileMedium>(&medium.kind)) return read_volume(file->filename, file->grid, storage);
  if (const auto* made = std::get_if<ProceduralMedium>(&medium.kind))
    return procedural_density(made->procedural, storage, threads);
  return load_uniform_grid(std::get<UniformGridMedium>(medium.kind), storage);
}

// Small enough to stay in the second cache of a core. (With 64 KB cells are half as large again along each edge and a
// path takes as long: it steps less and looks up more.)
constexpr std::size_t majorant_bytes = 160 * 1024;
constexpr int finest_majorant_edge = 4;  // voxels

}  // namespace

CompiledGrid compile_grid(VolumeGrid grid, bool linear, int threads) {
  const Box3 support = support_index(grid, linear);
  CompiledGrid c;
  c.table_x = static_cast<std::uint32_t>(grid.bricks.bricks[0] + 2);
  c.table_xy = c.table_x * static_cast<std::uint32_t>(grid.bricks.bricks[1] + 2);
  c.bits = static_cast<std::uint32_t>(grid.bricks.storage);
  for (int axis = 0; axis < 3; ++axis) {
    c.bounds_lo[static_cast<std::size_t>(axis)] = static_cast<float>(support.lo[axis]);
    c.bounds_hi[static_cast<std::size_t>(axis)] = static_cast<float>(support.hi[axis]);
  }
  MajorantCells majorants = make_majorants(grid.bricks, finest_majorant_edge, majorant_bytes, threads);
  c.majorant_row = static_cast<std::uint32_t>(majorants.size[0]);
  c.majorant_layer = c.majorant_row * static_cast<std::uint32_t>(majorants.size[1]);
  c.majorant_cells_per_voxel = 1 / static_cast<float>(majorants.edge);
  c.majorants = std::move(majorants.cells);
  // Not what the grid was made of: a stored value may be half a step above. Floats from 0 up order as their bits do.
  c.max_density = std::bit_cast<float>(*std::max_element(c.majorants.begin(), c.majorants.end()));
  c.table = std::move(grid.bricks.table);
  c.words = std::move(grid.bricks.words);
  return c;
}

std::int32_t Compiler::medium_index(const std::string& name, const Location& used_at) {
  if (name.empty()) return no_medium;
  if (const auto known = media_.find(name); known != media_.end()) return known->second;
  const auto described =
      std::find_if(scene_.media.begin(), scene_.media.end(), [&](const auto& m) { return m.name == name; });
  std::int32_t index = no_medium;
  if (described == scene_.media.end()) {
    error(used_at, fmt::format("no medium is named \"{}\"", name));
  } else {
    const CompiledMedium compiled = make_medium(*described);
    index = static_cast<std::int32_t>(compiled_.media.size());
    compiled_.media.push_back(compiled);
  }
  media_[name] = index;
  return index;
}

CompiledMedium Compiler::make_medium(const MediumDescription& medium) {
  CompiledMedium c;
  c.sigma_s = medium.sigma_s;
  c.sigma_t = medium.sigma_a + medium.sigma_s;
  c.emission = medium.sigma_a * medium.emission;
  c.phase = medium.phase;
  c.phase_prepared = phase_functions()[static_cast<std::size_t>(medium.phase)].prepare(medium.phase_parameters.data());
  c.linear = medium.linear_interpolation;
  if (!std::holds_alternative<HomogeneousMedium>(medium.kind)) c.grid = grid_index(medium, c);
  return c;
}

// Loads the medium's grid, or finds it loaded, and places it. A file that cannot be read is an error at the medium.
int Compiler::grid_index(const MediumDescription& medium, CompiledMedium& compiled) {
  const std::string key = grid_key(medium);
  auto known = grids_.find(key);
  if (known == grids_.end()) {
    try {
      VolumeGrid grid = load_grid(medium, threads_);
      const LoadedGrid loaded{static_cast<int>(compiled_.grids.size()), grid.medium_from_index};
      compiled_.grids.push_back(compile_grid(std::move(grid), medium.linear_interpolation, threads_));
      known = grids_.emplace(key, loaded).first;
    } catch (const InputError& e) {
      for (const Diagnostic& d : e.diagnostics())
        error(medium.location.line > 0 ? medium.location : d.location,
              medium.location.line > 0 ? fmt::format("{}: {}", d.location.file, d.message) : d.message);
      return -1;
    }
  }
  const Transform world_from_index = medium.world_from_medium * known->second.medium_from_index;
  compiled.index_from_world = inverse(world_from_index);
  const double edge = std::min({length(world_from_index.vector({1, 0, 0})), length(world_from_index.vector({0, 1, 0})),
                                length(world_from_index.vector({0, 0, 1}))});
  compiled.default_step = edge / 2;
  return known->second.index;
}

}  // namespace brume

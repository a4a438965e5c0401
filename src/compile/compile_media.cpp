#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "compile/compile.h"
#include "compile/compiler.h"
#include "kernel/phase_table.h"
#include "volume/brick_borders.h"
#include "volume/majorant_cells.h"
#include "volume/procedural.h"
#include "volume/read_volume.h"

namespace brume {

namespace {

// Where a medium's grid comes from, as text: media that say the same share the grid.
std::string grid_key(const MediumDescription& medium, const std::string& file_grid) {
  const std::string lookup = fmt::format("{} {} {}", medium.storage_bits, medium.linear_interpolation, medium.sanitize);
  if (const auto* file = std::get_if<FileMedium>(&medium.kind))
    return fmt::format("file {}\n{}\n{}", file->filename.text, file_grid, lookup);
  if (const auto* made = std::get_if<ProceduralMedium>(&medium.kind)) {
    const Procedural& p = made->procedural;
    return fmt::format("{} {} {} {} {}", p.table().name, p.size, p.seed, fmt::join(p.values, " "), lookup);
  }
  return "medium " + medium.name;
}

VolumeGrid make_uniform_grid(const UniformGridMedium& u, const std::vector<float>& values, Storage storage) {
  VolumeGrid grid;
  grid.bricks = make_brick_grid(u.resolution, values, storage);
  const Vector3 size = u.p1 - u.p0;
  grid.medium_from_index =
      translate(u.p0) * scale({size.x / u.resolution[0], size.y / u.resolution[1], size.z / u.resolution[2]});
  grid.support = Support::cut;
  return grid;
}

Storage storage_of(const MediumDescription& medium) { return static_cast<Storage>(medium.storage_bits); }

GridReading reading_of(const MediumDescription& medium) {
  return {storage_of(medium), medium.sanitize ? BadValues::taken_as_0 : BadValues::rejected};
}

// Small enough to stay in the second cache of a core. (With 64 KB cells are half as large again along each edge and a
// path takes as long: it steps less and looks up more.)
constexpr std::size_t majorant_bytes = 160 * 1024;
constexpr int finest_majorant_edge = 4;  // voxels

float largest_step(const BrickGrid& grid) {
  float largest = 0;
  for (std::size_t i = 0; 2 * i < grid.table.size(); ++i) largest = std::max(largest, grid.entry(i).scale());
  return largest;
}

// Adds to the bounds of what is not empty.
void raise(std::vector<std::uint32_t>& majorants, float by) {
  for (std::uint32_t& word : majorants)
    if (word != 0) word = std::bit_cast<std::uint32_t>(std::bit_cast<float>(word) + by);
}

}  // namespace

CompiledGrid compile_grid(VolumeGrid grid, bool linear, BrickLayout layout, int threads) {
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
  if (layout == BrickLayout::bordered) {
    grid.bricks = add_borders(std::move(grid.bricks), threads);
    raise(c.majorants, largest_step(grid.bricks));  // values may have been rounded up
  }
  c.bordered = grid.bricks.bordered ? 1 : 0;
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
  if (std::holds_alternative<HomogeneousMedium>(medium.kind)) return c;
  const LoadedGrid density = density_grid(medium);
  c.grid = density.index;
  const Transform world_from_index = medium.world_from_medium * density.medium_from_index;
  c.index_from_world = inverse(world_from_index);
  if (c.grid >= 0) check_grid(world_from_index, c, medium);
  const double edge = std::min({length(world_from_index.vector({1, 0, 0})), length(world_from_index.vector({0, 1, 0})),
                                length(world_from_index.vector({0, 0, 1}))});
  c.default_step = edge / 2;
  if (c.grid >= 0 && !is_zero(c.emission)) add_emission_factor(medium, density, c);
  return c;
}

// Rays are taken into the grid's coordinates and out of them as floats, and a flight takes up to as many look-ups as
// the optical depth is at the greatest density.
void Compiler::check_grid(const Transform& world_from_index, const CompiledMedium& c, const MediumDescription& medium) {
  constexpr double smallest_edge = 1e-18, greatest_depth = 1e9;
  const CompiledGrid& grid = compiled_.grids[static_cast<std::size_t>(c.grid)];
  const Box3 box = bounds(world_from_index, {to_vector(grid.bounds_lo), to_vector(grid.bounds_hi)});
  const std::string what = fmt::format("the volume of medium \"{}\"", medium.name);
  check_range(box, what, medium.location);
  for (const auto& row : c.index_from_world.m)
    for (std::size_t column = 0; column < 3; ++column)
      if (!(std::abs(row[column]) <= 1 / smallest_edge))
        return error(
            medium.location,
            fmt::format("{} has voxels that are too small or too flat: edges and heights must be at least {:g}", what,
                        smallest_edge));
  const double depth =
      static_cast<double>(max_value(c.sigma_t)) * static_cast<double>(grid.max_density) * length(box.hi - box.lo);
  if (!(depth <= greatest_depth))
    error(medium.location, fmt::format("{} is too dense: its optical depth is up to {:.3g}; it must be at most {:g}",
                                       what, depth, greatest_depth));
}

template <class Load>
Compiler::LoadedGrid Compiler::loaded_grid(const MediumDescription& medium, const GivenName& grid_name,
                                           const std::string& key, Load load) {
  if (const auto known = grids_.find(key); known != grids_.end()) return known->second;
  const auto* file = std::get_if<FileMedium>(&medium.kind);
  LoadedGrid loaded{-1, {}};
  try {
    if (std::optional<VolumeGrid> grid = load()) {
      loaded = {static_cast<int>(compiled_.grids.size()), grid->medium_from_index};
      if (file && !grid->warning.empty())
        warnings_.push_back({Severity::warning,
                             file->filename.location.line > 0 ? file->filename.location : Location{scene_.file},
                             grid->warning,
                             {}});
      const bool bordered =
          compiled_.integrator.kind == CompiledIntegrator::Kind::classic && medium.linear_interpolation;
      compiled_.grids.push_back(compile_grid(std::move(*grid), medium.linear_interpolation,
                                             bordered ? BrickLayout::bordered : BrickLayout::plain, threads_));
    }
    grids_.emplace(key, loaded);
  } catch (const InputError& e) {
    const bool is_about_the_grid = dynamic_cast<const GridError*>(&e) && grid_name.location.line > 0;
    const Location& at = is_about_the_grid ? grid_name.location : file ? file->filename.location : medium.location;
    for (const Diagnostic& d : e.diagnostics())
      error(at.line > 0 ? at : d.location, at.line > 0 ? fmt::format("{}: {}", d.location.file, d.message) : d.message);
  }
  return loaded;
}

Compiler::LoadedGrid Compiler::density_grid(const MediumDescription& medium) {
  const auto* file = std::get_if<FileMedium>(&medium.kind);
  const GivenName name = file ? file->grid : GivenName();
  return loaded_grid(medium, name, grid_key(medium, name), [&]() -> std::optional<VolumeGrid> {
    if (file) return read_volume(file->filename, file->grid, reading_of(medium));
    const Storage storage = storage_of(medium);
    if (const auto* made = std::get_if<ProceduralMedium>(&medium.kind))
      return procedural_density(made->procedural, storage, threads_);
    if (const auto* noise = std::get_if<CloudMedium>(&medium.kind))
      return make_noise_cloud(noise->cloud, storage, threads_);
    const auto& uniform = std::get<UniformGridMedium>(medium.kind);
    return make_uniform_grid(uniform, uniform.density, storage);
  });
}

// A grid of temperatures that was not asked for by name may be missing.
Compiler::LoadedGrid Compiler::temperature_grid(const MediumDescription& medium) {
  const auto* file = std::get_if<FileMedium>(&medium.kind);
  const GivenName name = file ? file->temperature_grid : GivenName();
  return loaded_grid(
      medium, name, fmt::format("temperature {}", grid_key(medium, name)), [&]() -> std::optional<VolumeGrid> {
        if (file)
          return file->temperature_asked_for ? read_volume(file->filename, file->temperature_grid, reading_of(medium))
                                             : find_volume(file->filename, file->temperature_grid, reading_of(medium));
        const Storage storage = storage_of(medium);
        if (const auto* made = std::get_if<ProceduralMedium>(&medium.kind))
          return procedural_temperature(made->procedural, storage, threads_);
        const auto& uniform = std::get<UniformGridMedium>(medium.kind);
        return make_uniform_grid(uniform, uniform.temperature, storage);
      });
}

Compiler::LoadedGrid Compiler::strength_grid(const MediumDescription& medium) {
  const auto* uniform = std::get_if<UniformGridMedium>(&medium.kind);
  if (!uniform || uniform->strength.empty()) return {-1, {}};
  const std::string key = fmt::format("strength {}", grid_key(medium, ""));
  return loaded_grid(medium, {}, key, [&]() -> std::optional<VolumeGrid> {
    return make_uniform_grid(*uniform, uniform->strength, storage_of(medium));
  });
}

}  // namespace brume

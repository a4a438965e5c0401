#include "brume/make.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/file.h"
#include "brume/scene.h"
#include "session/errors.h"
#include "session/version.h"
#include "volume/procedural.h"
#include "volume/write_vdb.h"

namespace brume {

namespace {

// "; did you mean NAME?", or the names.
std::string advice(const std::string& name, const std::vector<std::string_view>& valid) {
  const std::string_view nearest = nearest_name(name, valid);
  return nearest.empty() ? fmt::format("; known are {}", fmt::join(valid, ", "))
                         : fmt::format("; did you mean {}?", nearest);
}

ProceduralName find_kind(const std::string& name) {
  std::vector<std::string_view> names;
  for (const ProceduralKind& kind : procedural_kinds) names.push_back(kind.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw Error(fmt::format("unknown kind of volume \"{}\"{}", name, advice(name, names)));
  return static_cast<ProceduralName>(found - names.begin());
}

void set_parameter(Procedural& procedural, const std::string& name, double value) {
  const ProceduralKind& kind = procedural.table();
  std::vector<std::string_view> names;
  for (const ProceduralParameter& parameter : kind.parameters)
    if (!parameter.name.empty()) names.push_back(parameter.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw Error(fmt::format("{} has no parameter \"{}\"{}", kind.name, name, advice(name, names)));
  const auto at = static_cast<std::size_t>(found - names.begin());
  const ProceduralParameter& parameter = kind.parameters[at];
  if (!(value >= parameter.lo && value <= parameter.hi))
    throw Error(
        fmt::format("{} of {} must be from {} to {}, found {}", name, kind.name, parameter.lo, parameter.hi, value));
  procedural.values[at] = static_cast<float>(value);
}

Procedural procedural_of(const VolumeRecipe& recipe) {
  Procedural procedural = usual_procedural(find_kind(recipe.kind), recipe.size, recipe.seed);
  if (recipe.size < min_procedural_size || recipe.size > max_procedural_size)
    throw Error(fmt::format("a size of {} voxels is out of range: from {} to {}", recipe.size, min_procedural_size,
                            max_procedural_size));
  for (const auto& [name, value] : recipe.parameters) set_parameter(procedural, name, value);
  return procedural;
}

}  // namespace

std::vector<VolumeKindInfo> volume_kinds() {
  std::vector<VolumeKindInfo> kinds;
  for (const ProceduralKind& kind : procedural_kinds) {
    VolumeKindInfo& info = kinds.emplace_back(VolumeKindInfo{std::string(kind.name), std::string(kind.meaning), {}});
    for (const ProceduralParameter& p : kind.parameters)
      if (!p.name.empty())
        info.parameters.push_back({std::string(p.name), std::string(p.meaning), std::string(p.unit), p.lo, p.hi,
                                   static_cast<double>(p.fallback)});
  }
  return kinds;
}

std::string make_volume(const VolumeRecipe& recipe, const std::string& path) {
  return with_public_errors([&] {
    const Procedural procedural = procedural_of(recipe);
    if (suffix(path) != ".vdb") throw InputError(path, "volumes are written as .vdb");
    check_writable(path);
    const std::vector<VolumeGrid> grids = procedural_grids(procedural, Storage::f32, recipe.threads);
    const std::string bytes = encode_vdb(grids, recipe.half, software_name());
    write_file_atomically(path, bytes);
    std::string lines;
    for (const VolumeGrid& grid : grids) {
      const auto& n = grid.bricks.voxels;
      lines += fmt::format("{}: grid {}, {} x {} x {} voxels, {} of them in use, up to {:.4g}\n", path, grid.name, n[0],
                           n[1], n[2], grid.bricks.nonzero_voxels, grid.bricks.max_value);
    }
    return lines;
  });
}

}  // namespace brume

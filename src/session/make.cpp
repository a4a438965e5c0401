#include "brume/make.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/file.h"
#include "brume/scene.h"
#include "session/errors.h"
#include "session/named_parameters.h"
#include "session/version.h"
#include "volume/procedural.h"
#include "volume/write_vdb.h"

namespace brume {

namespace {

std::vector<ParameterInfo> parameters_of(const ProceduralKind& kind) {
  std::vector<ParameterInfo> parameters;
  for (const ProceduralParameter& p : kind.parameters)
    if (!p.name.empty())
      parameters.push_back({std::string(p.name), std::string(p.meaning), std::string(p.unit), p.lo, p.hi,
                            static_cast<double>(p.fallback), true});
  return parameters;
}

Procedural procedural_of(const VolumeRecipe& recipe) {
  std::vector<std::string_view> names;
  for (const ProceduralKind& kind : procedural_kinds) names.push_back(kind.name);
  const auto kind = static_cast<ProceduralName>(find_name("kind of volume", recipe.kind, names));
  Procedural procedural = usual_procedural(kind, recipe.size, recipe.seed);
  if (recipe.size < min_procedural_size || recipe.size > max_procedural_size)
    fail(fmt::format("a size of {} voxels is out of range: from {} to {}", recipe.size, min_procedural_size,
                     max_procedural_size));
  const std::vector<float> values = parameter_values(recipe.kind, parameters_of(procedural.table()), recipe.parameters);
  std::copy(values.begin(), values.end(), procedural.values.begin());
  return procedural;
}

}  // namespace

std::vector<VolumeKindInfo> volume_kinds() {
  std::vector<VolumeKindInfo> kinds;
  for (const ProceduralKind& kind : procedural_kinds)
    kinds.push_back({std::string(kind.name), std::string(kind.meaning), parameters_of(kind)});
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

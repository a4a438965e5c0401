#include "volume/read_volume.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/diagnostics.h"
#include "base/file.h"
#include "volume/formats.h"

namespace brume {
namespace {

struct Format {
  std::string_view suffix;
  std::vector<GridInfo> (*list)(const std::string& file, std::string_view bytes);
  VolumeGrid (*read)(const std::string& file, std::string_view bytes, std::size_t index, GridReading reading);
};
constexpr Format formats[] = {
    {".vdb", list_vdb, read_vdb}, {".nvdb", list_nvdb, read_nvdb}, {".vol", list_vol, read_vol}};

const Format& format_of(const std::string& path) {
  const std::string ending = suffix(path);
  for (const Format& format : formats) {
    if (format.suffix == ending) return format;
  }
  throw InputError(path, fmt::format("volume files end in {}, not in \"{}\"", volume_suffixes, ending));
}

// "density (float, fog volume), flags (int32, unknown)"
std::string list_of_names(const std::vector<GridInfo>& grids) {
  std::string names;
  for (const GridInfo& grid : grids) {
    names += fmt::format("{}{} ({}, {})", names.empty() ? "" : ", ", grid.name, grid.type, grid.grid_class);
  }
  return names.empty() ? "no grids" : names;
}

// Of several grids of one name the formats have "density[0]", "density[1]" or the bare name repeated.
std::string_view without_number(std::string_view name) {
  if (!name.ends_with(']')) return name;
  return name.substr(0, name.rfind('['));
}

// The first of that name, numbered or not.
std::size_t find_grid(const std::vector<GridInfo>& grids, std::string_view name) {
  for (std::size_t i = 0; i < grids.size(); ++i) {
    if (grids[i].name == name) return i;
  }
  for (std::size_t i = 0; i < grids.size(); ++i) {
    if (without_number(grids[i].name) == name) return i;
  }
  return grids.size();
}

std::size_t choose_grid(const std::string& path, const std::vector<GridInfo>& grids, const std::string& name) {
  if (!name.empty()) {
    const std::size_t named = find_grid(grids, name);
    if (named < grids.size()) return named;
    std::vector<std::string_view> names;
    for (const GridInfo& grid : grids) names.push_back(grid.name);
    const std::string_view nearest = nearest_name(name, names);
    throw GridError(
        path, fmt::format("has no grid \"{}\"; {}it has {}", name,
                          nearest.empty() ? "" : fmt::format("did you mean \"{}\"? ", nearest), list_of_names(grids)));
  }
  const std::size_t density = find_grid(grids, "density");
  if (density < grids.size()) return density;
  std::size_t only = grids.size(), renderable = 0;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    if (!grids[i].renderable) continue;
    only = i;
    ++renderable;
  }
  if (renderable == 1) return only;
  throw GridError(path, fmt::format("{}; it has {}",
                                    renderable == 0 ? "has no grid that could be a density"
                                                    : "has several grids that could be the density: name one",
                                    list_of_names(grids)));
}

VolumeGrid read_grid(const Format& format, const std::string& path, std::string_view bytes,
                     const std::vector<GridInfo>& grids, std::size_t index, GridReading reading) {
  const GridInfo& grid = grids.at(index);
  if (!grid.renderable) throw GridError(path, fmt::format("grid \"{}\" cannot be rendered: {}", grid.name, grid.note));
  return format.read(path, bytes, index, reading);
}

void note_repeated_names(std::vector<GridInfo>& grids) {
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const std::size_t first = find_grid(grids, without_number(grids[i].name));
    if (first == i || first == grids.size() || !grids[i].note.empty()) continue;
    grids[i].note =
        fmt::format("another grid has this name: \"{}\" stands for the first", without_number(grids[i].name));
  }
}

}  // namespace

bool is_volume_file(const std::string& path) {
  const std::string ending = suffix(path);
  return std::any_of(std::begin(formats), std::end(formats), [&](const Format& f) { return f.suffix == ending; });
}

std::vector<GridInfo> list_grids(const std::string& path) {
  const Format& format = format_of(path);
  std::vector<GridInfo> grids = format.list(path, read_file(path));
  note_repeated_names(grids);
  return grids;
}

VolumeGrid read_volume(const std::string& path, const std::string& name, GridReading reading) {
  const Format& format = format_of(path);
  const std::string bytes = read_file(path);
  const std::vector<GridInfo> grids = format.list(path, bytes);
  return read_grid(format, path, bytes, grids, choose_grid(path, grids, name), reading);
}

VolumeGrid read_volume(const std::string& path, std::size_t index, GridReading reading) {
  const Format& format = format_of(path);
  const std::string bytes = read_file(path);
  return read_grid(format, path, bytes, format.list(path, bytes), index, reading);
}

std::optional<VolumeGrid> find_volume(const std::string& path, const std::string& name, GridReading reading) {
  const Format& format = format_of(path);
  const std::string bytes = read_file(path);
  const std::vector<GridInfo> grids = format.list(path, bytes);
  const std::size_t found = find_grid(grids, name);
  if (found == grids.size() || !grids[found].renderable) return std::nullopt;
  return format.read(path, bytes, found, reading);
}

}  // namespace brume

// MakeNamedMedium and MediumInterface.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kernel/phase_table.h"
#include "scene/media.h"
#include "scene/medium_presets.h"
#include "scene/reader.h"

namespace brume {

std::vector<float> read_cells(ParameterList& p, std::string_view name, const std::array<int, 3>& resolution,
                              const CellRange& allowed, ParameterType type) {
  Parameter* parameter = p.find(type, name);
  if (!parameter) return {};
  std::vector<double>& values = parameter->numbers;
  const std::int64_t cells = std::int64_t{resolution[0]} * resolution[1] * resolution[2];
  const std::size_t a_cell = type == ParameterType::rgb ? 3 : 1;
  // Compared by division: the number of cells may be more than can be counted three times over.
  if (values.size() % a_cell != 0 || static_cast<std::int64_t>(values.size() / a_cell) != cells) {
    p.value_error(*parameter, 0,
                  fmt::format("must have nx ny nz = {} x {} x {} = {} {}, found {}", resolution[0], resolution[1],
                              resolution[2], cells, a_cell == 3 ? "colours" : "values",
                              values.size() % a_cell == 0 ? fmt::format("{}", values.size() / a_cell)
                                                          : fmt::format("{} numbers", values.size())));
    return {};
  }
  const auto is_wrong = [&](double v) { return !allowed.range.holds(v); };
  if (const auto wrong = std::count_if(values.begin(), values.end(), is_wrong); wrong > 0) {
    const auto first = std::find_if(values.begin(), values.end(), is_wrong);
    const auto index = static_cast<std::size_t>(first - values.begin());
    const std::string found = fmt::format("{}, found {}{}", allowed.range.text(), *first,
                                          wrong > 1 ? fmt::format(", the first of {} such values", wrong) : "");
    if (allowed.sanitize)
      p.value_warning(*parameter, index, fmt::format("{}; taken as 0", found));
    else
      p.value_error(*parameter, index, found);
    std::replace_if(values.begin(), values.end(), is_wrong, 0);
  }
  std::vector<float> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(), [](double v) { return static_cast<float>(v); });
  parameter->numbers = {};
  return result;
}

GivenName grid_name(ParameterList& p, std::string_view parameter, const std::string& fallback) {
  const bool is_given = p.has(ParameterType::string, parameter);
  return {p.string(parameter, fallback),
          is_given ? location(p.place_of(ParameterType::string, parameter)) : Location()};
}

namespace {

constexpr std::int64_t max_voxels_along_axis = 65536;

// The coefficients of the preset that a homogeneous medium names; false where it names none.
bool read_preset(ParameterList& p, double scale, MediumDescription& medium) {
  const std::string name = p.string("preset", "");
  if (name.empty()) return false;
  p.refuse({"rgb sigma_a", "rgb sigma_s", "spectrum sigma_a", "spectrum sigma_s"}, "has no place beside its preset");
  std::vector<std::string_view> names;
  for (const MediumPreset& preset : medium_presets()) {
    names.push_back(preset.name);
    if (preset.name != name) continue;
    medium.sigma_a = scaled(p, scale, preset.sigma_a, "sigma_a");
    medium.sigma_s = scaled(p, scale, preset.sigma_s, "sigma_s");
    return true;
  }
  p.value_error(*p.find(ParameterType::string, "preset"), 0,
                fmt::format("names the unknown medium \"{}\"{}", printable(name),
                            suggestion(name, names, "docs/scene-language.md lists those that there are")));
  return true;
}

void read_coefficients(ParameterList& p, MediumDescription& medium, bool is_homogeneous) {
  const double scale = p.number("scale", 1, Range::at_least(0));
  if (is_homogeneous && read_preset(p, scale, medium)) return;
  medium.sigma_a = scaled(p, scale, p.colour("sigma_a", constant_spectrum(1), ColourUse::coefficient), "sigma_a");
  medium.sigma_s = scaled(p, scale, p.colour("sigma_s", constant_spectrum(1), ColourUse::coefficient), "sigma_s");
}

// The phase function's name and its own parameters, from the kernel's tables; without a name henyey_greenstein.
void read_phase(ParameterList& p, MediumDescription& medium) {
  std::vector<std::string_view> names;
  for (const PhaseEntry& entry : phase_functions()) names.push_back(entry.table.name);
  const int usual = phase_kind("henyey_greenstein");
  medium.phase = static_cast<int>(p.choice("phase", names, static_cast<std::size_t>(usual)));
  medium.phase_parameters.clear();
  for (const PhaseParameter& parameter : phase_functions()[static_cast<std::size_t>(medium.phase)].table.parameters) {
    if (parameter.name.empty()) break;
    const double fallback = static_cast<double>(parameter.fallback);
    const Range range = parameter.ends_included ? Range::from_to(parameter.lo, parameter.hi)
                                                : Range::between(parameter.lo, parameter.hi);
    const double value = p.number(parameter.name, fallback, range);
    const double rounded = static_cast<double>(static_cast<float>(value));
    if (!range.holds(rounded))
      p.value_error(*p.find(ParameterType::float_, parameter.name), 0,
                    fmt::format("{}, found {}, which is {} as a float", range.text(), value, rounded));
    medium.phase_parameters.push_back(static_cast<float>(value));
  }
}

void read_grid_settings(ParameterList& p, MediumDescription& medium) {
  medium.linear_interpolation = p.choice("interpolation", {"nearest", "linear"}, 1) == 1;
  medium.storage_bits = 8 << p.choice("storage", {"8-bit", "16-bit", "float"}, 1);
}

// The box from p0 to p1, in whichever order they are.
void read_box(ParameterList& p, Vector3& lo, Vector3& hi) {
  const Vector3 p0 = p.triple(ParameterType::point3, "p0", {0, 0, 0});
  const Vector3 p1 = p.triple(ParameterType::point3, "p1", {1, 1, 1});
  for (int axis = 0; axis < 3; ++axis) {
    lo[axis] = std::min(p0[axis], p1[axis]);
    hi[axis] = std::max(p0[axis], p1[axis]);
    if (p0[axis] == p1[axis])
      p.error(p.place(), fmt::format("the box of {} is flat: p0 and p1 have the same {}", p.owner(), "xyz"[axis]));
  }
}

std::array<int, 3> read_resolution(ParameterList& p) {
  std::array<int, 3> resolution{};
  const char* const names[] = {"nx", "ny", "nz"};
  for (std::size_t axis = 0; axis < 3; ++axis)
    resolution[axis] = static_cast<int>(p.integer(names[axis], 1, 1, max_voxels_along_axis));
  return resolution;
}

UniformGridMedium read_uniform_grid(ParameterList& p, bool sanitize) {
  UniformGridMedium grid;
  grid.resolution = read_resolution(p);
  read_box(p, grid.p0, grid.p1);
  p.require(ParameterType::float_, "density");
  grid.density = read_cells(p, "density", grid.resolution, {Range::at_least(0), sanitize});
  return grid;
}

ProceduralMedium read_procedural(ParameterList& p) {
  std::vector<std::string_view> names;
  for (const ProceduralKind& kind : procedural_kinds) names.push_back(kind.name);
  const auto kind = static_cast<ProceduralName>(p.choice("kind", names, 0));
  Procedural procedural = usual_procedural(kind);
  procedural.size = static_cast<int>(p.integer("size", procedural.size, min_procedural_size, max_procedural_size));
  procedural.seed = static_cast<std::uint32_t>(p.integer("seed", 0, 0, 0xffffffff));
  for (std::size_t i = 0; i < procedural.values.size(); ++i) {
    const ProceduralParameter& parameter = procedural.table().parameters[i];
    if (parameter.name.empty()) break;
    procedural.values[i] = static_cast<float>(
        p.number(parameter.name, static_cast<double>(parameter.fallback), Range::from_to(parameter.lo, parameter.hi)));
  }
  return {procedural};
}

// Triples; what lies outside Rec.709 is cut at 0.
void to_rec709(const Matrix3& matrix, std::vector<float>& cells) {
  for (std::size_t i = 0; i + 2 < cells.size(); i += 3) {
    const Vector3 rgb = matrix * Vector3{static_cast<double>(cells[i]), static_cast<double>(cells[i + 1]),
                                         static_cast<double>(cells[i + 2])};
    for (int c = 0; c < 3; ++c) cells[i + static_cast<std::size_t>(c)] = std::max(0.0f, static_cast<float>(rgb[c]));
  }
}

// With the medium's own coefficients, which multiply those of the cells.
RgbGridMedium read_rgb_grid(ParameterList& p, MediumDescription& medium) {
  RgbGridMedium grid;
  grid.resolution = read_resolution(p);
  read_box(p, grid.p0, grid.p1);
  const auto read = [&](std::string_view name, Whites whites) {
    const Parameter* given = p.find(ParameterType::rgb, name);
    const ColourSpace space = given ? given->space : ColourSpace::srgb;
    std::vector<float> cells =
        read_cells(p, name, grid.resolution, {Range::at_least(0), medium.sanitize}, ParameterType::rgb);
    if (space != ColourSpace::srgb) to_rec709(rec709_from(space, whites), cells);
    return cells;
  };
  const bool has_sigma_a = p.has(ParameterType::rgb, "sigma_a");
  if (!has_sigma_a && !p.has(ParameterType::rgb, "sigma_s"))
    p.error(p.place(), fmt::format("{} needs \"rgb sigma_a\" or \"rgb sigma_s\", three numbers a cell", p.owner()));
  if (!has_sigma_a && p.has(ParameterType::rgb, "Le"))
    p.error(p.place(), fmt::format("{} emits, sigma_a Le a unit of length: it needs \"rgb sigma_a\"", p.owner()));
  grid.sigma_a = read("sigma_a", Whites::aligned);
  grid.sigma_s = read("sigma_s", Whites::aligned);
  grid.emission = read("Le", Whites::kept);
  medium.sigma_a = medium.sigma_s = scaled(p, p.number("scale", 1, Range::at_least(0)), constant_spectrum(1), "scale");
  medium.emission = scaled(p, p.number("Lescale", 1, Range::at_least(0)), constant_spectrum(1), "Lescale");
  return grid;
}

CloudMedium read_cloud(ParameterList& p) {
  NoiseCloud cloud;
  cloud.density = p.number("density", cloud.density, Range::at_least(0));
  cloud.wispiness = p.number("wispiness", cloud.wispiness, Range::from_to(0, 1000));
  cloud.frequency = p.number("frequency", cloud.frequency, Range::from_to(0, 1000));
  cloud.size = static_cast<int>(p.integer("size", cloud.size, min_procedural_size, max_procedural_size));
  read_box(p, cloud.p0, cloud.p1);
  // Further out float knows no fraction of a billow.
  constexpr double most_billows = 1e5;
  for (int axis = 0; axis < 3; ++axis)
    if (const double far = std::max(std::abs(cloud.p0[axis]), std::abs(cloud.p1[axis]));
        far * cloud.frequency > most_billows)
      p.error(p.place(), fmt::format("the box of {} reaches out to {} {}, {} billows from the origin; at most {} are "
                                     "possible: place the cloud by transformations",
                                     p.owner(), "xyz"[axis], far, far * cloud.frequency, most_billows));
  return {cloud};
}

}  // namespace

void Reader::make_named_medium() {
  const Place name_place = tokens_.peek().place;
  const std::string name = string_argument("a name");
  media_tried_.insert(name);
  ParameterList p = parameters(fmt::format("MakeNamedMedium \"{}\"", printable(name)), "medium");
  if (name.empty()) messages_.error(name_place, "a medium's name must not be empty: \"\" stands for no medium");
  p.require(ParameterType::string, "type");
  if (!p.has(ParameterType::string, "type")) throw Abandon{};
  std::string type = p.string("type", "");
  if (type == "heterogeneous") {
    messages_.old_spelling(directive_.place, "the medium type \"heterogeneous\" is now called \"uniformgrid\"");
    type = "uniformgrid";
  }
  const std::vector<std::string_view> types = {"homogeneous", "uniformgrid", "nanovdb", "vdb",
                                               "vol",         "procedural",  "cloud",   "rgbgrid"};
  if (std::find(types.begin(), types.end(), type) == types.end())
    unknown_type(p.place_of(ParameterType::string, "type"), "medium type", type, types, {});

  MediumDescription medium;
  medium.name = name;
  medium.location = location(directive_.place);
  medium.world_from_medium = usable_ctm("the medium");
  if (type != "rgbgrid") read_coefficients(p, medium, type == "homogeneous");
  read_phase(p, medium);
  if (type != "homogeneous") read_grid_settings(p, medium);
  // What is computed has no bad values.
  if (type != "homogeneous" && type != "procedural" && type != "cloud") medium.sanitize = p.boolean("sanitize", false);
  if (type == "homogeneous") {
    medium.kind = HomogeneousMedium{};
  } else if (type == "uniformgrid") {
    medium.kind = read_uniform_grid(p, medium.sanitize);
  } else if (type == "procedural") {
    medium.kind = read_procedural(p);
  } else if (type == "rgbgrid") {
    medium.kind = read_rgb_grid(p, medium);
  } else if (type == "cloud") {
    medium.kind = read_cloud(p);
  } else {
    p.require(ParameterType::string, "filename");
    medium.kind = FileMedium{file_name(p, "filename"), grid_name(p, "gridname", "")};
  }
  if (type != "rgbgrid") read_emission(p, medium);
  p.finish();

  if (const auto [known, is_new] = media_by_name_.try_emplace(name, NamedMedium{scene_.media.size(), name_place});
      is_new)
    scene_.media.push_back(std::move(medium));
  else
    messages_.error(name_place, fmt::format("there is a medium \"{}\" already, from {}:{}", printable(name),
                                            known->second.place.source->name, known->second.place.line));
}

void Reader::medium_interface() {
  Place place = tokens_.peek().place;
  state_.inside = string_argument("a medium's name");
  medium_uses_.try_emplace(state_.inside, place);
  state_.outside = state_.inside;
  if (tokens_.peek().kind != Token::Kind::string) return;
  place = tokens_.peek().place;
  state_.outside = string_argument("a medium's name");
  medium_uses_.try_emplace(state_.outside, place);
}

}  // namespace brume

// What media emit: Le, or black bodies by a grid of temperatures.
#include <fmt/format.h>

#include "scene/media.h"

namespace brume {

namespace {

bool has_emission(ParameterList& p) {
  bool has = false;
  for (const ParameterType type : {ParameterType::rgb, ParameterType::spectrum, ParameterType::blackbody})
    has = p.has(type, "Le") || has;
  return has;
}

// What cannot be with Le is an error where it is asked for.
void exclude_emission(ParameterList& p, bool has_le, std::string_view what) {
  if (has_le)
    p.error(p.place(), fmt::format("{} emits by its {} and takes no \"Le\"; \"float Lescale\" makes it brighter",
                                   p.owner(), what));
}

// Whether the medium has temperatures.
bool find_temperatures(ParameterList& p, bool has_le, UniformGridMedium& grid) {
  const bool has = p.has(ParameterType::float_, "temperature");
  if (has) exclude_emission(p, has_le, "temperature");
  grid.temperature = read_cells(p, "temperature", grid.resolution, {Range::any()});
  return has;
}

bool find_temperatures(ParameterList& p, bool has_le, FileMedium& file) {
  file.temperature_asked_for = p.has(ParameterType::string, "temperaturename");
  file.temperature_grid = grid_name(p, "temperaturename", has_le ? "" : "temperature");
  const bool has = !file.temperature_grid.empty();
  if (!has) file.temperature_asked_for = false;
  if (file.temperature_asked_for)
    exclude_emission(p, has_le, fmt::format("grid \"{}\"", printable(file.temperature_grid.text)));
  return has;
}

bool find_temperatures(ParameterList& p, bool has_le, const ProceduralMedium& medium) {
  const bool has = medium.procedural.table().has_temperature;
  if (has) exclude_emission(p, has_le, "temperature");
  return has;
}

bool find_temperatures(ParameterList&, bool, const HomogeneousMedium&) { return false; }
bool find_temperatures(ParameterList&, bool, const CloudMedium&) { return false; }
bool find_temperatures(ParameterList&, bool, const RgbGridMedium&) { return false; }

TemperatureScale read_temperature_scale(ParameterList& p) {
  const double cutoff = p.number("temperaturecutoff", 0);
  return {p.number("temperatureoffset", cutoff), p.number("temperaturescale", 1, Range::at_least(0))};
}

// Lescale: one number, which is returned, or one for each cell of a uniform grid.
double read_strength(ParameterList& p, MediumDescription& medium) {
  auto* grid = std::get_if<UniformGridMedium>(&medium.kind);
  const Parameter* scale = p.find(ParameterType::float_, "Lescale");
  if (!grid || !scale || scale->numbers.size() == 1) return p.number("Lescale", 1, Range::at_least(0));
  grid->strength = read_cells(p, "Lescale", grid->resolution, {Range::at_least(0), medium.sanitize});
  return 1;
}

}  // namespace

void read_emission(ParameterList& p, MediumDescription& medium) {
  p.rename("LeScale", "Lescale");
  const bool has_le = has_emission(p);
  const Spectrum emission = p.colour("Le", Spectrum{}, ColourUse::light);
  const double strength = read_strength(p, medium);
  if (std::visit([&](auto& kind) { return find_temperatures(p, has_le, kind); }, medium.kind)) {
    medium.temperatures = read_temperature_scale(p);
    medium.emission = scaled(p, strength, constant_spectrum(1), "Lescale");
  } else {
    medium.emission = scaled(p, strength, emission, "Le");
    if (!std::holds_alternative<HomogeneousMedium>(medium.kind))
      p.warn({"float temperatureoffset", "float temperaturecutoff", "float temperaturescale"},
             "has no effect: the medium has no temperatures");
  }
}

}  // namespace brume

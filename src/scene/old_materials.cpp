#include "scene/old_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace brume {

namespace {

Parameter number(std::string_view name, double value) {
  Parameter p;
  p.name = name;
  p.numbers = {value};
  return p;
}

Parameter grey(std::string_view name, double value) {
  Parameter p = number(name, value);
  p.type = ParameterType::rgb;
  p.numbers.resize(3, value);
  return p;
}

Parameter spectrum(std::string_view name, std::string_view value) {
  Parameter p;
  p.type = ParameterType::spectrum;
  p.name = name;
  p.strings = {std::string(value)};
  return p;
}

// Source of the defaults: the scene format of pbrt-v3, https://pbrt.org/fileformat-v3. Plastic and its like lose the
// colour of their highlight, which today's coat has by its index alone.
const std::vector<OldMaterial>& old_materials() {
  static const std::vector<OldMaterial> all = {
      {"", "interface"},
      {"none", "interface"},
      {"matte", "diffuse", {}, {"sigma"}},
      {"plastic", "coateddiffuse", {grey("reflectance", 0.25), number("roughness", 0.1)}, {"Ks"}},
      {"uber", "coateddiffuse", {grey("reflectance", 0.25), number("roughness", 0.1)}, {"Ks", "Kr", "Kt", "opacity"}},
      {"substrate", "coateddiffuse", {grey("reflectance", 0.5), number("roughness", 0.1)}, {"Ks"}},
      {"glass", "dielectric", {}, {"Kr", "Kt"}},
      {"metal", "conductor", {number("roughness", 0.01)}, {}},
      {"mirror", "conductor", {spectrum("eta", "metal-Ag-eta"), spectrum("k", "metal-Ag-k")}, {}},
      {"translucent", "diffusetransmission"}};
  return all;
}

constexpr ParameterType types_of_values[] = {ParameterType::rgb, ParameterType::spectrum, ParameterType::float_,
                                             ParameterType::texture};

bool has_reflectance(ParameterList& p) {
  return p.has(ParameterType::rgb, "reflectance") || p.has(ParameterType::spectrum, "reflectance");
}

}  // namespace

const OldMaterial* find_old_material(std::string_view name) {
  const std::vector<OldMaterial>& all = old_materials();
  const auto found = std::find_if(all.begin(), all.end(), [&](const OldMaterial& m) { return m.name == name; });
  return found == all.end() ? nullptr : &*found;
}

void translate(const OldMaterial& material, ParameterList& p) {
  const bool is_mirror = material.name == "mirror";
  p.rename(is_mirror ? "Kr" : "Kd", "reflectance");
  // A mirror without a colour is of silver.
  if (!is_mirror || !has_reflectance(p)) p.add_weaker_defaults(material.defaults);
  for (const std::string_view dropped : material.dropped)
    for (const ParameterType type : types_of_values) {
      const std::string declared = fmt::format("{} {}", type_name(type), dropped);
      p.warn({declared}, fmt::format("has no effect: \"{}\" has nothing like it", material.now));
    }
}

}  // namespace brume

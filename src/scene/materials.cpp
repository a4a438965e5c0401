// Material, MakeNamedMaterial and NamedMaterial.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/old_materials.h"
#include "scene/reader.h"
#include "scene/refractive_indices.h"

namespace brume {

namespace {

constexpr double max_shininess = 1e6;
constexpr double least_index = 0.01, greatest_index = 100;
constexpr float usual_index = 1.5f;
constexpr double least_alpha = 1e-3;

// The name of the spectrum that the parameter gives, "" where it gives none by name.
std::string spectrum_name(ParameterList& p, std::string_view parameter) {
  const Parameter* found = p.find(ParameterType::spectrum, parameter);
  return found && found->strings.size() == 1 ? found->strings[0] : "";
}

Spectrum read_complex_index(ParameterList& p, std::string_view parameter, Spectrum Metal::*part) {
  const std::string name = spectrum_name(p, parameter);
  if (name.empty()) return p.colour(parameter, copper().*part, ColourUse::coefficient);
  std::vector<std::string> names;
  for (const Metal& metal : metals()) {
    if (name == fmt::format("metal-{}-{}", metal.name, parameter)) return metal.*part;
    names.push_back(fmt::format("\"metal-{}-{}\"", metal.name, parameter));
  }
  p.value_error(
      *p.find(ParameterType::spectrum, parameter), 0,
      fmt::format("names the unknown spectrum \"{}\"; it can be {}", printable(name), enumerate(names, "or")));
  return {};
}

// pbrt's: alpha is the root of the roughness unless that is switched off, and a narrow distribution is none at all.
float read_roughness(ParameterList& p) {
  const Range range = Range::from_to(0, 1);
  const double roughness = p.number("roughness", 0, range);
  const double u = p.number("uroughness", roughness, range), v = p.number("vroughness", roughness, range);
  if (u != v)
    p.warning(p.place(),
              fmt::format("the roughness of {} is taken for the same in all directions: the root of uroughness "
                          "times vroughness",
                          p.owner()));
  const double mean = std::sqrt(u * v), alpha = p.boolean("remaproughness", true) ? std::sqrt(mean) : mean;
  return alpha < least_alpha ? 0 : static_cast<float>(alpha);
}

// A reflectance r at normal incidence is that of the index 1 + i k with k = 2 sqrt(r / (1 - r)).
ConductorMaterial read_conductor(ParameterList& p) {
  ConductorMaterial m{constant_spectrum(1), {}, read_roughness(p)};
  if (!p.has(ParameterType::rgb, "reflectance") && !p.has(ParameterType::spectrum, "reflectance")) {
    m.eta = read_complex_index(p, "eta", &Metal::eta);
    m.k = read_complex_index(p, "k", &Metal::k);
    return m;
  }
  p.refuse({"rgb eta", "rgb k", "spectrum eta", "spectrum k"}, "has no place beside its reflectance");
  const Spectrum reflectance = p.colour("reflectance", {}, ColourUse::albedo);
  for (int c = 0; c < channel_count; ++c) {
    const float r = std::min(reflectance[c], 0.9999f);
    m.k[c] = 2 * std::sqrt(r / (1 - r));
  }
  return m;
}

float read_index(ParameterList& p, std::string_view parameter) {
  return static_cast<float>(
      p.number(parameter, static_cast<double>(usual_index), Range::from_to(least_index, greatest_index)));
}

// The index of refraction "eta" as a number or as the spectrum of a glass.
float read_eta(ParameterList& p) {
  p.rename("index", "eta");
  if (!p.has(ParameterType::spectrum, "eta")) return read_index(p, "eta");
  const std::string name = spectrum_name(p, "eta");
  if (name.empty()) {
    const float eta = p.colour("eta", constant_spectrum(usual_index), ColourUse::coefficient)[1];  // in green
    if (!(eta >= static_cast<float>(least_index) && eta <= static_cast<float>(greatest_index)))
      p.value_error(*p.find(ParameterType::spectrum, "eta"), 1,
                    fmt::format("must be from {} to {}, found {}", least_index, greatest_index, eta));
    return eta;
  }
  std::vector<std::string> names;
  for (const Glass& glass : glasses()) {
    if (name == glass.name) return glass.eta;
    names.emplace_back(fmt::format("\"{}\"", glass.name));
  }
  p.value_error(
      *p.find(ParameterType::spectrum, "eta"), 0,
      fmt::format("names the unknown spectrum \"{}\"; it can be {}", printable(name), enumerate(names, "or")));
  return usual_index;
}

DielectricMaterial read_dielectric(ParameterList& p) {
  const float alpha = read_roughness(p);
  return {read_eta(p), alpha};
}

CoatedDiffuseMaterial read_coated_diffuse(ParameterList& p) {
  p.rename("Kd", "reflectance");
  // pbrt's way to compute the same surface by random walks between base and coat.
  p.ignore({"float thickness", "float g", "integer maxdepth", "integer nsamples"});
  for (const ParameterType type : {ParameterType::rgb, ParameterType::spectrum})
    if (const Parameter* albedo = p.find(type, "albedo"); albedo && !is_zero(p.colour("albedo", {}, ColourUse::albedo)))
      p.value_error(*albedo, 0, "must be 0: a coat that scatters is not supported");
  return {p.colour("reflectance", constant_spectrum(0.5f), ColourUse::albedo), read_eta(p), read_roughness(p)};
}

DiffuseMaterial read_diffuse(ParameterList& p) {
  p.rename("Kd", "reflectance");
  return {p.colour("reflectance", constant_spectrum(0.5f), ColourUse::albedo)};
}

BlinnPhongMaterial read_blinn_phong(ParameterList& p) {
  BlinnPhongMaterial m;
  m.diffuse = p.colour("diffuse", m.diffuse.value, ColourUse::albedo);
  m.specular = p.colour("specular", m.specular, ColourUse::albedo);
  m.reflection = p.colour("reflection", m.reflection, ColourUse::albedo);
  m.shininess =
      static_cast<float>(p.number("shininess", static_cast<double>(m.shininess), Range::from_to(0, max_shininess)));
  m.ambient = p.colour("ambient", m.diffuse.value, ColourUse::albedo);
  m.metallic = static_cast<float>(p.number("metallic", 0, Range::from_to(0, 1)));
  m.refraction = p.colour("refraction", m.refraction, ColourUse::albedo);
  m.index = read_index(p, "index");
  m.absorption = p.colour("absorption", m.absorption, ColourUse::coefficient);
  return m;
}

// What is odd about a material, "" where nothing is.
std::string doubt_about(const BlinnPhongMaterial& m) {
  const float most = max_value(m.diffuse.value + m.specular + m.reflection + m.refraction);
  if (most > 1.00001f)
    return fmt::format("sends back more light than it gets: diffuse + specular + reflection + refraction is {:.3g}",
                       most);
  if (is_zero(m.refraction) && !is_zero(m.absorption)) return "absorbs nothing without \"rgb refraction\"";
  return {};
}

}  // namespace

MaterialDescription Reader::read_surface(const std::string& given, const Place& type_place, ParameterList& p) {
  const OldMaterial* const old = find_old_material(given);
  const std::string type(old ? old->now : given);
  if (old) {
    messages_.old_spelling(directive_.place, fmt::format("the material \"{}\" is now called \"{}\"", given, type));
    translate(*old, p);
  }
  MaterialDescription material;
  if (type == "diffuse")
    material = read_diffuse(p);
  else if (type == "blinnphong")
    material = read_blinn_phong(p);
  else if (type == "conductor")
    material = read_conductor(p);
  else if (type == "dielectric")
    material = read_dielectric(p);
  else if (type == "coateddiffuse")
    material = read_coated_diffuse(p);
  else if (type == "interface")
    material = InterfaceMaterial{};
  else
    unknown_type(type_place, "Material", type,
                 {"diffuse", "coateddiffuse", "blinnphong", "conductor", "dielectric", "interface"},
                 {"thindielectric", "coatedconductor", "diffusetransmission", "subsurface", "mix", "measured", "hair"});
  if (auto* diffuse = std::get_if<DiffuseMaterial>(&material))
    use_texture(p, "reflectance", false, diffuse->reflectance);
  if (auto* coated = std::get_if<CoatedDiffuseMaterial>(&material))
    use_texture(p, "reflectance", false, coated->reflectance);
  if (auto* phong = std::get_if<BlinnPhongMaterial>(&material)) {
    use_texture(p, "diffuse", false, phong->diffuse);
    if (!p.has(ParameterType::rgb, "ambient") && !p.has(ParameterType::spectrum, "ambient"))
      phong->ambient = phong->diffuse;
    use_texture(p, "ambient", false, phong->ambient);
    if (const std::string doubt = doubt_about(*phong); !doubt.empty())
      p.warning(p.place(), fmt::format("{} {}", p.owner(), doubt));
  }
  return material;
}

Relief Reader::read_relief(ParameterList& p) {
  Relief relief;
  Textured displacement;
  p.rename("bumpmap", "displacement");
  use_texture(p, "displacement", true, displacement);
  p.ignore({"float displacement"});  // moves all points alike
  relief.displacement = displacement.texture;
  if (!p.has(ParameterType::string, "normalmap")) return relief;
  relief.normal_map = file_name(p, "normalmap");
  if (relief.displacement >= 0) {
    p.warning(p.place_of(ParameterType::texture, "displacement"),
              fmt::format("\"texture displacement\" of {} has no effect beside its normal map", p.owner()));
    relief.displacement = -1;
  }
  return relief;
}

Material Reader::read_material(const std::string& given, const Place& type_place, ParameterList& p) {
  Material material{read_surface(given, type_place, p), {}};
  if (std::holds_alternative<InterfaceMaterial>(material.surface))
    p.warn({"texture displacement", "float displacement", "string normalmap"}, "has no effect: there is no surface");
  else
    material.relief = read_relief(p);
  p.finish();
  return material;
}

void Reader::material() {
  const Place place = tokens_.peek().place;
  const std::string type = string_argument("a type");
  ParameterList p = parameters(fmt::format("Material \"{}\"", printable(type)), "material");
  state_.material = read_material(type, place, p);
}

void Reader::make_named_material() {
  const Place place = tokens_.peek().place;
  const std::string name = string_argument("a name");
  materials_tried_.insert(name);
  ParameterList p = parameters(fmt::format("MakeNamedMaterial \"{}\"", printable(name)), "material");
  p.require(ParameterType::string, "type");
  if (!p.has(ParameterType::string, "type")) throw Abandon{};
  const Material material = read_material(p.string("type", ""), p.place_of(ParameterType::string, "type"), p);
  if (!named_materials_.try_emplace(name, material).second)
    messages_.error(place, fmt::format("there is a material \"{}\" already", printable(name)));
}

void Reader::named_material() {
  const Place place = tokens_.peek().place;
  const std::string name = string_argument("a name");
  const auto found = named_materials_.find(name);
  if (found != named_materials_.end()) {
    state_.material = found->second;
    return;
  }
  if (materials_tried_.contains(name)) return;
  std::vector<std::string_view> names;
  for (const auto& [known, material] : named_materials_) names.push_back(known);
  messages_.fail(place, fmt::format("there is no material \"{}\" yet{}", printable(name), suggestion(name, names, {})));
}

}  // namespace brume

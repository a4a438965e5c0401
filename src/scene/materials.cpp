// Material, MakeNamedMaterial and NamedMaterial.
#include <fmt/format.h>

#include <algorithm>

#include "scene/reader.h"

namespace brume {

namespace {

constexpr double max_shininess = 1e6;

DiffuseMaterial read_diffuse(ParameterList& p) {
  p.rename("Kd", "reflectance");
  return {p.colour("reflectance", constant_spectrum(0.5f), ColourUse::albedo)};
}

BlinnPhongMaterial read_blinn_phong(ParameterList& p) {
  BlinnPhongMaterial m;
  m.diffuse = p.colour("diffuse", m.diffuse, ColourUse::albedo);
  m.specular = p.colour("specular", m.specular, ColourUse::albedo);
  m.reflection = p.colour("reflection", m.reflection, ColourUse::albedo);
  m.shininess =
      static_cast<float>(p.number("shininess", static_cast<double>(m.shininess), Range::from_to(0, max_shininess)));
  return m;
}

}  // namespace

MaterialDescription Reader::read_material(const std::string& given, const Place& type_place, ParameterList& p) {
  std::string type = given;
  if (type.empty() || type == "none") {
    messages_.warning(directive_.place, fmt::format("the material \"{}\" is now called \"interface\"", type));
    type = "interface";
  }
  if (type == "matte") {
    messages_.warning(directive_.place, "the material \"matte\" is now called \"diffuse\"");
    type = "diffuse";
  }
  MaterialDescription material;
  if (type == "diffuse")
    material = read_diffuse(p);
  else if (type == "blinnphong")
    material = read_blinn_phong(p);
  else if (type == "interface")
    material = InterfaceMaterial{};
  else
    unknown_type(type_place, "Material", type, {"diffuse", "blinnphong", "interface"},
                 {"coateddiffuse", "conductor", "dielectric", "thindielectric", "coatedconductor",
                  "diffusetransmission", "subsurface", "mix", "measured", "hair"});
  p.refuse({"texture displacement", "string normalmap", "float displacement"}, "is not supported yet");
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
  ParameterList p = parameters(fmt::format("MakeNamedMaterial \"{}\"", printable(name)), "material");
  p.require(ParameterType::string, "type");
  if (!p.has(ParameterType::string, "type")) throw Abandon{};
  const MaterialDescription material =
      read_material(p.string("type", ""), p.place_of(ParameterType::string, "type"), p);
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
  std::vector<std::string_view> names;
  for (const auto& [known, material] : named_materials_) names.push_back(known);
  messages_.fail(place, fmt::format("there is no material \"{}\" yet{}", printable(name), suggestion(name, names, {})));
}

}  // namespace brume

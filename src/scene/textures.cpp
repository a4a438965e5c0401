// Texture.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "scene/reader.h"

namespace brume {

namespace {

// Of all textures that one evaluates. Textures that name others twice could else take forever.
constexpr int max_texture_size = 1000;

// "sRGB", "linear" or "gamma N".
double read_encoding(ParameterList& p) {
  const std::string encoding = p.string("encoding", "sRGB");
  if (encoding == "sRGB") return 0;
  if (encoding == "linear") return 1;
  constexpr std::string_view word = "gamma ";
  double gamma = 0;
  const char* end = encoding.data() + encoding.size();
  if (encoding.starts_with(word)) {
    const auto [last, code] = std::from_chars(encoding.data() + word.size(), end, gamma);
    if (code == std::errc() && last == end && gamma >= 0.1 && gamma <= 10) return gamma;
  }
  p.value_error(*p.find(ParameterType::string, "encoding"), 0,
                fmt::format("must be \"sRGB\", \"linear\" or \"gamma N\" with N from 0.1 to 10, found \"{}\"",
                            printable(encoding)));
  return 0;
}

Spectrum plain(ParameterList& p, std::string_view name, bool is_float, const Spectrum& fallback) {
  if (!is_float) return p.colour(name, fallback, ColourUse::coefficient);
  return constant_spectrum(static_cast<float>(p.number(name, static_cast<double>(fallback[0]))));
}

int size_of(const std::vector<int>& sizes, std::initializer_list<Textured> operands) {
  int size = 1;
  for (const Textured& t : operands) size += t.texture < 0 ? 0 : sizes[static_cast<std::size_t>(t.texture)];
  return size;
}

}  // namespace

TextureMapping Reader::read_mapping(ParameterList& p) {
  TextureMapping m;
  const std::string mapping = p.string("mapping", "uv");
  m.planar = mapping == "planar";
  if (!m.planar && mapping != "uv") {
    const bool of_pbrt = mapping == "spherical" || mapping == "cylindrical";
    p.value_error(*p.find(ParameterType::string, "mapping"), 0,
                  fmt::format("{} \"uv\" or \"planar\", found \"{}\"", of_pbrt ? "can so far be" : "must be",
                              printable(mapping)));
  }
  m.u_offset = p.number("udelta", 0);
  m.v_offset = p.number("vdelta", 0);
  if (m.planar) {
    m.v1 = p.triple(ParameterType::vector3, "v1", m.v1);
    m.v2 = p.triple(ParameterType::vector3, "v2", m.v2);
    m.world_from_texture = usable_ctm("the texture");
  } else {
    m.u_scale = p.number("uscale", 1);
    m.v_scale = p.number("vscale", 1);
  }
  return m;
}

ImageTexture Reader::read_image_texture(ParameterList& p) {
  ImageTexture t;
  p.require(ParameterType::string, "filename");
  t.filename = file_name(p, "filename");
  t.gamma = read_encoding(p);
  const std::size_t filter = p.choice("filter", {"bilinear", "point", "trilinear", "ewa"}, 0);
  if (filter > 1)
    messages_.warning(p.place_of(ParameterType::string, "filter"),
                      "the filters \"trilinear\" and \"ewa\" are read as \"bilinear\"");
  t.bilinear = filter != 1;
  p.ignore({"float maxanisotropy"});
  t.wrap = static_cast<ImageTexture::Wrap>(p.choice("wrap", {"repeat", "clamp", "black"}, 0));
  t.scale = p.number("scale", 1);
  t.invert = p.boolean("invert", false);
  t.mapping = read_mapping(p);
  return t;
}

void Reader::use_texture(ParameterList& p, std::string_view name, bool is_float, Textured& value) {
  Parameter* given = p.find(ParameterType::texture, name);
  if (!given || given->faulty) return;
  const std::string& texture = given->strings.front();
  const auto& known = textures_by_name_[is_float ? 1 : 0];
  for (const ParameterType type : {ParameterType::rgb, ParameterType::spectrum, ParameterType::float_})
    if (p.has(type, name))
      p.value_error(*given, 0, fmt::format("has no place beside \"{} {}\"", type_name(type), name));
  if (const auto found = known.find(texture); found != known.end()) {
    value = Textured();
    value.texture = found->second;
    return;
  }
  if (textures_tried_.contains(texture)) return;
  std::vector<std::string_view> names;
  for (const auto& [other, index] : known) names.push_back(other);
  p.value_error(*given, 0,
                fmt::format("names a {} texture \"{}\" that there is not yet{}", is_float ? "float" : "spectrum",
                            printable(texture), suggestion(texture, names, {})));
}

Textured Reader::textured(ParameterList& p, std::string_view name, bool is_float, const Textured& fallback) {
  Textured value = plain(p, name, is_float, fallback.value);
  use_texture(p, name, is_float, value);
  return value;
}

void Reader::texture() {
  const std::string name = string_argument("a name");
  const Place name_place = argument_;
  std::string values = string_argument("what it is of, \"float\" or \"spectrum\",");
  modernise(values, "color", "spectrum");
  if (values != "float" && values != "spectrum")
    messages_.fail(argument_,
                   fmt::format("a texture is of \"float\" or \"spectrum\", found \"{}\"", printable(values)));
  const std::string type = string_argument("a type");
  const std::vector<std::string_view> types = {"constant", "scale", "mix", "checkerboard", "imagemap"};
  if (std::find(types.begin(), types.end(), type) == types.end()) textures_tried_.insert(name);
  if (textures_tried_.contains(name))
    unknown_type(argument_, "Texture", type, types,
                 {"directionmix", "bilerp", "dots", "fbm", "wrinkled", "windy", "marble", "ptex"});
  ParameterList p = parameters(fmt::format("Texture \"{}\"", type), "texture");

  TextureDescription t;
  t.name = name;
  t.is_float = values == "float";
  t.location = location(directive_.place);
  int size = 1;
  if (type == "constant") {
    t.kind = ConstantTexture{plain(p, "value", t.is_float, constant_spectrum(1))};
  } else if (type == "scale") {
    ScaleTexture s;
    p.rename("tex1", "tex");
    p.rename("tex2", "scale");
    s.texture = textured(p, "tex", t.is_float, s.texture);
    s.scale = textured(p, "scale", true, s.scale);
    size = size_of(texture_sizes_, {s.texture, s.scale});
    t.kind = s;
  } else if (type == "mix") {
    MixTexture m;
    m.first = textured(p, "tex1", t.is_float, m.first);
    m.second = textured(p, "tex2", t.is_float, m.second);
    m.amount = textured(p, "amount", true, m.amount);
    size = size_of(texture_sizes_, {m.first, m.second, m.amount});
    t.kind = m;
  } else if (type == "checkerboard") {
    CheckerboardTexture c;
    if (p.integer("dimension", 2, 2, 3) == 3)
      p.value_error(*p.find(ParameterType::integer, "dimension"), 0,
                    "must be 2: textures in space are not supported yet");
    c.first = textured(p, "tex1", t.is_float, c.first);
    c.second = textured(p, "tex2", t.is_float, c.second);
    c.mapping = read_mapping(p);
    size = size_of(texture_sizes_, {c.first, c.second});
    t.kind = c;
  } else {
    t.kind = read_image_texture(p);
  }
  p.finish();
  if (size > max_texture_size)
    messages_.fail(name_place, fmt::format("the texture is made of more than {} others", max_texture_size));
  if (!textures_by_name_[t.is_float ? 1 : 0].emplace(name, static_cast<int>(scene_.textures.size())).second)
    messages_.fail(name_place, fmt::format("there is a {} texture \"{}\" already", values, printable(name)));
  texture_sizes_.push_back(size);
  scene_.textures.push_back(std::move(t));
}

}  // namespace brume

// LightSource.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene/reader.h"

namespace brume {

namespace {

constexpr double max_float = std::numeric_limits<float>::max();

// A light's colour times its scale. A light of luminance 1 has the photometric total `unit_total` (its power, or the
// illuminance it makes); where the scene gives a total by `total_name`, which may be "" for none, the scale becomes
// that total's share too, as pbrt's.
Spectrum read_colour(ParameterList& p, std::string_view name, std::string_view total_name, double unit_total) {
  const Spectrum colour = p.colour(name, constant_spectrum(1), ColourUse::light);
  double scale = p.number("scale", 1, Range::at_least(0));
  if (!total_name.empty())
    if (const double total = p.number(total_name, -1); total > 0) scale *= total / unit_total;
  return scaled(p, scale, colour, name);
}

// What an image is multiplied by, which takes the place of the colour L.
Spectrum read_image_scale(ParameterList& p) {
  for (const ParameterType type : {ParameterType::rgb, ParameterType::spectrum, ParameterType::blackbody})
    if (const Parameter* colour = p.find(type, "L"))
      p.value_error(*colour, 0, "has no place beside \"string filename\"; give a \"float scale\"");
  return constant_spectrum(static_cast<float>(p.number("scale", 1, Range::at_least(0))));
}

// A unit vector stays as it is, to the last bit.
Vector3 unit(Vector3 v) {
  const double square = dot(v, v);
  return std::abs(square - 1) <= 4 * std::numeric_limits<double>::epsilon() ? v : normalize(v);
}

// The place of a light, as floats hold it.
Vector3 read_place(ParameterList& p, std::string_view name, Vector3 fallback, const Transform& ctm) {
  const Vector3 place = ctm.point(p.triple(ParameterType::point3, name, fallback));
  if (!(length(place) <= max_float)) p.error(p.place(), fmt::format("the place of {} is out of range", p.owner()));
  return place;
}

// The intensity's share of the solid angle, of which the smooth step fills half of the ring: pbrt's power.
SpotLight read_spot(ParameterList& p, const Transform& ctm) {
  SpotLight light;
  light.cone_angle = p.number("coneangle", light.cone_angle, {0, 180, true, false});
  light.cone_delta =
      p.number("conedeltaangle", std::min(light.cone_delta, light.cone_angle), Range::from_to(0, light.cone_angle));
  const auto cosine = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180); };
  const double start = cosine(light.cone_angle - light.cone_delta), end = cosine(light.cone_angle);
  light.intensity = read_colour(p, "I", "power", 2 * std::numbers::pi * (1 - start + (start - end) / 2));
  light.from = read_place(p, "from", {0, 0, 0}, ctm);
  light.to = read_place(p, "to", {0, 0, 1}, ctm);
  if (!(length(light.to - light.from) > 0))
    p.error(p.place(), "LightSource \"spot\" shines nowhere: from and to are the same");
  return light;
}

DistantLight read_distant(ParameterList& p, const Transform& ctm) {
  DistantLight light;
  light.radiance = read_colour(p, "L", "illuminance", 1);
  const Vector3 from = p.triple(ParameterType::point3, "from", {0, 0, 0});
  const Vector3 to = p.triple(ParameterType::point3, "to", {0, 0, 1});
  const Vector3 direction = ctm.vector(from - to);
  light.direction_to_light = unit(direction);
  if (!(length(direction) > 0)) p.error(p.place(), "LightSource \"distant\" shines nowhere: from and to are the same");
  return light;
}

// Whether a map turns, mirrors and enlarges alike in all directions, and no more.
bool keeps_angles(const Transform& t) {
  const Vector3 x = t.vector({1, 0, 0}), y = t.vector({0, 1, 0}), z = t.vector({0, 0, 1});
  const double square = dot(x, x), tolerance = 1e-4 * square;
  return std::abs(dot(y, y) - square) < tolerance && std::abs(dot(z, z) - square) < tolerance &&
         std::abs(dot(x, y)) < tolerance && std::abs(dot(y, z)) < tolerance && std::abs(dot(z, x)) < tolerance;
}

SphereLight read_sphere(ParameterList& p, const Transform& ctm) {
  SphereLight light;
  light.intensity = read_colour(p, "I", "power", 4 * std::numbers::pi);
  light.from = read_place(p, "from", {0, 0, 0}, ctm);
  light.radius = p.number("radius", 1, Range::above(0)) * length(ctm.vector({1, 0, 0}));
  if (!(light.radius <= max_float)) p.error(p.place(), "the radius of LightSource \"sphere\" is out of range");
  if (!keeps_angles(ctm))
    p.error(p.place(), "LightSource \"sphere\" is round, but the current transformation stretches it");
  if (!(static_cast<double>(max_value(light.intensity)) <= max_float * light.radius * light.radius))
    p.error(p.place(), "LightSource \"sphere\" is too small for its intensity");
  return light;
}

// To a thousandth of the edges.
bool is_rectangle(const std::vector<Vector3>& p) {
  if (p.size() != 4) return false;
  const Vector3 x = p[1] - p[0], y = p[3] - p[0];
  const double shorter = std::min(length(x), length(y));
  return shorter > 0 && length(p[2] - (p[0] + x + y)) <= 1e-3 * shorter &&
         std::abs(dot(x, y)) <= 1e-3 * length(x) * length(y);
}

// In the world, whatever the current transformation: as pbrt has it.
std::optional<std::array<Vector3, 4>> read_portal(ParameterList& p) {
  const Parameter* given = p.find(ParameterType::point3, "portal");
  if (!given) return std::nullopt;
  const std::vector<Vector3> corners = p.triples(ParameterType::point3, "portal");
  if (!is_rectangle(corners)) {
    p.value_error(*given, 0, "must be the four corners of a rectangle, in their order around it");
    return std::nullopt;
  }
  return std::array{corners[0], corners[1], corners[2], corners[3]};
}

}  // namespace

InfiniteLight Reader::infinite_light(ParameterList& p, const Transform& ctm) {
  InfiniteLight light;
  p.rename("mapname", "filename");
  light.portal = read_portal(p);
  light.filename = file_name(p, "filename");
  if (light.filename.empty()) {
    light.radiance = read_colour(p, "L", "illuminance", std::numbers::pi);
    return light;
  }
  light.radiance = read_image_scale(p);
  if (!keeps_angles(ctm))
    p.error(p.place(),
            "the image of LightSource \"infinite\" may be turned and mirrored, but the current "
            "transformation stretches it");
  light.world_from_light = ctm;
  light.illuminance = std::max(0.0, p.number("illuminance", -1));
  return light;
}

void Reader::light_source() {
  const std::string type = string_argument("a type");
  const std::vector<std::string_view> types = {"point", "spot", "sphere", "distant", "infinite", "ambient"};
  if (std::find(types.begin(), types.end(), type) == types.end())
    unknown_type(argument_, "LightSource", type, types, {"goniometric", "projection"});
  ParameterList p = parameters(fmt::format("LightSource \"{}\"", type), "light");
  const Transform ctm = usable_ctm("the light");

  LightDescription light;
  light.location = location(directive_.place);
  if (type == "point") {
    const Spectrum intensity = read_colour(p, "I", "power", 4 * std::numbers::pi);
    light.kind = PointLight{read_place(p, "from", {0, 0, 0}, ctm), intensity};
  } else if (type == "spot") {
    light.kind = read_spot(p, ctm);
  } else if (type == "sphere") {
    light.kind = read_sphere(p, ctm);
  } else if (type == "distant") {
    light.kind = read_distant(p, ctm);
  } else if (type == "ambient") {
    light.kind = AmbientLight{read_colour(p, "L", "", 1)};
  } else {
    light.kind = infinite_light(p, ctm);
  }
  p.finish();
  scene_.lights.push_back(std::move(light));
}

void Reader::area_light_source() {
  std::string type = string_argument("a type");
  modernise(type, "area", "diffuse");
  if (type != "diffuse") unknown_type(argument_, "AreaLightSource", type, {"diffuse"}, {});
  ParameterList p = parameters("AreaLightSource \"diffuse\"", "light");
  AreaLight light;
  light.filename = file_name(p, "filename");
  light.radiance = light.filename.empty() ? read_colour(p, "L", "", 1) : read_image_scale(p);
  light.two_sided = p.boolean("twosided", false);
  light.power = std::max(0.0, p.number("power", -1));
  p.finish();
  state_.area_light = light;
}

}  // namespace brume

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
// illuminance it makes); where the scene gives a total by `total_name`, the scale becomes that total's share too, as
// pbrt's.
Spectrum read_colour(ParameterList& p, std::string_view name, std::string_view total_name, double unit_total) {
  const Spectrum colour = p.colour(name, constant_spectrum(1), ColourUse::light);
  double scale = p.number("scale", 1, Range::at_least(0));
  if (const double total = p.number(total_name, -1); total > 0) scale *= total / unit_total;
  Spectrum product;
  for (int c = 0; c < channel_count; ++c) {
    const double v = scale * static_cast<double>(colour[c]);
    if (v > max_float) {
      p.error(p.place(), fmt::format("{} of {} times its scale is out of range", name, p.owner()));
      return {};
    }
    product[c] = static_cast<float>(v);
  }
  return product;
}

// A unit vector stays as it is, to the last bit.
Vector3 unit(Vector3 v) {
  const double square = dot(v, v);
  return std::abs(square - 1) <= 4 * std::numeric_limits<double>::epsilon() ? v : normalize(v);
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

}  // namespace

void Reader::light_source() {
  const std::string type = string_argument("a type");
  const std::vector<std::string_view> types = {"point", "distant", "infinite"};
  if (std::find(types.begin(), types.end(), type) == types.end())
    unknown_type(argument_, "LightSource", type, types, {"spot", "goniometric", "projection"});
  ParameterList p = parameters(fmt::format("LightSource \"{}\"", type), "light");
  const Transform ctm = usable_ctm("the light");

  LightDescription light;
  light.location = location(directive_.place);
  if (type == "point") {
    const Spectrum intensity = read_colour(p, "I", "power", 4 * std::numbers::pi);
    const Vector3 from = ctm.point(p.triple(ParameterType::point3, "from", {0, 0, 0}));
    if (!(length(from) <= max_float)) p.error(p.place(), "the place of LightSource \"point\" is out of range");
    light.kind = PointLight{from, intensity};
  } else if (type == "distant") {
    light.kind = read_distant(p, ctm);
  } else {
    p.rename("mapname", "filename");
    p.refuse({"string filename"}, "is not supported yet: the light of an environment is constant");
    p.refuse({"point3 portal"}, "is not supported yet");
    light.kind = InfiniteLight{read_colour(p, "L", "illuminance", std::numbers::pi)};
  }
  p.finish();
  scene_.lights.push_back(std::move(light));
}

}  // namespace brume

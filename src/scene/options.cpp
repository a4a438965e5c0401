// The directives before WorldBegin that say how to make the picture: camera, sampler, filter, integrator; Option.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "scene/reader.h"

namespace brume {

namespace {

constexpr std::int64_t max_samples = std::int64_t{1} << 24;
constexpr std::int64_t max_depth = 1000000;
constexpr std::int64_t max_shadow_samples = 65536;
constexpr std::int64_t max_seed = 0xffffffff;
constexpr double max_filter_radius = 32;  // pixels

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool contains(const std::vector<std::string_view>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void Reader::camera() {
  std::string type = string_argument("a type");
  const bool is_environment = type == "environment";
  if (is_environment) {
    messages_.old_spelling(directive_.place,
                           "Camera \"environment\" is now \"spherical\" with \"string mapping\" \"equirectangular\"");
    type = "spherical";
  }
  if (type != "perspective" && type != "spherical")
    unknown_type(argument_, "Camera", type, {"perspective", "spherical"}, {"orthographic", "realistic"});
  ParameterList p = parameters(fmt::format("Camera \"{}\"", type));
  scene_.camera.location = location(directive_.place);
  scene_.camera.world_from_camera = inverse(usable_ctm("the camera"));
  scene_.camera.medium = state_.outside;
  coordinate_systems_["camera"] = scene_.camera.world_from_camera;
  if (type == "spherical") {
    const SphereMap usual = is_environment ? SphereMap::equirectangular : SphereMap::equal_area;
    scene_.camera.sphere_map = static_cast<SphereMap>(p.choice(
        "mapping", {std::begin(sphere_map_names), std::end(sphere_map_names)}, static_cast<std::size_t>(usual)));
    p.warn({"float lensradius", "float focaldistance", "float frameaspectratio", "float screenwindow"},
           "has no effect: it shows all directions, and all of them sharp");
  } else {
    scene_.camera.sphere_map.reset();
    scene_.camera.fov = p.number("fov", 90, Range::between(0, 180));
    screen_window(p);
    scene_.camera.lens_radius = p.number("lensradius", 0, Range::at_least(0));
    scene_.camera.focal_distance = p.number("focaldistance", 1e6, Range::above(0));
  }
  const double open = p.number("shutteropen", 0), close = p.number("shutterclose", 1);
  if (!(close > open))
    p.error(p.place(), fmt::format("the shutter of {} must close after it opens; it opens at {} and closes "
                                   "at {}",
                                   p.owner(), open, close));
  scene_.camera.shutter_open = open;
  scene_.camera.shutter_close = close;
  p.finish();
}

void Reader::screen_window(ParameterList& p) {
  scene_.camera.screen_window = {};
  const double aspect = p.number("frameaspectratio", 0, Range::from_to(0.001, 1000));
  if (aspect >= 1) scene_.camera.screen_window = {-aspect, aspect, -1, 1};
  if (aspect > 0 && aspect < 1) scene_.camera.screen_window = {-1, 1, -1 / aspect, 1 / aspect};
  const Parameter* window = p.find(ParameterType::float_, "screenwindow");
  if (!window) return;
  const std::vector<double>& v = window->numbers;
  if (v.size() != 4)
    p.value_error(*window, 4, fmt::format("takes 4 numbers, found {}", v.size()));
  else if (!(v[0] < v[1] && v[2] < v[3]))
    p.value_error(*window, 0, "must be x0 x1 y0 y1 with x0 < x1 and y0 < y1");
  else
    scene_.camera.screen_window = {v[0], v[1], v[2], v[3]};
}

void Reader::sampler() {
  const Place place = tokens_.peek().place;
  std::string type = string_argument("a type");
  modernise(type, "random", "independent");
  modernise(type, "lowdiscrepancy", "paddedsobol");
  modernise(type, "02sequence", "paddedsobol");
  modernise(type, "maxmindist", "pmj02bn");
  const std::vector<std::string_view> types = {"independent", "stratified", "halton", "sobol",
                                               "paddedsobol", "zsobol",     "pmj02bn"};
  if (!contains(types, type)) unknown_type(argument_, "Sampler", type, types, {});
  if (contains({"stratified", "halton", "pmj02bn"}, type))
    messages_.warning(place, fmt::format("Sampler \"{}\" is read as \"zsobol\"", type));
  scene_.sampler.kind =
      type == "independent" ? SamplerDescription::Kind::independent : SamplerDescription::Kind::zsobol;
  ParameterList p = parameters(fmt::format("Sampler \"{}\"", type));
  if (type == "stratified") {
    const std::int64_t x = p.integer("xsamples", 4, 1, 4096), y = p.integer("ysamples", 4, 1, 4096);
    scene_.sampler.pixel_samples = static_cast<int>(x * y);
    p.ignore({"bool jitter"});
  } else {
    const std::int64_t fallback = type == "independent" ? 4 : 16;
    scene_.sampler.pixel_samples = static_cast<int>(p.integer("pixelsamples", fallback, 1, max_samples));
    p.ignore({"string randomization"});
  }
  sampler_seed_.reset();
  const std::int64_t seed = p.integer("seed", -1, 0, max_seed);
  if (seed >= 0) sampler_seed_ = static_cast<std::uint32_t>(seed);
  p.finish();
}

void Reader::pixel_filter() {
  const std::string type = string_argument("a type");
  const std::vector<std::string_view> types(std::begin(filter_names), std::end(filter_names));
  if (!contains(types, type)) unknown_type(argument_, "PixelFilter", type, types, {});
  ParameterList p = parameters(fmt::format("PixelFilter \"{}\"", type));
  p.rename("xwidth", "xradius");
  p.rename("ywidth", "yradius");
  PixelFilter& f = scene_.filter;
  f = {};
  f.kind = static_cast<PixelFilter::Kind>(std::find(types.begin(), types.end(), type) - types.begin());
  const auto number = [&](std::string_view name, float usual, const Range& range) {
    return static_cast<float>(p.number(name, static_cast<double>(usual), range));
  };
  const float usual_radius = type == "box" ? 0.5f : type == "gaussian" ? 1.5f : type == "sinc" ? 4.0f : 2.0f;
  const Range radius{0, max_filter_radius, true, false};
  f.x_radius = number("xradius", usual_radius, radius);
  f.y_radius = number("yradius", usual_radius, radius);
  if (type == "gaussian") gaussian_sigma(p);
  if (type == "mitchell") {
    f.b = number("B", f.b, Range::from_to(0, 1));
    f.c = number("C", f.c, Range::from_to(0, 1));
  }
  if (type == "sinc") f.tau = number("tau", f.tau, Range::from_to(0.1, 1000));
  p.finish();
}

void Reader::gaussian_sigma(ParameterList& p) {
  float& sigma = scene_.filter.sigma;
  if (const double alpha = p.number("alpha", 0, Range::at_least(0)); alpha > 0) {
    messages_.old_spelling(p.place_of(ParameterType::float_, "alpha"),
                           "\"float alpha\" is now \"float sigma\", which is 1 / sqrt(2 alpha)");
    sigma = static_cast<float>(1 / std::sqrt(2 * alpha));
  }
  sigma = static_cast<float>(p.number("sigma", static_cast<double>(sigma), {0, max_filter_radius, true, false}));
}

void Reader::integrator() {
  std::string type = string_argument("a type");
  const bool is_direct_lighting = type == "directlighting";
  if (is_direct_lighting) {
    messages_.old_spelling(directive_.place,
                           "Integrator \"directlighting\" is now \"volpath\" with \"integer maxdepth\" 1");
    type = "volpath";
  }
  const std::vector<std::string_view> types(std::begin(integrator_names), std::end(integrator_names));
  if (!contains(types, type)) unknown_type(argument_, "Integrator", type, types, {"function"});
  ParameterList p = parameters(fmt::format("Integrator \"{}\"", type));
  IntegratorDescription& i = scene_.integrator;
  i = {};
  i.name = type;
  i.location = location(directive_.place);
  i.max_depth = static_cast<int>(p.integer("maxdepth", 5, 0, max_depth));
  if (type == "classic") {
    i.traversal = static_cast<Traversal>(p.choice("traversal", {"march", "dda"}, 0));
    i.placement = static_cast<Placement>(p.choice("placement", {"start", "random", "middle", "middle-random"},
                                                  static_cast<std::size_t>(Placement::middle)));
    i.step = p.number("step", 0, Range::at_least(0));
    i.volume_shadows = static_cast<VolumeShadows>(p.choice("volumeshadows", {"march", "cached"}, 0));
    i.shadow_samples = static_cast<int>(p.integer("shadowsamples", 1, 1, max_shadow_samples));
  } else if (type != "reference") {
    if (is_direct_lighting) {
      i.max_depth = 1;
      p.ignore({"string strategy"});
    }
    p.rename("lightsamplestrategy", "lightsampler");
    p.ignore({"string lightsampler", "bool regularize", "bool samplelights", "bool samplebsdf",
              "bool visualizestrategies", "bool visualizeweights", "integer bootstrapsamples", "integer chains",
              "integer mutationsperpixel", "float largestepprobability", "float sigma", "integer photonsperiteration",
              "float radius", "integer seed", "bool cossample", "float maxdistance"});
  }
  p.finish();
}

void Reader::accelerator() {
  string_argument("a type");
  parameters("Accelerator").ignore_all();
}

void Reader::color_space() {
  const Place place = tokens_.peek().place;
  const std::string name = string_argument("a name");
  const std::vector<std::string_view> names(colour_space_names.begin(), colour_space_names.end());
  const auto found = std::find(names.begin(), names.end(), lower_case(name));
  if (found == names.end())
    messages_.fail(place, fmt::format("unknown ColorSpace \"{}\"{}", printable(name),
                                      suggestion(name, names,
                                                 "it can be \"srgb\", \"rec2020\", \"dci-p3\" or "
                                                 "\"aces2065-1\"")));
  state_.colour_space = static_cast<ColourSpace>(found - names.begin());
}

void Reader::option() {
  enum class Kind { flag, number, seed, text };
  struct Known {
    std::string_view name;
    Kind kind;
    std::string_view expected;
  };
  static constexpr std::string_view a_flag = "true or false", a_text = "a quoted string";
  static constexpr Known known[] = {{"seed", Kind::seed, "an integer from 0 to 4294967295"},
                                    {"disablepixeljitter", Kind::flag, a_flag},
                                    {"disabletexturefiltering", Kind::flag, a_flag},
                                    {"disablewavelengthjitter", Kind::flag, a_flag},
                                    {"forcediffuse", Kind::flag, a_flag},
                                    {"pixelstats", Kind::flag, a_flag},
                                    {"wavefront", Kind::flag, a_flag},
                                    {"displacementedgescale", Kind::number, "a number"},
                                    {"msereferenceimage", Kind::text, a_text},
                                    {"msereferenceout", Kind::text, a_text},
                                    {"rendercoordsys", Kind::text, a_text}};
  const Place place = tokens_.peek().place;
  std::string name = lower_case(string_argument("a name"));
  std::erase_if(name, [](char c) { return c == '-' || c == '_'; });
  const auto found = std::find_if(std::begin(known), std::end(known), [&](const Known& k) { return k.name == name; });
  if (found == std::end(known)) {
    std::vector<std::string_view> names;
    for (const Known& k : known) names.push_back(k.name);
    messages_.fail(place, fmt::format("unknown Option \"{}\"{}", printable(name), suggestion(name, names, {})));
  }
  const Token value = tokens_.peek();
  std::int64_t seed = 0;
  double number = 0;
  const bool is_number = value.kind == Token::Kind::number, is_string = value.kind == Token::Kind::string;
  const bool is_true = value.text == "true", is_flag = !is_number && (is_true || value.text == "false");
  const bool fits = found->kind == Kind::flag   ? is_flag
                    : found->kind == Kind::text ? is_string
                    : found->kind == Kind::seed
                        ? is_number && read_integer(value.text, seed) == NumberStatus::ok && seed >= 0
                        : is_number && read_number(value.text, number) == NumberStatus::ok;
  if (!fits)
    messages_.fail(value.place,
                   fmt::format("Option \"{}\" must be {}, found {}", name, found->expected, describe(value)));
  tokens_.next();
  if (found->kind == Kind::flag && is_string)
    messages_.old_spelling(value.place, "true and false are now written without quotes");
  if (found->kind == Kind::seed)
    global_seed_ = static_cast<std::uint32_t>(seed);
  else if (found->kind != Kind::flag || is_true)  // what is not asked for is not missed
    messages_.warning(place, fmt::format("Option \"{}\" has no effect", name));
}

}  // namespace brume

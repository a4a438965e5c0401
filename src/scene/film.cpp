// Film: the picture's size and place, and what becomes of radiance on it.
#include <fmt/format.h>

#include <algorithm>

#include "scene/reader.h"

namespace brume {

namespace {

constexpr std::int64_t max_edge = 65536, max_pixels = std::int64_t{1} << 28;
constexpr double min_white = 4000, max_white = 25000;  // kelvin: daylight

}  // namespace

void Reader::film() {
  std::string type = string_argument("a type");
  modernise(type, "image", "rgb");
  if (type != "rgb") unknown_type(argument_, "Film", type, {"rgb"}, {"gbuffer", "spectral"});
  ParameterList p = parameters("Film \"rgb\"");
  scene_.film = {};
  scene_.film.filename = p.string("filename", scene_.film.filename);
  scene_.film.width = static_cast<int>(p.integer("xresolution", 1280, 1, max_edge));
  scene_.film.height = static_cast<int>(p.integer("yresolution", 720, 1, max_edge));
  if (std::int64_t{scene_.film.width} * scene_.film.height > max_pixels)
    p.error(p.place(),
            fmt::format("{} x {} pixels are more than {}", scene_.film.width, scene_.film.height, max_pixels));
  scene_.film.save_fp16 = p.boolean("savefp16", true);
  p.ignore({"float diagonal"});
  crop_window(p);
  sensor(p);
  p.finish();
}

// What becomes of radiance on the film: exposure, white balance, the picture's colour space.
void Reader::sensor(ParameterList& p) {
  FilmDescription& film = scene_.film;
  film.colour_space = state_.colour_space;
  p.rename("maxsampleluminance", "maxcomponentvalue");
  film.max_component = p.number("maxcomponentvalue", film.max_component, Range::above(0));
  if (const double scale = p.number("scale", 1, Range::above(0)); scale != 1 || p.has(ParameterType::float_, "scale")) {
    messages_.old_spelling(p.place_of(ParameterType::float_, "scale"),
                           "\"float scale\" is now \"float iso\", which is 100 times it");
    film.iso = 100 * scale;
  }
  film.iso = p.number("iso", film.iso, Range::above(0));
  film.white_balance = p.number("whitebalance", 0, Range::from_to(0, max_white));
  if (film.white_balance > 0 && film.white_balance < min_white)
    p.value_error(*p.find(ParameterType::float_, "whitebalance"), 0,
                  fmt::format("must be 0 or from {} to {} kelvin, found {}", min_white, max_white, film.white_balance));
  const std::string name = p.string("sensor", "cie1931");
  if (name == "cie1931") return;
  const std::vector<std::string_view> sensors = {
      "cie1931",       "canon_eos_100d",     "canon_eos_1dx_mkii", "canon_eos_200d",    "canon_eos_200d_mkii",
      "canon_eos_5d",  "canon_eos_5d_mkii",  "canon_eos_5d_mkiii", "canon_eos_5d_mkiv", "canon_eos_5ds",
      "canon_eos_m",   "hasselblad_l1d_20c", "nikon_d810",         "nikon_d850",        "sony_ilce_6400",
      "sony_ilce_7m3", "sony_ilce_7rm3",     "sony_ilce_9"};
  const Place place = p.place_of(ParameterType::string, "sensor");
  if (std::find(sensors.begin(), sensors.end(), name) != sensors.end())
    messages_.warning(place,
                      fmt::format("the sensor \"{}\" is taken as \"cie1931\": colours are those that eyes see, not "
                                  "those of the camera",
                                  name));
  else
    messages_.error(place, fmt::format("unknown sensor \"{}\"{}", printable(name), suggestion(name, sensors, {})));
}

// "cropwindow" in fractions of the picture, or "pixelbounds" in pixels, which the former overrides.
void Reader::crop_window(ParameterList& p) {
  FilmDescription& film = scene_.film;
  if (const Parameter* bounds = p.find(ParameterType::integer, "pixelbounds")) {
    const std::vector<std::int64_t>& v = bounds->integers;
    if (v.size() != 4)
      p.value_error(*bounds, 4, fmt::format("takes 4 integers, found {}", v.size()));
    else if (!(0 <= v[0] && v[0] < v[1] && v[1] <= film.width && 0 <= v[2] && v[2] < v[3] && v[3] <= film.height))
      p.value_error(*bounds, 0,
                    fmt::format("must be x0 x1 y0 y1 with 0 <= x0 < x1 <= {} and 0 <= y0 < y1 <= {}, the size of the "
                                "picture",
                                film.width, film.height));
    else
      for (std::size_t i = 0; i < 4; ++i)
        film.crop_window[i] = static_cast<double>(v[i]) / (i < 2 ? film.width : film.height);
  }
  const Parameter* window = p.find(ParameterType::float_, "cropwindow");
  if (!window) return;
  const std::vector<double>& v = window->numbers;
  if (v.size() != 4) {
    p.value_error(*window, 4, fmt::format("takes 4 numbers, found {}", v.size()));
  } else if (!(0 <= v[0] && v[0] < v[1] && v[1] <= 1 && 0 <= v[2] && v[2] < v[3] && v[3] <= 1)) {
    p.value_error(*window, 0, "must be x0 x1 y0 y1 with 0 <= x0 < x1 <= 1 and 0 <= y0 < y1 <= 1");
  } else {
    film.crop_window = {v[0], v[1], v[2], v[3]};
    if (const PixelBox crop = cropped_pixels(film); crop.width() < 1 || crop.height() < 1)
      p.value_error(*window, 0, fmt::format("holds no pixel of the {} x {} pixels", film.width, film.height));
  }
}

}  // namespace brume

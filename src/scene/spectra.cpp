#include "scene/spectra.h"

#include <algorithm>
#include <cmath>

#include "scene/colour.h"

namespace brume {

namespace {

constexpr int d65_step = 10;  // nm
constexpr std::array<double, 48> d65_table = {
    46.6383, 52.0891, 49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861,
    115.923, 108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046, 100.000, 96.3342, 95.7880, 88.6856,
    90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.3490,
    61.6040, 69.8856, 75.0870, 63.5927, 46.4182, 66.8054, 63.3828, 64.3040, 59.4519, 51.9590, 57.4406, 60.3125};

struct NamedLight {
  std::string_view name;
  Chromaticity white;
};
constexpr NamedLight named_lights[] = {
    {"stdillum-A", {0.44758, 0.40745}},   {"stdillum-D50", {0.34567, 0.35851}}, {"stdillum-D65", {0.31270, 0.32900}},
    {"stdillum-F1", {0.31310, 0.33727}},  {"stdillum-F2", {0.37208, 0.37529}},  {"stdillum-F3", {0.40910, 0.39430}},
    {"stdillum-F4", {0.44018, 0.40329}},  {"stdillum-F5", {0.31379, 0.34531}},  {"stdillum-F6", {0.37790, 0.38835}},
    {"stdillum-F7", {0.31292, 0.32933}},  {"stdillum-F8", {0.34588, 0.35875}},  {"stdillum-F9", {0.37417, 0.37281}},
    {"stdillum-F10", {0.34609, 0.35986}}, {"stdillum-F11", {0.38052, 0.37713}}, {"stdillum-F12", {0.43695, 0.40441}},
    {"illum-acesD60", {0.32168, 0.33767}}};

// Walks along a spectrum: the value at wavelengths that only increase.
class PairWalk {
 public:
  explicit PairWalk(const std::vector<double>& pairs) : pairs_(pairs) {}
  double at(double nm) {
    if (pairs_.empty() || nm < pairs_.front() || nm > pairs_[pairs_.size() - 2]) return 0;
    while (next_ + 2 < pairs_.size() && pairs_[next_] < nm) next_ += 2;
    if (next_ == 0) return pairs_[1];
    const double x0 = pairs_[next_ - 2], y0 = pairs_[next_ - 1], x1 = pairs_[next_], y1 = pairs_[next_ + 1];
    return y0 + (y1 - y0) * (nm - x0) / (x1 - x0);
  }

 private:
  const std::vector<double>& pairs_;
  std::size_t next_ = 0;
};

// XYZ divided by Y.
Vector3 at_luminance_1(Vector3 xyz) { return (1 / xyz.y) * xyz; }

const Matrix3& rec709_from_xyz() {
  static const Matrix3 matrix = inverse(xyz_from(ColourSpace::srgb));
  return matrix;
}

}  // namespace

double d65_power(double nm) {
  const double step = std::clamp((nm - shortest_wavelength) / d65_step, 0.0, d65_table.size() - 1.0);
  const auto i = std::min(static_cast<std::size_t>(step), d65_table.size() - 2);
  return std::lerp(d65_table[i], d65_table[i + 1], step - static_cast<double>(i));
}

Spectrum spectrum_colour(const std::vector<double>& pairs, SpectrumOf of) {
  PairWalk walk(pairs);
  Vector3 xyz, white;
  for (int nm = shortest_wavelength; nm <= longest_wavelength; ++nm) {
    const double daylight = d65_power(nm);
    const Vector3 matching = matching_functions(nm);
    xyz = xyz + (walk.at(nm) * (of == SpectrumOf::light ? 1 : daylight)) * matching;
    white = white + daylight * matching;
  }
  if (of == SpectrumOf::light) {
    if (!(xyz.y > 0)) return {};
    xyz = at_luminance_1(xyz);
    white = at_luminance_1(white);
  }
  const Vector3 rgb = rec709_from_xyz() * xyz, white_rgb = rec709_from_xyz() * white;
  Spectrum colour;
  for (int c = 0; c < channel_count; ++c) colour[c] = static_cast<float>(rgb[c] / white_rgb[c]);
  if (of == SpectrumOf::light) colour = static_cast<float>(1 / luminance(colour)) * colour;
  return colour;
}

const std::vector<std::string_view>& light_spectrum_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const NamedLight& light : named_lights) all.push_back(light.name);
    return all;
  }();
  return names;
}

std::optional<Spectrum> named_light(std::string_view name) {
  for (const NamedLight& light : named_lights)
    if (light.name == name) {
      const auto [x, y] = light.white;
      const Vector3 rgb = rec709_from_xyz() * Vector3{x / y, 1, (1 - x - y) / y};
      Spectrum colour;
      for (int c = 0; c < channel_count; ++c) colour[c] = static_cast<float>(std::max(0.0, rgb[c]));
      return static_cast<float>(1 / luminance(colour)) * colour;
    }
  return {};
}

}  // namespace brume

#include "scene/colour.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/spectra.h"

namespace brume {

namespace {

constexpr double min_kelvin = 500, max_kelvin = 1e6;

// From CIE XYZ to linear Rec.709 with its D65 white.
// Source: the primaries and white of ITU-R BT.709-6, table 1.3 and 1.4.
constexpr double rec709_from_xyz[3][3] = {{3.2409699419045226, -1.5373831775700940, -0.4986107602930034},
                                          {-0.9692436362808796, 1.8759675015077202, 0.0415550574071756},
                                          {0.0556300796969937, -0.2039769588889765, 1.0569715142428786}};

Spectrum from_xyz(const Vector3& xyz) {
  Spectrum rgb;
  for (int c = 0; c < 3; ++c)
    rgb[c] = static_cast<float>(
        std::max(0.0, rec709_from_xyz[c][0] * xyz.x + rec709_from_xyz[c][1] * xyz.y + rec709_from_xyz[c][2] * xyz.z));
  return rgb;
}

Spectrum at_luminance_1(const Spectrum& colour) { return static_cast<float>(1 / luminance(colour)) * colour; }

// A Gaussian with one width on each side of its mean.
double lobe(double x, double mean, double below, double above) {
  const double t = (x - mean) / (x < mean ? below : above);
  return std::exp(-0.5 * t * t);
}

// Planck's law but for a factor that does not depend on the wavelength.
double planck(double nm, double kelvin) {
  constexpr double second_radiation_constant = 1.438776877e7;  // nm K
  const double x = 560 / nm;
  return x * x * x * x * x / std::expm1(second_radiation_constant / (nm * kelvin));
}

Vector3 blackbody_xyz(double kelvin) {
  static const auto matching = [] {
    std::array<Vector3, longest_wavelength - shortest_wavelength + 1> by_nm;
    for (std::size_t i = 0; i < by_nm.size(); ++i)
      by_nm[i] = matching_functions(shortest_wavelength + static_cast<double>(i));
    return by_nm;
  }();
  Vector3 xyz;
  for (std::size_t i = 0; i < matching.size(); ++i)
    xyz = xyz + planck(shortest_wavelength + static_cast<double>(i), kelvin) * matching[i];
  return xyz;
}

// A colour in Rec.709, where negative channels, and of an albedo those above 1, are what no colour there can have.
ColourFault within_rec709(ColourUse use, Spectrum& colour) {
  constexpr float rounding = 1e-5f;
  const float highest = use == ColourUse::albedo ? 1 : std::numeric_limits<float>::max();
  bool cut = false;
  for (int c = 0; c < channel_count; ++c) {
    const float v = colour[c];
    cut = cut || v < -rounding * max_value(colour) || v > highest * (1 + rounding);
    colour[c] = std::clamp(v, 0.0f, highest);
  }
  if (!cut) return {};
  return {{}, "is a colour that lies outside Rec.709, in which Brume computes; it is cut to the nearest there", 0};
}

ColourFault rgb_colour(const Parameter& p, ColourUse use, Spectrum& colour) {
  if (p.numbers.size() != 3) return {fmt::format("takes 3 numbers, found {}", p.numbers.size()), {}, 3};
  for (std::size_t c = 0; c < 3; ++c) {
    const double v = p.numbers[c];
    if (v < 0) return {fmt::format("must not be negative, found {}", v), {}, c};
    if (use == ColourUse::albedo && v > 1) return {fmt::format("must be from 0 to 1, found {}", v), {}, c};
    colour[static_cast<int>(c)] = static_cast<float>(v);
  }
  if (p.space == ColourSpace::srgb) return {};
  const Vector3 rgb = rec709_from(p.space, use == ColourUse::light ? Whites::kept : Whites::aligned) *
                      Vector3{p.numbers[0], p.numbers[1], p.numbers[2]};
  for (int c = 0; c < channel_count; ++c) colour[c] = static_cast<float>(rgb[c]);
  return within_rec709(use, colour);
}

ColourFault named_spectrum(const Parameter& p, ColourUse use, Spectrum& colour) {
  const std::string& name = p.strings[0];
  if (p.strings.size() > 1) return {"takes one name or pairs of numbers", {}, 0};
  if (use == ColourUse::light)
    if (const auto light = named_light(name)) return colour = *light, ColourFault{};
  const std::string known = use == ColourUse::light
                                ? suggestion(name, light_spectrum_names(),
                                             "lights are stdillum-A, -D50, -D65 and -F1 "
                                             "to -F12, and illum-acesD60")
                                : "; it can be pairs of a wavelength and a value, or a file of them";
  return {fmt::format("names \"{}\", which is no spectrum for this and no file{}", printable(name), known), {}, 0};
}

// Checks the pairs wavelength, value.
ColourFault pairs_fault(const std::vector<double>& v, ColourUse use) {
  if (v.size() % 2 != 0)
    return {fmt::format("takes pairs of a wavelength in nm and a value, found {} numbers", v.size()), {}, v.size() - 1};
  for (std::size_t i = 0; i < v.size(); i += 2) {
    if (i > 0 && v[i] <= v[i - 2])
      return {fmt::format("must have increasing wavelengths, found {} after {}", v[i], v[i - 2]), {}, i};
    if (v[i + 1] < 0) return {fmt::format("must not be negative, found {}", v[i + 1]), {}, i + 1};
    if (use == ColourUse::albedo && v[i + 1] > 1)
      return {fmt::format("must be from 0 to 1, found {}", v[i + 1]), {}, i + 1};
  }
  return {};
}

// Whether the pairs have one value wherever there is anything to see.
bool is_constant(const std::vector<double>& v) {
  for (std::size_t i = 1; i < v.size(); i += 2)
    if (v[i] != v[1]) return false;
  return v.front() <= shortest_wavelength && v[v.size() - 2] >= longest_wavelength;
}

ColourFault spectrum_colour(const Parameter& p, ColourUse use, Spectrum& colour) {
  if (!p.strings.empty()) return named_spectrum(p, use, colour);
  if (ColourFault fault = pairs_fault(p.numbers, use); !fault.message.empty()) return fault;
  if (!is_constant(p.numbers)) {
    colour = spectrum_colour(p.numbers, use == ColourUse::light ? SpectrumOf::light : SpectrumOf::property);
    return within_rec709(use, colour);
  }
  const double value = p.numbers[1];
  if (use != ColourUse::light)
    colour = constant_spectrum(static_cast<float>(value));
  else
    colour = value > 0 ? equal_energy_white() : Spectrum{};
  return {};
}

ColourFault blackbody(const Parameter& p, Spectrum& colour) {
  if (p.numbers.size() != 1)
    return {fmt::format("takes one temperature in kelvin, found {} numbers", p.numbers.size()), {}, 1};
  const double kelvin = p.numbers[0];
  if (kelvin < min_kelvin || kelvin > max_kelvin)
    return {fmt::format("must be from {} to {} kelvin, found {}", min_kelvin, max_kelvin, kelvin), {}, 0};
  colour = blackbody_colour(kelvin);
  return {};
}

}  // namespace

Vector3 matching_functions(double nm) {
  return {
      1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) - 0.065 * lobe(nm, 501.1, 20.4, 26.2),
      0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
      1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

double luminance(const Spectrum& colour) {
  return 0.2126390058715104 * static_cast<double>(colour[0]) + 0.7151686787677559 * static_cast<double>(colour[1]) +
         0.0721923153607337 * static_cast<double>(colour[2]);
}

Spectrum equal_energy_white() { return at_luminance_1(from_xyz({1, 1, 1})); }

Spectrum blackbody_emission(double kelvin) {
  if (!(kelvin > 0)) return {};
  constexpr double wien = 2.897771955e6;  // nm K: where Planck's law is largest
  return from_xyz((1 / planck(wien / kelvin, kelvin)) * blackbody_xyz(kelvin));
}

Spectrum blackbody_colour(double kelvin) {
  const Vector3 xyz = blackbody_xyz(kelvin);
  return at_luminance_1(from_xyz((1 / xyz.y) * xyz));
}

ColourFault parameter_colour(const Parameter& p, ColourUse use, Spectrum& colour) {
  switch (p.type) {
    case ParameterType::rgb:
      return rgb_colour(p, use, colour);
    case ParameterType::spectrum:
      return spectrum_colour(p, use, colour);
    default:
      return blackbody(p, colour);
  }
}

}  // namespace brume

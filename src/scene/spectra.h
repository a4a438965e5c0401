// Spectra as pairs of a wavelength and a value, or by name, and the Rec.709 colours that they have.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "base/colour_space.h"
#include "base/spectrum.h"

namespace brume {

// Wavelengths in nm that pbrt takes for visible.
constexpr int shortest_wavelength = 360, longest_wavelength = 830;

// The relative power of the daylight D65 at a wavelength, 100 at 560 nm. Source: CIE 15:2004, table T.1, every 10 nm.
double d65_power(double nm);

// What a spectrum is the spectrum of: a light, whose colour is given at luminance 1, or a reflectance or coefficient,
// whose colour is what it makes of D65, divided by D65.
enum class SpectrumOf { light, property };

// The colour of the spectrum that runs straight between its points and is 0 beyond them; `pairs` holds increasing
// wavelengths in nm, each followed by a value. The CIE 1931 matching functions are a fit (scene/colour.h) whose white
// is off by some ten-thousandths; colours are taken relative to D65 as the fit sees it, so that D65 has equal R, G and
// B. Channels may be negative: there are colours that Rec.709 cannot say. Of a light without power, black.
Spectrum spectrum_colour(const std::vector<double>& pairs, SpectrumOf of);

// pbrt's lights: stdillum-A, -D50, -D65, -F1 to -F12, and illum-acesD60.
const std::vector<std::string_view>& light_spectrum_names();
// The colour of one, at luminance 1; none for other names. Sources: CIE 15:2004, table T.3; SMPTE ST 2065-1.
std::optional<Spectrum> named_light(std::string_view name);

}  // namespace brume

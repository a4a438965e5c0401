// Colours of scenes as Rec.709 triples: rgb, spectra and blackbodies.
#pragma once

#include <string>

#include "base/spectrum.h"
#include "scene/parameters.h"

namespace brume {

// Rec.709's luminance of a colour.
// Source: ITU-R BT.709-6, section 3.2.
double luminance(const Spectrum& colour);

// The CIE 1931 matching functions, as (x, y, z), at a wavelength in nm.
//
// Source: the fit of C. Wyman, P.-P. Sloan and P. Shirley, "Simple Analytic Approximations to the CIE XYZ Color
// Matching Functions", JCGT 2(2), 2013, eq. 4 and table 1.
Vector3 matching_functions(double nm);

// The spectrum that is the same at all wavelengths, at luminance 1.
Spectrum equal_energy_white();

// The colour of a black body at a temperature in kelvin, from 500 to 1e6, at luminance 1. Below about 1900 K its blue
// lies outside Rec.709 and is cut at 0.
//
// Source: Planck's law.
Spectrum blackbody_colour(double kelvin);

// What a black body emits at a temperature in kelvin, by Planck's law divided by its maximum over all wavelengths, as
// pbrt takes it for media with temperatures: XYZ is the integral over nanometres, so that luminance is at most 106.86.
// Sources as above; 0 at 0.
Spectrum blackbody_emission(double kelvin);

struct ColourFault {
  std::string message;    // an error; empty: none
  std::string warning;    // what is taken otherwise than written; empty: nothing
  std::size_t index = 0;  // of the value at fault
};

// The colour that a parameter of type rgb, spectrum or blackbody stands for:
//   albedo       rgb within [0, 1]; a spectrum's colour under D65, divided by D65's, which of a constant is its value
//   coefficient  rgb at least 0; a spectrum likewise
//   light        rgb at least 0, itself; any spectrum or blackbody its colour, at luminance 1, as pbrt normalises the
//                spectra of lights
// An rgb of another colour space is turned into Rec.709: of a light as the same light, else with its white made white.
// What lies outside is cut to the nearest there, with a warning.
ColourFault parameter_colour(const Parameter& parameter, ColourUse use, Spectrum& colour);

}  // namespace brume

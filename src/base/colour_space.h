// Linear colour spaces that scenes and pictures may be in, and how they turn into Rec.709, in which everything is
// computed.
#pragma once

#include <array>
#include <string_view>

#include "base/geometry.h"

namespace brume {

enum class ColourSpace { srgb, rec2020, dci_p3, aces2065_1 };
// As scenes call them; srgb has the primaries of Rec.709.
inline constexpr std::array<std::string_view, 4> colour_space_names{"srgb", "rec2020", "dci-p3", "aces2065-1"};

struct Chromaticity {
  double x = 0, y = 0;  // CIE 1931
};
struct Primaries {
  Chromaticity red, green, blue, white;
};
// Sources: ITU-R BT.709-6 and BT.2020-2; SMPTE RP 431-2's primaries, with the white D65 as pbrt and displays have it;
// SMPTE ST 2065-1.
const Primaries& primaries(ColourSpace space);

struct Matrix3 {
  std::array<std::array<double, 3>, 3> m{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  bool operator==(const Matrix3&) const = default;
};
Matrix3 operator*(const Matrix3& a, const Matrix3& b);
Matrix3 operator*(double s, const Matrix3& a);
Vector3 operator*(const Matrix3& a, Vector3 v);
Matrix3 inverse(const Matrix3& a);

// From RGB to CIE XYZ, where white has Y = 1.
Matrix3 xyz_from(ColourSpace space);
// XYZ as it looks under the white `to` of what looks so under the white `from`: von Kries, in Bradford's cone space.
// Source: K. M. Lam, Metamerism and colour constancy, thesis, University of Bradford, 1985; the matrix as ICC.1:2022,
// annex E, has it.
Matrix3 white_adaptation(Chromaticity from, Chromaticity to);

// What RGB of a space is in Rec.709: the same light, or, for reflectances and coefficients, with its white made white.
enum class Whites { kept, aligned };
Matrix3 rec709_from(ColourSpace space, Whites whites);

// The white that a camera is balanced for: daylight from 4000 to 25000 kelvin.
// Source: CIE 15:2004, eq. 3.3 and 3.4, with the temperature on the scale of today's radiation constant.
Chromaticity daylight(double kelvin);

}  // namespace brume

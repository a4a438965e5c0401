#include "scene/colour.h"

#include <gtest/gtest.h>

#include <array>

namespace brume {
namespace {

// CIE x, y of a linear Rec.709 colour.
// Source: ITU-R BT.709-6's primaries and white, as the usual matrix to XYZ.
std::array<double, 2> chromaticity(const Spectrum& c) {
  const double r = static_cast<double>(c[0]), g = static_cast<double>(c[1]), b = static_cast<double>(c[2]);
  const double x = 0.4123908 * r + 0.3575843 * g + 0.1804808 * b;
  const double y = 0.2126390 * r + 0.7151687 * g + 0.0721923 * b;
  const double z = 0.0193308 * r + 0.1191948 * g + 0.9505322 * b;
  return {x / (x + y + z), y / (x + y + z)};
}

// Points of the Planckian locus, for the CIE 1931 observer. Source: CIE 15:2004; 2856 K is illuminant A. The fit of the
// matching functions is good to a few thousandths.
TEST(Colour, BlackbodiesLieOnThePlanckianLocus) {
  const std::array<std::array<double, 3>, 4> locus{
      {{2856, 0.4476, 0.4074}, {4000, 0.3805, 0.3768}, {6500, 0.3135, 0.3237}, {10000, 0.2807, 0.2884}}};
  for (const auto& [kelvin, x, y] : locus) {
    const auto found = chromaticity(blackbody_colour(kelvin));
    EXPECT_NEAR(found[0], x, 0.004) << kelvin;
    EXPECT_NEAR(found[1], y, 0.004) << kelvin;
  }
}

TEST(Colour, LightsHaveLuminanceOneWhateverTheTemperature) {
  for (const double kelvin : {500.0, 1000.0, 1900.0, 5000.0, 20000.0, 1e6}) {
    const Spectrum c = blackbody_colour(kelvin);
    EXPECT_NEAR(luminance(c), 1, 1e-6) << kelvin;
    for (int i = 0; i < 3; ++i) EXPECT_GE(c[i], 0) << kelvin;
  }
  EXPECT_NEAR(luminance(equal_energy_white()), 1, 1e-6);
}

TEST(Colour, EqualEnergyWhiteIsPinkishBesideD65) {
  const auto c = chromaticity(equal_energy_white());
  EXPECT_NEAR(c[0], 1.0 / 3, 1e-6);
  EXPECT_NEAR(c[1], 1.0 / 3, 1e-6);
}

}  // namespace
}  // namespace brume

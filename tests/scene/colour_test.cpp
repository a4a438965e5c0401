#include "scene/colour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

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

// The CIE 1931 matching functions every 10 nm from 380 nm. Source: CIE 15:2004, table T.4.
constexpr std::array<std::array<double, 3>, 41> cie_1931{
    {{0.0014, 0.0, 0.0065},   {0.0042, 0.0001, 0.0201}, {0.0143, 0.0004, 0.0679}, {0.0435, 0.0012, 0.2074},
     {0.1344, 0.004, 0.6456}, {0.2839, 0.0116, 1.3856}, {0.3483, 0.023, 1.7471},  {0.3362, 0.038, 1.7721},
     {0.2908, 0.06, 1.6692},  {0.1954, 0.091, 1.2876},  {0.0956, 0.139, 0.813},   {0.032, 0.208, 0.4652},
     {0.0049, 0.323, 0.272},  {0.0093, 0.503, 0.1582},  {0.0633, 0.71, 0.0782},   {0.1655, 0.862, 0.0422},
     {0.2904, 0.954, 0.0203}, {0.4334, 0.995, 0.0087},  {0.5945, 0.995, 0.0039},  {0.7621, 0.952, 0.0021},
     {0.9163, 0.87, 0.0017},  {1.0263, 0.757, 0.0011},  {1.0622, 0.631, 0.0008},  {1.0026, 0.503, 0.0003},
     {0.8544, 0.381, 0.0002}, {0.6424, 0.265, 0.0},     {0.4479, 0.175, 0.0},     {0.2835, 0.107, 0.0},
     {0.1649, 0.061, 0.0},    {0.0874, 0.032, 0.0},     {0.0468, 0.017, 0.0},     {0.0227, 0.0082, 0.0},
     {0.0114, 0.0041, 0.0},   {0.0058, 0.0021, 0.0},    {0.0029, 0.001, 0.0},     {0.0014, 0.0005, 0.0},
     {0.0007, 0.0003, 0.0},   {0.0003, 0.0001, 0.0},    {0.0002, 0.0001, 0.0},    {0.0001, 0.0, 0.0},
     {0.0, 0.0, 0.0}}};

// Planck's law over its maximum, times a matching function: integrated by the trapezoidal rule.
double tristimulus(double kelvin, std::size_t function) {
  const auto planck = [kelvin](double nm) { return std::pow(nm, -5) / std::expm1(1.438776877e7 / (nm * kelvin)); };
  double sum = 0;
  for (std::size_t i = 0; i < cie_1931.size(); ++i)
    sum += 10 * cie_1931[i][function] * planck(380 + 10 * static_cast<double>(i));
  return sum / planck(2.897771955e6 / kelvin);
}

// What media with temperatures emit: luminance within 1 % of direct integration (2 % at 1000 K), and no channel further
// from its value than 4 % of the colour's largest (10 % at 1000 K), once channels are cut at 0.
TEST(Colour, EmissionByTemperatureIsPlancksLawUnderTheMatchingFunctions) {
  for (const double kelvin : {1000.0, 1500.0, 2000.0, 3000.0, 5000.0, 6500.0, 10000.0, 50000.0}) {
    const double tolerance = kelvin < 1500 ? 0.1 : 0.04;
    const double x = tristimulus(kelvin, 0), y = tristimulus(kelvin, 1), z = tristimulus(kelvin, 2);
    const Spectrum found = blackbody_emission(kelvin);
    EXPECT_NEAR(luminance(found), y, (kelvin < 1500 ? 0.02 : 0.01) * y) << kelvin;
    const std::array<double, 3> expected{3.2409699 * x - 1.5373832 * y - 0.4986108 * z,
                                         -0.9692436 * x + 1.8759675 * y + 0.0415551 * z,
                                         0.0556301 * x - 0.2039770 * y + 1.0569715 * z};
    const double largest = *std::max_element(expected.begin(), expected.end());
    for (int c = 0; c < channel_count; ++c)
      EXPECT_NEAR(found[c], std::max(0.0, expected[static_cast<std::size_t>(c)]), tolerance * largest)
          << kelvin << " K, channel " << c;
  }
  EXPECT_TRUE(is_zero(blackbody_emission(0)));
  EXPECT_TRUE(is_zero(blackbody_emission(-50)));
}

}  // namespace
}  // namespace brume

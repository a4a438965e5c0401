// Colours that scenes give by spectra, by names, in other colour spaces and as measured media.
#include "scene/spectra.h"

#include <filesystem>
#include <fstream>

#include "scene/colour.h"
#include "scene/medium_presets.h"
#include "scene_test.h"

namespace brume {
namespace {

void expect_near(const Spectrum& found, std::array<double, 3> expected, double tolerance) {
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(found[static_cast<int>(c)], expected[c], tolerance) << "channel " << c;
}

std::vector<double> sampled(double (*value)(double)) {
  std::vector<double> pairs;
  for (int nm = 350; nm <= 840; nm += 5) pairs.insert(pairs.end(), {static_cast<double>(nm), value(nm)});
  return pairs;
}

Spectrum light_of(const std::string& parameters) {
  const SceneDescription s = world_of("LightSource \"infinite\" " + parameters);
  return s.lights.size() == 1 ? std::get<InfiniteLight>(s.lights[0].kind).radiance : Spectrum{};
}

Spectrum reflectance_of(const std::string& text) {
  const SceneDescription s = world_of(text + " Shape \"sphere\"");
  return std::get<DiffuseMaterial>(s.shapes.at(0).material).reflectance.value;
}

// Catches matching functions without the white that they are taken relative to: as the fit has it, D65 comes out by
// more than the tolerance greenish.
TEST(Spectra, D65IsWhite) {
  const std::vector<double> d65 = sampled(d65_power);
  expect_near(spectrum_colour(d65, SpectrumOf::light), {1, 1, 1}, 1e-4);
  std::string pairs;
  for (const double v : d65) pairs += std::to_string(v) + " ";
  expect_near(light_of("\"spectrum L\" [" + pairs + "]"), {1, 1, 1}, 1e-4);
  EXPECT_EQ(light_of("\"spectrum L\" \"stdillum-D65\""), constant_spectrum(1));
  Vector3 xyz;
  for (int nm = 360; nm <= 830; ++nm) xyz = xyz + d65_power(nm) * matching_functions(nm);
  const double sum = xyz.x + xyz.y + xyz.z;
  EXPECT_NEAR(xyz.x / sum, 0.3127, 2e-4);  // the table is D65's, as far as the fit can tell
  EXPECT_NEAR(xyz.y / sum, 0.3290, 2e-4);
  const Vector3 unbalanced = inverse(xyz_from(ColourSpace::srgb)) * ((1 / xyz.y) * xyz);  // the twin
  EXPECT_GT(unbalanced.y - unbalanced.x, 3e-4);
}

// Illuminant A is Planck's law at 2848 K with the radiation constant of 1931, 2856 K with today's: the sampled
// spectrum, the named one and the blackbody must agree. Source: CIE 15:2004.
TEST(Spectra, IlluminantAIsABlackbody) {
  const Spectrum named = light_of("\"spectrum L\" \"stdillum-A\"");
  const auto planck = [](double nm) {
    return 100 * std::pow(560 / nm, 5) * std::expm1(1.435e7 / (2848 * 560)) / std::expm1(1.435e7 / (2848 * nm));
  };
  const Spectrum summed = spectrum_colour(sampled(planck), SpectrumOf::light);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(named[c], summed[c], 0.02f);
    EXPECT_NEAR(named[c], blackbody_colour(2856)[c], 0.02f);
  }
  EXPECT_NEAR(luminance(named), 1, 1e-6);
  EXPECT_GT(named[0], 1.5f * named[1]);
}

TEST(Spectra, ConstantsAreThemselves) {
  EXPECT_EQ(reflectance_of("Material \"diffuse\" \"spectrum reflectance\" [200 0.3 900 0.3]"), constant_spectrum(0.3f));
  expect_near(spectrum_colour({300, 0.3, 900, 0.3}, SpectrumOf::property), {0.3, 0.3, 0.3}, 1e-6);
  expect_near(spectrum_colour({300, 2, 900, 2}, SpectrumOf::light), {1.205, 0.948, 0.909}, 0.01);  // equal energy
  EXPECT_EQ(light_of("\"spectrum L\" [300 0 900 0]"), Spectrum{});
  // Nothing within sight of the eye.
  EXPECT_EQ(light_of("\"spectrum L\" [900 1 1000 1]"), Spectrum{});
  expect_near(spectrum_colour({900, 1, 1000, 1}, SpectrumOf::property), {0, 0, 0}, 0);
}

// A step that is 0 below 580 nm is red, and scaling a reflectance scales its colour.
TEST(Spectra, ColoursAreWhereTheyBelong) {
  const Spectrum red = spectrum_colour({300, 0, 579, 0, 580, 0.8, 900, 0.8}, SpectrumOf::property);
  EXPECT_GT(red[0], 0.6f);
  EXPECT_LT(red[2], 0.05f);
  const Spectrum half = spectrum_colour({300, 0, 579, 0, 580, 0.4, 900, 0.4}, SpectrumOf::property);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(half[c], red[c] / 2, 1e-6f);
  const Spectrum blue = spectrum_colour({400, 1, 480, 1, 490, 0}, SpectrumOf::property);
  EXPECT_GT(blue[2], 5 * std::max(blue[0], blue[1]));
}

TEST(Spectra, FilesOfPairsAreReadBesideTheScene) {
  namespace fs = std::filesystem;
  const std::string folder = testing::TempDir() + "/brume_spectra";
  fs::create_directories(folder);
  std::ofstream(folder + "/a.spd") << "# of a lamp\n300 1\n900 1  # constant\n";
  std::ofstream(folder + "/bad.spd") << "300 1\n900 one\n";
  std::ofstream(folder + "/empty.spd") << "# nothing\n";
  std::vector<Diagnostic> warnings;
  const SceneDescription s =
      read_scene_text("WorldBegin LightSource \"infinite\" \"spectrum L\" \"a.spd\"", "t", folder, warnings);
  EXPECT_EQ(std::get<InfiniteLight>(s.lights.at(0).kind).radiance, equal_energy_white());
  const auto error = [&](const std::string& name) -> std::string {
    try {
      read_scene_text("WorldBegin LightSource \"infinite\" \"spectrum L\" \"" + name + "\"", "t", folder, warnings);
    } catch (const InputError& e) {
      return e.diagnostics().front().message;
    }
    return "";
  };
  EXPECT_EQ(error("bad.spd"), "\"" + folder + "/bad.spd\" is no file of pairs of numbers: line 2 has the word one");
  EXPECT_EQ(error("empty.spd"), "\"" + folder + "/empty.spd\" is a file without any numbers");
  fs::remove_all(folder);
}

// White of ACES is 6000 K: a reflectance of 1 stays 1, a light becomes warmer than Rec.709's white.
TEST(ColourSpaces, TurnIntoRec709) {
  expect_near(reflectance_of("ColorSpace \"ACES2065-1\" Material \"diffuse\" \"rgb reflectance\" [1 1 1]"), {1, 1, 1},
              1e-6);
  const SceneDescription s = world_of(
      "ColorSpace \"aces2065-1\" AttributeBegin ColorSpace \"rec2020\" LightSource \"point\" \"rgb I\" [1 1 1] "
      "LightSource \"point\" \"rgb I\" [0.6 0.5 0.4] AttributeEnd LightSource \"point\" \"rgb I\" [1 1 1]");
  const auto intensity = [&](std::size_t i) { return std::get<PointLight>(s.lights.at(i).kind).intensity; };
  expect_near(intensity(0), {1, 1, 1}, 1e-6);
  // ITU-R BT.2087-0, the matrix of annex 2.
  expect_near(intensity(1),
              {1.660491 * 0.6 - 0.587641 * 0.5 - 0.072850 * 0.4, -0.124550 * 0.6 + 1.132900 * 0.5 - 0.008349 * 0.4,
               -0.018151 * 0.6 - 0.100579 * 0.5 + 1.118730 * 0.4},
              1e-5);
  EXPECT_GT(intensity(2)[0], 1.04f);
  EXPECT_LT(intensity(2)[2], 0.95f);
  EXPECT_NEAR(luminance(intensity(2)), 1, 1e-6);
}

// Defaults are in the space in which the Attribute directive stood.
TEST(ColourSpaces, DefaultsRememberTheirs) {
  const SceneDescription s = world_of(
      "ColorSpace \"rec2020\" Attribute \"light\" \"rgb I\" [0.6 0.5 0.4] ColorSpace \"srgb\" LightSource \"point\"");
  EXPECT_NEAR(std::get<PointLight>(s.lights.at(0).kind).intensity[0], 0.673334f, 1e-5f);
}

TEST(MediumPresets, AreThoseOfTheTable) {
  EXPECT_EQ(medium_presets().size(), 47u);
  const SceneDescription s = world_of(
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"string preset\" \"Skin1\" \"float scale\" 10 "
      "\"float g\" 0.5");
  expect_near(s.media.at(0).sigma_s, {7.4, 8.8, 10.1}, 1e-5);
  expect_near(s.media.at(0).sigma_a, {0.32, 1.7, 4.8}, 1e-5);
  EXPECT_EQ(s.media[0].phase_parameters, std::vector<float>{0.5f});
}

}  // namespace
}  // namespace brume

// What the film makes of radiance: exposure, white balance, the picture's colour space.
#include <gtest/gtest.h>

#include <cmath>

#include "compile/compile.h"
#include "render/scenes.h"

namespace brume {
namespace {

FilmResponse response(const SceneDescription& scene) {
  std::vector<Diagnostic> warnings;
  return compile(scene, 1, warnings).film_response;
}

void expect_near(const Spectrum& found, Vector3 expected, double tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(static_cast<double>(found[c]), expected[c], tolerance) << c;
}

// The light of a chromaticity, in Rec.709.
Spectrum light(Chromaticity c) {
  const Vector3 rgb = inverse(xyz_from(ColourSpace::srgb)) * Vector3{c.x / c.y, 1, (1 - c.x - c.y) / c.y};
  return {{static_cast<float>(rgb.x), static_cast<float>(rgb.y), static_cast<float>(rgb.z)}};
}

TEST(FilmResponse, IsNothingWhereNothingIsSaid) { EXPECT_EQ(response(needle_scene()).matrix, Matrix3()); }

TEST(FilmResponse, ExposureIsTimeTimesSpeed) {
  SceneDescription s = needle_scene();
  s.film.iso = 400;
  s.camera.shutter_open = 1;
  s.camera.shutter_close = 1.5;
  expect_near(response(s)({{1, 2, 3}}), {2, 4, 6}, 1e-6);
}

TEST(FilmResponse, LargeSamplesAreScaledDown) {
  SceneDescription s = needle_scene();
  s.film.max_component = 6;
  expect_near(response(s)({{3, 12, 6}}), {1.5, 6, 3}, 1e-6);
  expect_near(response(s)({{3, 5, 6}}), {3, 5, 6}, 0);
}

// Daylight of the temperature becomes grey, and other light does not: the twin is balanced for another temperature.
// The points of the daylight locus are CIE 15:2004's D50, D55 and D75.
TEST(FilmResponse, WhiteBalanceMakesDaylightGrey) {
  SceneDescription s = needle_scene();
  for (const auto& [kelvin, white] : {std::pair{5000.0, Chromaticity{0.34567, 0.35850}},
                                      {5500.0, {0.33242, 0.34743}},
                                      {7500.0, {0.29902, 0.31485}}}) {
    s.film.white_balance = kelvin;
    const Spectrum grey = response(s)(light(white));
    expect_near(grey, {1, 1, 1}, 2e-3);
    s.film.white_balance = 6504;
    const Spectrum twin = response(s)(light(white));
    EXPECT_GT(std::abs(twin[0] - twin[2]), 0.1f);
    expect_near(twin,
                {static_cast<double>(light(white)[0]), static_cast<double>(light(white)[1]),
                 static_cast<double>(light(white)[2])},
                2e-3);
  }
}

TEST(FilmResponse, ColourSpacesHoldTheSameLight) {
  for (const ColourSpace space : {ColourSpace::rec2020, ColourSpace::dci_p3, ColourSpace::aces2065_1}) {
    SceneDescription s = needle_scene();
    s.film.colour_space = space;
    const Spectrum there = response(s)({{0.2f, 0.5f, 0.9f}});
    const Vector3 back =
        rec709_from(space, Whites::kept) *
        Vector3{static_cast<double>(there[0]), static_cast<double>(there[1]), static_cast<double>(there[2])};
    expect_near({{0.2f, 0.5f, 0.9f}}, back, 1e-6);
    EXPECT_GT(std::abs(there[0] - 0.2f), 0.02f);
  }
  // Rec.709's red in BT.2020. Source: ITU-R BT.2087-0.
  SceneDescription s = needle_scene();
  s.film.colour_space = ColourSpace::rec2020;
  expect_near(response(s)({{1, 0, 0}}), {0.627404, 0.069097, 0.016391}, 1e-5);
}

// The picture of a sky shows it.
TEST(FilmResponse, IsAppliedToPictures) {
  SceneDescription s = needle_scene();
  s.lights = {sky(2)};
  s.film.iso = 50;
  std::vector<Diagnostic> warnings;
  Film film(1, 1, compile(s, 1, warnings).film_response);
  film.add(0, 0, {{2, 4, 6}});
  EXPECT_EQ(film.image().pixels, (std::vector<float>{1, 2, 3}));
}

}  // namespace
}  // namespace brume

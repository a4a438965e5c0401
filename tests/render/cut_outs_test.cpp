// Cut-outs: the share of rays that a surface stops is its alpha, for every integrator, of what the camera sees and of
// shadows. The faults this catches: a sphere that decides for both of its sides at once; an alpha that shadow rays do
// not know of; holes that lie the wrong way up; cut-outs that change the media around. Each twin shows the fault.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/diagnostics.h"
#include "compile/compile.h"
#include "render/scenes.h"

namespace brume {
namespace {

constexpr int samples = 40000;
constexpr float alpha = 0.3f;

// A pixel with rays that differ, seen before a sky of radiance 1.
SceneDescription sky_scene(const char* integrator, std::vector<ShapeDescription> shapes) {
  SceneDescription s = needle_scene({0, 0, -4});
  s.camera.fov = 10;
  s.integrator.name = integrator;
  s.lights = {sky(1)};
  s.shapes = std::move(shapes);
  return s;
}

ShapeDescription cut_out(ShapeDescription shape, float share) {
  shape.material = DiffuseMaterial{Spectrum{}};
  shape.inside = "";
  shape.alpha = constant_spectrum(share);
  return shape;
}
ShapeDescription sheet(double z, float share) { return cut_out(square_facing_z({0, 0, z}, 2, 0), share); }
ShapeDescription ball(float share) { return cut_out(sphere_shape({0, 0, 0}, 2, ""), share); }

double mean(const SceneDescription& scene) { return static_cast<double>(radiance(scene, samples)); }
double standard_error(double share) { return std::sqrt(share * (1 - share) / samples); }
void expect_share(double found, double expected) { EXPECT_NEAR(found, expected, 4 * standard_error(expected) + 1e-5); }
void expect_rejected(double found, double expected) {
  EXPECT_GT(std::abs(found - expected), 8 * standard_error(expected) + 1e-5);
}

class CutOuts : public testing::TestWithParam<const char*> {};

TEST_P(CutOuts, ASheetStopsTheShareThatItsAlphaIs) {
  const Image image = render_film(sky_scene(GetParam(), {sheet(0, alpha)}), samples).image();
  expect_share(static_cast<double>(image.pixels[0]), 1 - 0.3);
  expect_share(static_cast<double>(image.alpha[0]), 0.3);
  EXPECT_NEAR(image.depth[0], 4, 1e-4);
  EXPECT_EQ(mean(sky_scene(GetParam(), {sheet(0, 0)})), 1);
  EXPECT_EQ(mean(sky_scene(GetParam(), {sheet(0, 1)})), 0);
}

TEST_P(CutOuts, SurfacesOneBehindTheOtherDecideEachForItself) {
  expect_share(mean(sky_scene(GetParam(), {sheet(0, alpha), sheet(1, 0.5f)})), 0.7 * 0.5);
  const double both_sides = 0.7 * 0.7;
  expect_share(mean(sky_scene(GetParam(), {ball(alpha)})), both_sides);
  expect_rejected(mean(sky_scene(GetParam(), {sheet(0, alpha)})), both_sides);  // the twin: as one side alone
  SceneDescription placed = sky_scene(GetParam(), {});
  placed.objects = {{"ball", {ball(alpha)}}};
  placed.instances = {{"ball", translate({0, 0, 3}) * scale({2, 2, 1}), {}}};
  expect_share(mean(placed), both_sides);
}

// A floor of a radiance of about 0.2 under a light above, from which a sheet or a ball takes its share.
SceneDescription shadow_scene(const char* integrator, std::vector<ShapeDescription> shapes) {
  SceneDescription s = needle_scene();
  s.camera.world_from_camera = translate({0, 0.5, 0}) * rotate(90, {1, 0, 0});  // looks down
  s.camera.fov = 10;
  s.integrator.name = integrator;
  s.lights = {distant_light({0, 1, 0}, 1)};
  s.shapes = std::move(shapes);
  s.shapes.push_back(square_facing_y({0, 0, 0}, 10, 0.5f));
  return s;
}

TEST_P(CutOuts, ShadowsAreAsDarkAsTheirAlpha) {
  const auto share = [&](const ShapeDescription& shape) {
    return mean(shadow_scene(GetParam(), {shape})) / mean(shadow_scene(GetParam(), {}));
  };
  ShapeDescription above = cut_out(square_facing_y({0, 1, 0}, 2, 0), alpha), around = ball(alpha);
  around.world_from_object = translate({0, 3, 0});
  expect_share(share(above), 1 - 0.3);
  expect_share(share(around), 0.7 * 0.7);
  above.alpha = constant_spectrum(1);  // the twin: shadow rays stop at whatever is there
  expect_rejected(share(above), 1 - 0.3);
}

// The checkerboard of a quad that fills the picture: of its four fields two are holes.
TEST_P(CutOuts, TexturesCutWhereTheyAreDark) {
  SceneDescription s = sky_scene(GetParam(), {sheet(0, 1)});
  s.camera.fov = 2 * std::atan(0.5) * 180 / std::numbers::pi;
  s.film.width = s.film.height = 4;
  CheckerboardTexture board;
  board.mapping.u_scale = board.mapping.v_scale = 2;
  s.textures = {{"board", true, board, {}}};
  s.shapes[0].alpha.texture = 0;
  const auto holes = [&] {
    const Image image = render_film(s, 8).image();
    std::string rows;
    for (std::size_t i = 0; i < 16; ++i) rows += image.alpha[i] == 0 ? 'o' : image.alpha[i] == 1 ? '#' : '?';
    return rows;
  };
  // u to the right, v up: the field of 0 and 0, lower left, is opaque.
  const std::string expected = "oo##oo####oo##oo";
  EXPECT_EQ(holes(), expected);
  s.shapes[0].world_from_object = scale({1, -1, 1});  // the twin
  EXPECT_NE(holes(), expected);
}

// A cut-out that is said to have fog around it: whoever passes it is in the fog as before.
TEST_P(CutOuts, BoundNoMedia) {
  ShapeDescription in_fog = sheet(0, 0.5f);
  in_fog.outside = "fog";
  SceneDescription s = sky_scene(GetParam(), {box_shape({-9, -9, -9}, {9, 9, 9}, "fog"), in_fog});
  s.media = {homogeneous_medium("fog", 0.1f, 0)};
  const double expected = 0.5 * std::exp(-0.1 * 13);
  const auto off = [&] { return std::abs(mean(s) - expected); };
  EXPECT_LT(off(), 4 * standard_error(expected) + 2e-3);  // the rays at the corners go further through the fog
  in_fog.alpha = constant_spectrum(1);                    // the twin: a boundary in its place
  in_fog.material = InterfaceMaterial{};
  s.shapes.push_back(in_fog);
  EXPECT_GT(off(), 8 * standard_error(expected) + 2e-3);
}

// A lamp whose alpha is the number 0 lights the floor as if it was whole, and the camera sees through it.
TEST_P(CutOuts, LampsWithoutAnySurfaceShineUnseen) {
  ShapeDescription lamp = cut_out(sphere_shape({0, 3, 0}, 0.5, ""), 0);
  lamp.light = AreaLight{constant_spectrum(1), false, 0};
  SceneDescription lit = shadow_scene(GetParam(), {lamp});
  lit.lights.clear();
  lit.integrator.max_depth = 1;
  const double diffuse = 0.5 * 0.25 / 9;  // rho L (r / d)^2, seen through a narrow cone of rays
  EXPECT_NEAR(mean(lit), diffuse, 2e-2 * diffuse);
  lit.shapes[1].material = ConductorMaterial{constant_spectrum(0.2f), constant_spectrum(3), 0.3f};
  const double rough = mean(lit);
  lit.shapes[0].alpha = constant_spectrum(1);  // the whole lamp
  const double whole = mean(lit);
  EXPECT_NEAR(rough, whole, 2e-2 * whole);
  lit.shapes[0].alpha = constant_spectrum(0.9f);  // the twin: a tenth of its surface is missing
  EXPECT_GT(std::abs(mean(lit) - whole), 5e-2 * whole);
  lamp.world_from_object = Transform();
  EXPECT_EQ(mean(sky_scene(GetParam(), {lamp})), 1);
}

TEST_P(CutOuts, ARayMeetsTheSameWheneverItIsAsked) {
  SceneDescription s = sky_scene(GetParam(), {ball(alpha), sheet(1, 0.5f)});
  s.film.width = s.film.height = 48;
  EXPECT_EQ(render_film(s, 2, 1).image().pixels, render_film(s, 2, 2).image().pixels);
}

INSTANTIATE_TEST_SUITE_P(Integrators, CutOuts, testing::Values("classic", "reference", "volpath"),
                         [](const auto& test) { return std::string(test.param); });

TEST(CutOut, ThatHoldsAMediumOrAbsorbsIsAnError) {
  const auto message = [](const ShapeDescription& shape) {
    SceneDescription s = sky_scene("classic", {shape});
    s.media = {homogeneous_medium("fog", 1, 0)};
    std::vector<Diagnostic> warnings;
    try {
      compile(s, 1, warnings);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(ball(alpha)), "");
  ShapeDescription lamp = ball(alpha), cloud = ball(alpha), body = ball(alpha);
  lamp.light = AreaLight{constant_spectrum(1)};
  cloud.inside = "fog";
  BlinnPhongMaterial glass;
  glass.refraction = glass.absorption = constant_spectrum(1);
  body.material = glass;
  EXPECT_EQ(message(lamp), "");
  EXPECT_NE(message(cloud).find("has a medium inside must be 1"), std::string::npos) << message(cloud);
  EXPECT_NE(message(body).find("absorbs must be 1"), std::string::npos) << message(body);
}

}  // namespace
}  // namespace brume

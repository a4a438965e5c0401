// volpath against numbers of transport theory: the cases that transport_test.cpp has for the reference, at a standard
// error of 0.1 %, and cases of H functions, Lambertian light and fluence by both. Sources: adding-doubling (H. C. van
// de Hulst, Multiple Light Scattering, 1980, and its method run to more digits); S. Chandrasekhar, Radiative Transfer,
// 1950.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lanes/instruction_set.h"
#include "render/estimates.h"

namespace brume {
namespace {

constexpr double pi = std::numbers::pi;
constexpr float wide = 2e4f;

// What the camera below a slab of thickness b sees along +z: its reflectance and its transmittance.
struct Case {
  const char* name;
  const char* phase;
  std::vector<float> phase_parameters;
  float albedo, thickness;
  double reflectance, transmittance, rounding;  // transmittance below 0: a half-space
  double quick_error = 1e-3;                    // relative, of the short form; more where paths are long
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
std::string case_name(const ::testing::TestParamInfo<Case>& test) { return test.param.name; }

// The slab from z = 0 up, in the dark.
SceneDescription dark_slab(const Case& c, const std::string& integrator) {
  SceneDescription s = needle_scene({0, 0, -1});
  s.integrator.name = integrator;
  s.integrator.max_depth = 100000;
  for (const char* letter = c.name; *letter; ++letter)
    s.sampler.seed = s.sampler.seed * 31 + static_cast<std::uint32_t>(*letter);
  MediumDescription medium = homogeneous_medium("slab", 1 - c.albedo, c.albedo);
  set_phase(medium, c.phase, c.phase_parameters);
  s.media = {medium};
  s.shapes = {box_shape({-wide, -wide, 0}, {wide, wide, c.thickness}, "slab")};
  return s;
}

// The same, lit by radiance 1 from the half-space of the camera or from the other one: by reciprocity a view along the
// normal shows reflectance and transmittance for normal incidence.
SceneDescription lit_slab(const Case& c, const std::string& integrator, bool from_camera_side) {
  SceneDescription s = dark_slab(c, integrator);
  s.shapes.push_back(square_facing_z({0, 0, from_camera_side ? c.thickness + 2.0 : -2.0}, wide, 0));
  s.lights = {sky(1)};
  return s;
}

void expect_case(const Case& c, double relative_error) {
  expect_estimate(lit_slab(c, "volpath", true), c.reflectance, c.rounding, relative_error);
  if (c.transmittance >= 0) expect_estimate(lit_slab(c, "volpath", false), c.transmittance, c.rounding, relative_error);
}

class VolpathSlabs : public ::testing::TestWithParam<Case> {};
TEST_P(VolpathSlabs, ReflectAndTransmitAsTheTablesSay) { expect_case(GetParam(), GetParam().quick_error); }
class NightlyVolpathSlabs : public ::testing::TestWithParam<Case> {};
TEST_P(NightlyVolpathSlabs, ReflectAndTransmitAsTheTablesSay) { expect_case(GetParam(), 2e-4); }

const auto cases = ::testing::Values(
    Case{"HG_075_albedo_09_b_2", "henyey_greenstein", {0.75f}, 0.9f, 2, 0.097395, 0.660958, 5e-7, 2e-3},
    Case{"isotropic_conservative_b_1", "isotropic", {}, 1, 1, 0.341329, 0.658671, 5e-7},
    Case{"isotropic_albedo_09_b_1", "isotropic", {}, 0.9f, 1, 0.267410, 0.591625, 5e-7},
    Case{"HG_085_conservative_b_16", "henyey_greenstein", {0.85f}, 1, 16, 0.55721, 0.44279, 5e-6, 2e-3},
    Case{"HG_085_albedo_0999_b_8", "henyey_greenstein", {0.85f}, 0.999f, 8, 0.352121, 0.632507, 5e-7, 2e-3},
    Case{"Rayleigh_conservative_b_1", "rayleigh", {}, 1, 1, 0.340471, 0.659529, 5e-7},
    Case{"half_space_05", "isotropic", {}, 0.5f, 40, 0.115226, -1, 5e-7},
    Case{"half_space_09", "isotropic", {}, 0.9f, 40, 0.414947, -1, 5e-7},
    Case{"half_space_099", "isotropic", {}, 0.99f, 100, 0.752721, -1, 5e-7},
    Case{"half_space_0999", "isotropic", {}, 0.999f, 300, 0.912845, -1, 5e-7, 2e-3},
    Case{"half_space_HG_075_099", "henyey_greenstein", {0.75f}, 0.99f, 200, 0.559170, -1, 5e-7, 2e-3},
    Case{"half_space_HG_085_0999", "henyey_greenstein", {0.85f}, 0.999f, 1000, 0.78730, -1, 5e-6, 4e-3});
INSTANTIATE_TEST_SUITE_P(Cases, VolpathSlabs, cases, case_name);
INSTANTIATE_TEST_SUITE_P(NightlyCases, NightlyVolpathSlabs, cases, case_name);

// Twins: an anisotropy that is 10 % off, and an albedo that is 0.01 too high.
TEST(VolpathSlabTwins, AreRejected) {
  expect_rejected(lit_slab({"", "henyey_greenstein", {0.675f}, 0.9f, 2, 0, 0, 0}, "volpath", true), 0.097395);
  expect_rejected(lit_slab({"", "isotropic", {}, 0.91f, 1, 0, 0, 0}, "volpath", true), 0.267410);
}

// The same slab on every instruction set, as a homogeneous medium and as a grid of ones.
TEST(VolpathInstructionSets, ReflectAsTheTableSays) {
  const Case c{"", "henyey_greenstein", {0.75f}, 0.9f, 2, 0.097395, 0.660958, 5e-7};
  for (const InstructionSet& set : available_instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set.name));
    expect_estimate(lit_slab(c, "volpath", true), c.reflectance, c.rounding, 2e-3);
    SceneDescription s = lit_slab(c, "volpath", false);
    s.media[0].kind = UniformGridMedium{
        {4, 5, 9}, {-wide, -wide, 0}, {wide, wide, c.thickness}, std::vector<float>(std::size_t{4} * 5 * 9, 1)};
    s.media[0].linear_interpolation = false;
    s.shapes[0] = free_volume("slab");
    expect_estimate(s, c.transmittance, c.rounding, 2e-3);
  }
  use_instruction_set("");
}

class PathTracers : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Both, PathTracers, ::testing::Values("reference", "volpath"),
                         [](const auto& test) { return std::string(test.param); });
class NightlyPathTracers : public PathTracers {};
INSTANTIATE_TEST_SUITE_P(NightlyBoth, NightlyPathTracers, ::testing::Values("reference", "volpath"),
                         [](const auto& test) { return std::string(test.param); });

// A half-space under light of perpendicular irradiance 1 along the normal sends back w H(1)^2 / (8 pi) along it.
// Chandrasekhar, III. A slab of thickness b without absorption sends H(1)^2 / (4 (b + 1.42089)) / pi less: van de
// Hulst, section 5.2.
void expect_h_function(const char* integrator, float albedo, float thickness, double h, double relative_error) {
  SceneDescription s = dark_slab({"H", "isotropic", {}, albedo, thickness, 0, 0, 0}, integrator);
  s.lights = {distant_light({0, 0, -1}, 1)};
  const double less = albedo == 1 ? 0.25 / (static_cast<double>(thickness) + 1.42089) : 0;
  expect_estimate(s, (static_cast<double>(albedo) / 8 - less) * h * h / pi, 1e-7, relative_error);
}

TEST_P(PathTracers, HFunction) {
  expect_h_function(GetParam(), 0.9f, 40, 1.850099, 5e-3);
  expect_h_function(GetParam(), 0.99f, 100, 2.472793, 5e-3);
  expect_h_function(GetParam(), 1, 30, 2.907811, 5e-3);
}
TEST_P(NightlyPathTracers, HFunction) {
  expect_h_function(GetParam(), 0.9f, 40, 1.850099, 2e-4);
  expect_h_function(GetParam(), 0.99f, 100, 2.472793, 2e-4);
  expect_h_function(GetParam(), 1, 50, 2.907811, 2e-4);
}

// Transmittance for Lambertian light: 2 mu T(mu) over mu in [0, 1], by Gauss-Legendre quadrature.
Estimate lambert_lit(const char* integrator, const Case& c, bool reflectance, int samples) {
  constexpr double node[] = {0.03376524289842, 0.16939530676687, 0.38069040695840,
                             0.61930959304160, 0.83060469323313, 0.96623475710158};
  constexpr double weight[] = {0.08566224618959, 0.18038078652407, 0.23395696728635,
                               0.23395696728635, 0.18038078652407, 0.08566224618959};
  double mean = 0, variance = 0;
  for (int i = 0; i < 6; ++i) {
    SceneDescription s = lit_slab(c, integrator, reflectance);
    s.camera.world_from_camera = s.camera.world_from_camera * rotate(std::acos(node[i]) * 180 / pi, {0, 1, 0});
    s.sampler.seed += static_cast<std::uint32_t>(i);
    const Estimate e = estimate(s, samples);
    const double share = 2 * node[i] * weight[i];
    mean += share * e.mean;
    variance += share * share * e.standard_error * e.standard_error;
  }
  return {mean, std::sqrt(variance)};
}

void expect_lambert_lit(const char* integrator, const Case& c, int samples, double relative_error) {
  for (const bool reflectance : {false, true}) {
    const double expected = reflectance ? c.reflectance : c.transmittance;
    if (expected < 0) continue;
    const Estimate e = lambert_lit(integrator, c, reflectance, samples);
    std::printf("mean %.6f, standard error %.6f, expected %.6f, z %+.2f\n", e.mean, e.standard_error, expected,
                (e.mean - expected) / e.standard_error);
    // Six nodes are 2e-5 off.
    EXPECT_LE(std::abs(e.mean - expected), 4 * e.standard_error + c.rounding + 2e-5);
    EXPECT_LE(e.standard_error, relative_error * expected);
  }
}

const Case thin_lambert{"thin", "isotropic", {}, 1, 1, 0.446594, 0.553406, 5e-7};
const Case thick_lambert{"thick", "henyey_greenstein", {0.85f}, 1, 32, -1, 0.21409, 5e-6};

TEST_P(PathTracers, LambertianLight) { expect_lambert_lit(GetParam(), thin_lambert, 60000, 3e-3); }
TEST_P(NightlyPathTracers, LambertianLight) {
  expect_lambert_lit(GetParam(), thin_lambert, 20000000, 2e-4);
  expect_lambert_lit(GetParam(), thick_lambert, 20000000, 2e-4);
}

// The fluence of an isotropic point source in an infinite medium, integrated over a shell: by reciprocity what its
// place sees, in any direction, of a shell that emits 1 per unit of length. A hundred mean free paths are as good as
// infinitely many.
void expect_shell_fluence(const char* integrator, float albedo, double from, double to, double expected,
                          double relative_error) {
  SceneDescription s = needle_scene();
  s.integrator.name = integrator;
  s.integrator.max_depth = 100000;
  s.media = {homogeneous_medium("dark", 1 - albedo, albedo), homogeneous_medium("shell", 1 - albedo, albedo)};
  s.media[1].emission = constant_spectrum(1 / (1 - albedo));
  s.shapes = {sphere_shape({0, 0, 0}, 100, "dark"), sphere_shape({0, 0, 0}, to, "shell", "dark")};
  if (from > 0) s.shapes.push_back(sphere_shape({0, 0, 0}, from, "dark", "shell"));
  expect_estimate(s, expected, 5e-7, relative_error);
}

TEST_P(PathTracers, FluenceOfAPointSource) {
  expect_shell_fluence(GetParam(), 0.9f, 0, 0.5, 0.638799, 1e-2);
  expect_shell_fluence(GetParam(), 0.9f, 1.5, 2.5, 1.852911, 1e-2);
  expect_shell_fluence(GetParam(), 0.99f, 2.5, 4, 8.194095, 2e-2);
}
TEST_P(NightlyPathTracers, FluenceOfAPointSource) {
  struct Shell {
    double from, to, fluence_09, fluence_099;
  };
  for (const Shell& shell :
       {Shell{0, 0.5, 0.638799, 0.711019}, Shell{0.5, 1.5, 1.769411, 2.752264}, Shell{1.5, 2.5, 1.852911, 4.251450},
        Shell{2.5, 4, 2.263169, 8.194095}, Shell{4, 6, 1.852677, 12.386502}, Shell{6, 10, 1.324440, 23.547192}}) {
    expect_shell_fluence(GetParam(), 0.9f, shell.from, shell.to, shell.fluence_09, 1e-3);
    expect_shell_fluence(GetParam(), 0.99f, shell.from, shell.to, shell.fluence_099, 1e-3);
  }
}

// Single scattering along a ray (see closed_forms_test.cpp).
SceneDescription single_scattering(float sigma_s, float sigma_a, float g) {
  SceneDescription s = needle_scene();
  s.integrator.name = "volpath";
  s.media = {homogeneous_medium("fog", sigma_a, sigma_s)};
  if (g != 0) set_phase(s.media[0], "henyey_greenstein", {g});
  s.camera.medium = "fog";
  s.shapes = {square_facing_z({0, 0, 4}, 1, 0)};
  s.lights = {point_light({1, 0, 2}, 1)};
  return s;
}

void expect_single_scattering(double relative_error) {
  expect_estimate(single_scattering(0.5f, 0, 0), 0.01857249, 5e-9, relative_error);
  expect_estimate(single_scattering(0.5f, 0, 0.6f), 0.02007662, 5e-9, relative_error);
  expect_estimate(single_scattering(0.5f, 0.5f, 0), 0.00446067, 5e-9, relative_error);
}
TEST(VolpathSingleScattering, MatchesQuadrature) {
  expect_single_scattering(1e-3);
  // Its twin scatters backwards.
  expect_rejected(single_scattering(0.5f, 0, -0.6f), 0.02007662);
}
TEST(NightlyVolpathSingleScattering, MatchesQuadrature) { expect_single_scattering(2e-4); }

// A lamp far away and almost ahead, whose light is even along the ray: catches an angle that is the difference of two
// nearly equal ones.
TEST(VolpathSingleScattering, OfAFarLampAhead) {
  SceneDescription s = needle_scene();
  s.integrator.name = "volpath";
  s.media = {homogeneous_medium("fog", 0, 0.01f)};
  s.shapes = {box_shape({-1, -1, 1}, {1, 1, 2}, "fog")};
  s.lights = {point_light({0.3, 0, 1000}, 1e6f)};
  // 0.01 (1/(4 pi)) exp(-0.01) (1000 / 998.5)^2
  expect_estimate(s, 0.01 / (4 * pi) * std::exp(-0.01) * 1e6 / (999.0 * 998.0), 4e-9, 1e-4);
}

ShapeDescription lamp(Vector3 centre, double radius, float reflectance) {
  ShapeDescription s = sphere_shape(centre, radius, "");
  s.material = DiffuseMaterial{constant_spectrum(reflectance)};
  s.light = AreaLight{constant_spectrum(10), false, 0};
  return s;
}

// Catches shadow rays from a sphere to itself: it is convex, and lights no point of its own.
TEST_P(PathTracers, ASphereDoesNotLightItself) {
  SceneDescription s = needle_scene({0.1, 0.2, -4});
  s.integrator.name = GetParam();
  s.film.width = s.film.height = 32;
  s.camera.fov = 5;
  for (const double radius : {0.4, 1.7}) {
    s.shapes = {lamp({0.1, 0.2, 0}, radius, 0.5f)};
    for (const float v : render_film(s, 4, 2).image().pixels) ASSERT_NEAR(v, 10, 1e-4);
  }
}

// Catches shadow rays that end on the lamp itself where the camera is further from the floor than the lamp: the floor
// right under a sphere of radius r at height h has the irradiance pi L (r / h)^2, seen from anywhere.
TEST_P(PathTracers, ALampOverAFloorSeenAtASlant) {
  SceneDescription s = needle_scene();
  s.integrator.name = GetParam();
  s.camera.world_from_camera = inverse(look_at({0.1, 0.2, -4}, {1.2, -1, -0.5}, {0, 1, 0}));
  s.shapes = {square_facing_y({0, -1, 0}, 6, 0.6f), lamp({1.2, 1, -0.5}, 0.3, 0.3f)};
  expect_estimate(s, 0.6 * 10 * 0.09 / 4, 1e-6, 1e-3);
}

// The fraction of the emission of an absorbing sphere that escapes (see transport_test.cpp), at one place of its disk.
TEST(VolpathEmission, OfAnAbsorbingSphere) {
  for (const double radius : {1.0, 5.0}) {
    SceneDescription s = needle_scene({0.6 * radius, 0, -20});
    s.integrator.name = "volpath";
    s.media = {homogeneous_medium("fire", 1, 0)};
    s.media[0].emission = constant_spectrum(1);
    s.shapes = {sphere_shape({0, 0, 0}, radius, "fire")};
    expect_estimate(s, 1 - std::exp(-1.6 * radius), 1e-6, 1e-3);
  }
}

// Transmittance of absorbers: of the view, by chance, and of shadow rays, exactly.
TEST(VolpathAbsorption, IsBeersAndLamberts) {
  SceneDescription s = needle_scene({0.1, 0.2, -5});
  s.integrator.name = "volpath";
  s.lights = {sky(1)};
  s.media = {homogeneous_medium("absorber", 1, 0)};
  s.shapes = {box_shape({-1, -1, 0}, {1, 1, 1}, "absorber")};
  expect_estimate(s, 0.36787944, 5e-9, 1e-3);
  s.media = {grid_medium("absorber", {-1, -1, 0}, {1, 1, 1}, {3, 5, 7}, std::vector<float>(3 * 5 * 7, 1), 1, 0)};
  s.media[0].linear_interpolation = false;
  expect_estimate(s, 0.36787944, 5e-9, 1e-3);
  expect_rejected(s, std::exp(-0.98));

  SceneDescription floor = needle_scene();
  floor.integrator.name = "volpath";
  floor.camera.world_from_camera = translate({0, 0.5, 0}) * rotate(90, {1, 0, 0});
  floor.media = {homogeneous_medium("absorber", 0.5f, 0)};
  floor.shapes = {square_facing_y({0, 0, 0}, 10, 0.5f), box_shape({-1, 1, -1}, {1, 3, 1}, "absorber")};
  floor.lights = {distant_light({0, 1, 0}, 2)};
  EXPECT_NEAR(radiance(floor), 0.36787944 / pi, 1e-5);
}

// Uniform surroundings and no absorption: every sample is 1, to rounding, of media in any company.
TEST(VolpathFurnace, EveryPixelIsOne) {
  SceneDescription s = needle_scene({0, 0, -3});
  s.camera.fov = 60;
  s.film.width = s.film.height = 32;
  s.integrator.name = "volpath";
  s.integrator.max_depth = 100000;
  std::vector<float> density(6 * 5 * 4);
  for (std::size_t i = 0; i < density.size(); ++i) density[i] = static_cast<float>((i * 7) % 5) / 4;
  s.media = {homogeneous_medium("ball", 0, 2), grid_medium("grid", {-1, -1, -1}, {1, 1, 1}, {6, 5, 4}, density, 0, 3)};
  set_phase(s.media[1], "henyey_greenstein", {0.7f});
  s.shapes = {sphere_shape({0.3, 0, 0}, 0.8, "ball"), free_volume("grid")};
  s.lights = {sky(1)};
  for (const float v : render_film(s, 16, 2).image().pixels) ASSERT_NEAR(v, 1, 1e-5);
  s.media[1].sigma_a = constant_spectrum(0.003f);
  double mean = 0;
  for (const float v : render_film(s, 16, 2).image().pixels) mean += static_cast<double>(v) / (3 * 32 * 32);
  EXPECT_LT(mean, 1 - 1e-4);
  // Chromatic extinction: one in the mean.
  s.media[1].sigma_a = {};
  s.media[1].sigma_s = Spectrum{{1, 2, 4}};
  s.shapes.push_back(square_facing_y({0, -1.5, 0}, 5, 1));
  s.camera.fov = 1e-5;
  expect_estimate(s, 1, 0, 1e-3);
}

}  // namespace
}  // namespace brume

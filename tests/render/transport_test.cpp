// Multiple scattering against numbers of transport theory: slabs, half-spaces, a point source in an infinite medium, an
// emitting sphere, the white furnace. Slabs and half-spaces are very wide boxes; by reciprocity a camera that looks
// along the normal at a slab lit by radiance 1 from one half-space alone sees its reflectance or its transmittance for
// normal incidence. The lit half-space is made of a sky behind which a black square covers the other half. Sources of
// the numbers: adding-doubling (H. C. van de Hulst, Multiple Light Scattering, 1980, and its method run to more
// digits); S. Chandrasekhar, Radiative Transfer, 1950 (half-spaces).
#include <gtest/gtest.h>

#include <cmath>

#include "compile/compile.h"
#include "render/backend.h"
#include "render/estimates.h"

namespace brume {
namespace {

struct Slab {
  const char* name;
  const char* phase;
  std::vector<float> phase_parameters;
  float albedo, thickness;
  double reflectance, transmittance, rounding;  // transmittance below 0: a half-space
  double quick_error = 3e-3;                    // relative, of the short form; more where paths are long
};

void PrintTo(const Slab& slab, std::ostream* out) { *out << slab.name; }

const float wide = 2e4f;

// The camera below, looking up along +z, at a slab from z = 0 to its thickness; lit from above or from below.
SceneDescription slab_scene(const Slab& slab, bool lit_from_camera_side) {
  SceneDescription s = needle_scene({0, 0, -1});
  s.integrator.name = "reference";
  s.integrator.max_depth = 100000;
  for (const char* c = slab.name; *c; ++c) s.sampler.seed = s.sampler.seed * 31 + static_cast<std::uint32_t>(*c);
  MediumDescription medium = homogeneous_medium("slab", 1 - slab.albedo, slab.albedo);
  set_phase(medium, slab.phase, slab.phase_parameters);
  s.media = {medium};
  s.shapes = {box_shape({-wide, -wide, 0}, {wide, wide, slab.thickness}, "slab"),
              square_facing_z({0, 0, lit_from_camera_side ? slab.thickness + 2.0 : -2.0}, wide, 0)};
  s.lights = {sky(1)};
  return s;
}

void expect_table(const Slab& slab, double relative_error) {
  expect_estimate(slab_scene(slab, true), slab.reflectance, slab.rounding, relative_error);
  if (slab.transmittance >= 0)
    expect_estimate(slab_scene(slab, false), slab.transmittance, slab.rounding, relative_error);
}

class Slabs : public ::testing::TestWithParam<Slab> {};
TEST_P(Slabs, ReflectAndTransmitAsTheTablesSay) { expect_table(GetParam(), GetParam().quick_error); }
class NightlySlabs : public Slabs {};
TEST_P(NightlySlabs, ReflectAndTransmitAsTheTablesSay) { expect_table(GetParam(), 2e-4); }

std::string slab_name(const ::testing::TestParamInfo<Slab>& test) { return test.param.name; }

const auto slabs = ::testing::Values(
    Slab{"HG_075_albedo_09_b_2", "henyey_greenstein", {0.75f}, 0.9f, 2, 0.097395, 0.660958, 5e-7},
    Slab{"isotropic_conservative_b_1", "isotropic", {}, 1, 1, 0.341329, 0.658671, 5e-7},
    Slab{"isotropic_albedo_09_b_1", "isotropic", {}, 0.9f, 1, 0.267410, 0.591625, 5e-7},
    Slab{"HG_085_conservative_b_16", "henyey_greenstein", {0.85f}, 1, 16, 0.55721, 0.44279, 5e-6, 1e-2},
    Slab{"HG_085_albedo_0999_b_8", "henyey_greenstein", {0.85f}, 0.999f, 8, 0.352121, 0.632507, 5e-7, 1e-2},
    Slab{"Rayleigh_conservative_b_1", "rayleigh", {}, 1, 1, 0.340471, 0.659529, 5e-7});
INSTANTIATE_TEST_SUITE_P(Transport, Slabs, slabs, slab_name);
INSTANTIATE_TEST_SUITE_P(NightlyTransport, NightlySlabs, slabs, slab_name);

// Plane albedo 1 - H(1) sqrt(1 - w) of half-spaces; 60 mean free paths are as good as infinitely many.
const auto half_spaces =
    ::testing::Values(Slab{"isotropic_05", "isotropic", {}, 0.5f, 40, 0.115226, -1, 5e-7},
                      Slab{"isotropic_09", "isotropic", {}, 0.9f, 40, 0.414947, -1, 5e-7},
                      Slab{"isotropic_099", "isotropic", {}, 0.99f, 100, 0.752721, -1, 5e-7, 1e-2},
                      Slab{"HG_075_099", "henyey_greenstein", {0.75f}, 0.99f, 200, 0.559170, -1, 5e-7, 1e-2});
INSTANTIATE_TEST_SUITE_P(HalfSpaces, Slabs, half_spaces, slab_name);
INSTANTIATE_TEST_SUITE_P(NightlyHalfSpaces, NightlySlabs, half_spaces, slab_name);

// Catches an anisotropy that is 10 % off, which a slab of optical depth 2 shows.
TEST(SlabTwins, AnotherAnisotropyIsRejected) {
  Slab slab{"", "henyey_greenstein", {0.675f}, 0.9f, 2, 0, 0, 0};
  expect_rejected(slab_scene(slab, true), 0.097395);
}

// Catches an albedo that is 0.01 too high.
TEST(SlabTwins, AnotherAlbedoIsRejected) {
  Slab slab{"", "isotropic", {}, 0.91f, 1, 0, 0, 0};
  expect_rejected(slab_scene(slab, true), 0.267410);
}

// Uniform surroundings of radiance 1 and no absorption: every pixel is 1, whatever stands there. The variance is that
// of roulette and of transmittance estimates alone.
TEST(WhiteFurnace, EveryPixelIsOne) {
  SceneDescription s = needle_scene({0, 0, -3});
  s.integrator.name = "reference";
  s.integrator.max_depth = 100000;
  std::vector<float> density(6 * 5 * 4);
  for (std::size_t i = 0; i < density.size(); ++i) density[i] = static_cast<float>((i * 7) % 5) / 4;
  s.media = {homogeneous_medium("ball", 0, 2), grid_medium("grid", {-1, -1, -1}, {1, 1, 1}, {6, 5, 4}, density, 0, 3)};
  set_phase(s.media[1], "henyey_greenstein", {0.7f});
  s.shapes = {sphere_shape({0.3, 0, 0}, 0.8, "ball"), free_volume("grid"), square_facing_y({0, -1.5, 0}, 5, 1)};
  s.lights = {sky(1)};
  expect_estimate(s, 1, 0, 1e-3);
  // Its twin, which absorbs a hundredth of what it scatters.
  s.media[1].sigma_a = constant_spectrum(0.03f);
  expect_rejected(s, 1);
}

// Catches a majorant that does not bound the density: the renderer counts it. Every storage of a grid is bounded.
TEST(Majorants, ViolationsAreCountedAndThereAreNone) {
  std::vector<float> density(9 * 9 * 9);
  for (std::size_t i = 0; i < density.size(); ++i) density[i] = static_cast<float>((i * 7919) % 1009) / 1008 * 3.7f;
  for (const int bits : {8, 16, 32}) {
    SceneDescription s = needle_scene({0, 0, -3});
    s.camera.fov = 40;
    s.film.width = s.film.height = 64;
    s.integrator.name = "reference";
    s.media = {grid_medium("grid", {-1, -1, -1}, {1, 1, 1}, {9, 9, 9}, density, 0.1f, 4)};
    s.media[0].storage_bits = bits;
    s.shapes = {free_volume("grid")};
    s.lights = {sky(1)};
    std::vector<Diagnostic> warnings;
    CompiledScene compiled = compile(s, 1, warnings);
    const auto violations = [&] {
      const auto backend = make_cpu_backend();
      backend->prepare(compiled);
      Film film(compiled.width, compiled.height);
      backend->render(0, 16, 2, film, [](double) { return true; });
      return backend->majorant_violations();
    };
    EXPECT_EQ(violations(), 0) << bits;
    compiled.grids[0].max_density *= 0.9f;
    EXPECT_GT(violations(), 0) << bits;
  }
}

// The fraction of uniform isotropic emission in a purely absorbing sphere of radius x mean free paths that escapes:
// 3 / (8 x^3) (2 x^2 - 1 + (1 + 2 x) e^(-2x)). A distant view of the sphere sees Le (1 - e^-chord); the flux through
// its disk over the flux emitted is 3 / (4 x) times the mean of that over the disk, and with h the half chord that mean
// is the integral of 2 h / x^2 (1 - e^-2h) over h from 0 to x: five-point Gauss-Legendre gives it to 1e-6.
TEST(AbsorbingSphere, EscapeFraction) {
  constexpr double node[] = {0.04691007703067, 0.23076534494716, 0.5, 0.76923465505284, 0.95308992296933};
  constexpr double weight[] = {0.11846344252809, 0.23931433524968, 0.28444444444444, 0.23931433524968,
                               0.11846344252809};
  for (const auto& [x, expected] : {std::pair{1.0, 0.5272522}, std::pair{5.0, 0.1470015}})
    for (const std::string integrator : {"classic", "reference"}) {
      double fraction = 0, variance = 0;
      for (int i = 0; i < 5; ++i) {
        const double h = x * node[i], share = 1.5 * weight[i] * h / (x * x);
        SceneDescription s = needle_scene({std::sqrt(x * x - h * h), 0, -20});
        s.integrator.name = integrator;
        s.media = {homogeneous_medium("fire", 1, 0)};
        s.media[0].emission = constant_spectrum(1);
        s.shapes = {sphere_shape({0, 0, 0}, x, "fire")};
        const Estimate e = estimate(s, integrator == "classic" ? 1 : 100000);
        fraction += share * e.mean;
        variance += share * share * e.standard_error * e.standard_error;
      }
      // Five nodes are 1e-4 off at x = 5.
      EXPECT_NEAR(fraction, expected, 4 * std::sqrt(variance) + (x < 2 ? 1e-5 : 1e-4)) << integrator << " " << x;
    }
}

// Single scattering along a ray, as closed_forms_test has it by marching; here one collision and one shadow ray a
// sample.
TEST(SingleScatteringReference, MatchesQuadrature) {
  SceneDescription s = needle_scene();
  s.integrator.name = "reference";
  s.media = {homogeneous_medium("fog", 0, 0.5f)};
  s.camera.medium = "fog";
  s.shapes = {square_facing_z({0, 0, 4}, 1, 0)};
  s.lights = {point_light({1, 0, 2}, 1)};
  expect_estimate(s, 0.01857249, 5e-9, 1e-3);
  set_phase(s.media[0], "henyey_greenstein", {0.6f});
  expect_estimate(s, 0.02007662, 5e-9, 1e-3);
  set_phase(s.media[0], "henyey_greenstein", {-0.6f});
  expect_rejected(s, 0.02007662);
}

// A scene of everything at depth 1, where both integrators estimate the same: their means agree. (Emission apart:
// classic does not let emitting media light others.)
TEST(Integrators, ReferenceIsClassicAtDepthOne) {
  SceneDescription s = needle_scene({0.1, 0.2, -4});
  std::vector<float> density(5 * 6 * 7);
  for (std::size_t i = 0; i < density.size(); ++i) density[i] = static_cast<float>((i * 37) % 11) / 11;
  s.media = {homogeneous_medium("fog", 0.1f, 0.5f),
             grid_medium("smoke", {-1, -1, -1}, {1, 1, 1}, {5, 6, 7}, density, 0.3f, 1)};
  set_phase(s.media[1], "henyey_greenstein", {0.5f});
  s.shapes = {sphere_shape({0.5, 0, 0}, 0.9, "fog"), free_volume("smoke"), square_facing_z({0, 0, 3}, 2, 0.5f),
              square_facing_y({0, -1.5, 0}, 3, 0.7f)};
  s.lights = {sky(0.3f), distant_light({1, 2, -1}, 1), point_light({-2, 1, -2}, 3)};
  s.integrator.step = 0.01;
  s.integrator.placement = Placement::random;
  const Estimate classic = estimate(s, 10000);
  s.integrator.name = "reference";
  const Estimate reference = estimate(s, 400000);
  const double error = std::hypot(classic.standard_error, reference.standard_error);
  EXPECT_LT(error, 3e-3 * classic.mean);
  EXPECT_LE(std::abs(classic.mean - reference.mean), 4 * error);
  // Its twin, with a tenth of the sky's light missing.
  s.lights[0] = sky(0.27f);
  EXPECT_GT(std::abs(estimate(s, 400000).mean - classic.mean), 8 * error);
}

// One path serves all channels: each channel's mean is that of a grey scene with its coefficients.
TEST(ChromaticMedia, EachChannelIsTheGreySceneOfItsCoefficients) {
  std::vector<float> density(4 * 4 * 4);
  for (std::size_t i = 0; i < density.size(); ++i) density[i] = static_cast<float>((i * 5) % 7) / 6;
  const Spectrum sigma_s{{0.5f, 2.0f, 4.0f}}, sigma_a{{1.0f, 0.1f, 0.3f}};
  SceneDescription s = needle_scene({0.1, 0.2, -4});
  s.integrator.name = "reference";
  s.integrator.max_depth = 50;
  s.media = {grid_medium("grid", {-1, -1, -1}, {1, 1, 1}, {4, 4, 4}, density, 0, 0),
             homogeneous_medium("ball", 0.2f, 0.6f)};
  set_phase(s.media[0], "henyey_greenstein", {0.4f});
  s.shapes = {free_volume("grid"), sphere_shape({0.2, 0, 0}, 0.7, "ball")};
  s.lights = {sky(1), distant_light({1, 1, -1}, 1)};
  for (int c = 0; c < channel_count; ++c) {
    s.media[0].sigma_s = constant_spectrum(sigma_s[c]);
    s.media[0].sigma_a = constant_spectrum(sigma_a[c]);
    const Estimate grey = estimate(s, 100000);
    s.media[0].sigma_s = sigma_s;
    s.media[0].sigma_a = sigma_a;
    SceneDescription coloured = s;
    coloured.sampler.seed = 99;
    const Estimate colour = estimate(coloured, 100000, c);
    const double error = std::hypot(grey.standard_error, colour.standard_error);
    EXPECT_LE(std::abs(grey.mean - colour.mean), 4 * error) << "channel " << c;
    EXPECT_LT(error, 1e-2 * grey.mean);
    // The neighbour's coefficients would show.
    EXPECT_GT(std::abs(grey.mean - estimate(coloured, 100000, (c + 1) % channel_count).mean), 8 * error);
  }
}

}  // namespace
}  // namespace brume

// Media behind refracting boundaries: slabs and half-spaces of glass or water that scatter, against numbers of
// transport theory. As in transport_test.cpp a camera looks along the normal at a very wide box lit from one half-space
// by radiance 1, and by reciprocity sees reflectance or transmittance for normal incidence, Fresnel's reflection
// included. Sources: Giovanelli 1955 (isotropic, albedo 0.9), quoted by L. Wang, S. Jacques and L. Zheng, "MCML",
// Comput. Methods Programs Biomed. 47, 1995; the others by adding-doubling.
#include <gtest/gtest.h>

#include <cmath>

#include "render/estimates.h"
#include "render/path_tracers.h"

namespace brume {
namespace {

struct RefractiveSlab {
  const char* name;
  float eta;
  const char* phase;
  std::vector<float> phase_parameters;
  float albedo, thickness;
  double reflectance, transmittance, rounding;  // transmittance below 0: a half-space
};

const float wide = 2e4f;

SceneDescription slab_scene(const RefractiveSlab& slab, const char* integrator, bool lit_from_camera_side) {
  SceneDescription s = needle_scene({0, 0, -1});
  s.integrator.name = integrator;
  s.integrator.max_depth = 100000;
  s.sampler.seed = 5;
  MediumDescription medium = homogeneous_medium("slab", 1 - slab.albedo, slab.albedo);
  set_phase(medium, slab.phase, slab.phase_parameters);
  s.media = {medium};
  ShapeDescription box = box_shape({-wide, -wide, 0}, {wide, wide, slab.thickness}, "slab");
  box.material = DielectricMaterial{slab.eta};
  s.shapes = {box, square_facing_z({0, 0, lit_from_camera_side ? slab.thickness + 2.0 : -2.0}, wide, 0)};
  s.lights = {sky(1)};
  return s;
}

const RefractiveSlab isotropic_09{"isotropic_09", 1.5f, "isotropic", {}, 0.9f, 40, 0.2600, -1, 5e-5};
const RefractiveSlab isotropic_099{"isotropic_099", 1.5f, "isotropic", {}, 0.99f, 100, 0.6020, -1, 5e-5};
const RefractiveSlab forward_075{"HG_075_b_2", 1.4f, "henyey_greenstein", {0.75f}, 0.9f, 2, 0.1162, 0.5270, 5e-5};
const RefractiveSlab forward_085{"HG_085_b_10", 1.33f, "henyey_greenstein", {0.85f}, 0.99f, 10, 0.3159, 0.4133, 5e-5};

void expect_slab(const RefractiveSlab& slab, const char* integrator, double relative_error) {
  std::printf("%s\n", slab.name);
  expect_estimate(slab_scene(slab, integrator, true), slab.reflectance, slab.rounding, relative_error);
  if (slab.transmittance >= 0)
    expect_estimate(slab_scene(slab, integrator, false), slab.transmittance, slab.rounding, relative_error);
}

class Refraction : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(PathTracers, Refraction, path_tracers(), integrator_name);

TEST_P(Refraction, HalfSpaceReflectsAsGiovanelliSays) { expect_slab(isotropic_09, GetParam(), 5e-3); }
TEST_P(Refraction, SlabReflectsAndTransmitsAsTheTablesSay) { expect_slab(forward_075, GetParam(), 5e-3); }

// Catches a refractive index that is 0.1 off.
TEST_P(Refraction, AnotherIndexIsRejected) {
  RefractiveSlab slab = isotropic_09;
  slab.eta = 1.4f;
  const Estimate e = estimate(slab_scene(slab, GetParam(), true), 60000);
  EXPECT_GT(std::abs(e.mean - isotropic_09.reflectance), 8 * e.standard_error);
}

// Catches radiance that refraction does not squeeze: a camera within glass sees the sky n^2 times as bright.
TEST_P(Refraction, RadianceWithinGlassIsTheSquareOfItsIndexAsGreat) {
  SceneDescription s = needle_scene({0, 0, 0});
  s.integrator.name = GetParam();
  s.integrator.max_depth = 100;
  ShapeDescription ball = sphere_shape({0.1, 0.2, 0.3}, 2, "");
  ball.material = DielectricMaterial{1.5f};
  s.shapes = {ball};
  s.lights = {sky(1)};
  expect_estimate(s, 2.25, 0, 1e-3);
  expect_rejected(s, 1);
}

// All four cases at 0.1 %: random walks behind glass are long, and no shadow ray gets out.
class NightlyRefraction : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(PathTracers, NightlyRefraction, path_tracers(), integrator_name);

TEST_P(NightlyRefraction, HalfSpaceOfAlbedo09) { expect_slab(isotropic_09, GetParam(), 1e-3); }
TEST_P(NightlyRefraction, HalfSpaceOfAlbedo099) { expect_slab(isotropic_099, GetParam(), 1e-3); }
TEST_P(NightlyRefraction, SlabOfAnisotropy075) { expect_slab(forward_075, GetParam(), 1e-3); }
TEST_P(NightlyRefraction, SlabOfAnisotropy085) { expect_slab(forward_085, GetParam(), 1e-3); }

}  // namespace
}  // namespace brume

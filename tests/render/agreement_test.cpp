// reference = volpath on small scenes: by the z-scores of block means and of the means of whole pictures. What one of
// the two gets wrong of media, phase functions, surfaces, lights and their company shows here.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "image/compare.h"
#include "image/temporary_folder.h"
#include "render/agreement_scenes.h"
#include "sanitized.h"

namespace brume {
namespace {

Image picture(SceneDescription scene, const char* integrator, std::uint32_t seed, int samples) {
  scene.integrator.name = integrator;
  scene.sampler.seed = seed;
  const Film film = render_film(scene, samples, 2);
  EXPECT_EQ(film.invalid_samples(), 0);
  Image image = film.image();
  image.variance = film.variance();
  return image;
}

// The z-score of the difference of two pictures' means.
double mean_z(const Image& a, const Image& b, std::size_t channel) {
  double difference = 0, variance = 0;
  for (std::size_t i = channel; i < a.pixels.size(); i += 3) {
    difference += static_cast<double>(a.pixels[i] - b.pixels[i]);
    variance += static_cast<double>(a.variance[i] + b.variance[i]);
  }
  return variance > 0 ? difference / std::sqrt(variance) : 0;
}

// Seed 0 is what everyone renders with, and where hashes are most likely to coincide.
void expect_agreement(const AgreementScene& s, int samples) {
  const Image reference = picture(s.scene, "reference", 1, samples);
  const Image volpath = picture(s.scene, "volpath", 0, 4 * samples);
  const ImageComparison c = compare_images(reference, volpath);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const ChannelComparison& d = c.channels[channel];
    const double z = mean_z(reference, volpath, channel);
    std::printf("channel %zu: means %.6f and %.6f, z %+.2f; blocks z %+.2f +- %.2f of %d\n", channel, d.mean_a,
                d.mean_b, z, d.scores->mean, d.scores->deviation, d.scores->blocks);
    EXPECT_LE(std::abs(z), 4) << "channel " << channel;
    EXPECT_TRUE(agree(*d.scores)) << "channel " << channel;
  }
}

class Agreement : public ::testing::TestWithParam<AgreementScene> {
 protected:
  // The scene, and the picture of its image light written, where it has one.
  AgreementScene scene() const {
    AgreementScene s = GetParam();
    for (LightDescription& light : s.scene.lights)
      if (auto* image = std::get_if<InfiniteLight>(&light.kind); image && !image->filename.empty()) {
        image->filename = folder_.path() + "/" + image->filename.text;
        write_sky(image->filename);
      }
    return s;
  }

 private:
  TemporaryFolder folder_;
};
class NightlyAgreement : public Agreement {};

TEST_P(Agreement, ReferenceIsVolpath) { expect_agreement(scene(), 32); }
TEST_P(NightlyAgreement, ReferenceIsVolpath) { expect_agreement(scene(), 2048); }

std::string scene_name(const ::testing::TestParamInfo<AgreementScene>& test) { return test.param.name; }
INSTANTIATE_TEST_SUITE_P(Scenes, Agreement, ::testing::ValuesIn(agreement_scenes()), scene_name);
INSTANTIATE_TEST_SUITE_P(NightlyScenes, NightlyAgreement, ::testing::ValuesIn(agreement_scenes()), scene_name);

// Scenes with a fault in what volpath renders, 8 standard errors out.
template <class Plant>
void expect_fault_found(const std::string& name, Plant plant) {
  for (const AgreementScene& s : agreement_scenes()) {
    if (s.name != name) continue;
    AgreementScene faulty = s;
    plant(faulty.scene);
    const Image reference = picture(s.scene, "reference", 1, 48);
    const Image volpath = picture(faulty.scene, "volpath", 2, 192);
    double worst = 0;
    for (std::size_t channel = 0; channel < 3; ++channel)
      worst = std::max(worst, std::abs(mean_z(reference, volpath, channel)));
    EXPECT_GT(worst, 8) << name;
    return;
  }
  FAIL() << "no scene " << name;
}

TEST(AgreementTwins, FaultsAreFound) {
  expect_fault_found("grid_linear_16", [](SceneDescription& s) { s.media[0].sigma_a = 1.5f * s.media[0].sigma_a; });
  expect_fault_found("phase_henyey_greenstein", [](SceneDescription& s) { s.media[0].phase_parameters[0] = -0.8f; });
  expect_fault_found("three_media", [](SceneDescription& s) { s.shapes.pop_back(); });
  expect_fault_found("nested_boundaries", [](SceneDescription& s) { s.shapes[0].inside = "ball"; });
  expect_fault_found("chromatic_grid",
                     [](SceneDescription& s) { std::swap(s.media[0].sigma_s[0], s.media[0].sigma_s[1]); });
  expect_fault_found("emission", [](SceneDescription& s) { s.media[1].emission = 0.9f * s.media[1].emission; });
  expect_fault_found("fire", [](SceneDescription& s) { s.media[0].temperatures->scale = 1.1; });
  expect_fault_found("diffuse_surfaces", [](SceneDescription& s) { s.integrator.max_depth = 2; });
  expect_fault_found("textured_instances",
                     [](SceneDescription& s) { std::get<MixTexture>(s.textures[2].kind).amount = Spectrum{}; });
}

// The same volume told in two ways, both by volpath.
void expect_same(const SceneDescription& a, const SceneDescription& b) {
  const Image first = picture(a, "volpath", 1, 256), second = picture(b, "volpath", 2, 256);
  const ImageComparison c = compare_images(first, second);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    EXPECT_LE(std::abs(mean_z(first, second, channel)), 4);
    EXPECT_TRUE(agree(*c.channels[channel].scores));
  }
  SceneDescription faulty = b;
  for (MediumDescription& m : faulty.media) m.sigma_a = m.sigma_a + 0.05f * m.sigma_s;
  EXPECT_GT(std::abs(mean_z(first, picture(faulty, "volpath", 2, 256), 0)), 8);
}

SceneDescription scene_called(const std::string& name) {
  for (const AgreementScene& s : agreement_scenes())
    if (s.name == name) return s.scene;
  throw std::logic_error("no scene " + name);
}

// Seed 0 once made flights and scatterings draw the same numbers, since a hash of 0 was 0. Where light comes from one
// collision of low albedo, roulette then depends on where the collision is.
TEST(SeedZero, IsLikeAnyOther) {
  const SceneDescription scene = scene_called("grid_under_a_sun_alone");
  const int samples = sanitized ? 64 : 4096;
  const Image zero = picture(scene, "volpath", 0, samples), other = picture(scene, "volpath", 5, samples);
  std::printf("z %+.2f\n", mean_z(zero, other, 0));
  EXPECT_LE(std::abs(mean_z(zero, other, 0)), 4);
  if (sanitized) return;
  SceneDescription faulty = scene;
  faulty.media[0].sigma_s = 0.97f * faulty.media[0].sigma_s;
  EXPECT_GT(std::abs(mean_z(picture(faulty, "volpath", 0, samples), other, 0)), 8);
}

TEST(OneVolumeInTwoWays, AHomogeneousMediumIsAGridOfOnes) {
  const SceneDescription homogeneous = scene_called("homogeneous_box");
  SceneDescription grid = homogeneous;
  grid.media[0].kind =
      UniformGridMedium{{5, 6, 7}, {-1, -1, -1}, {1, 1, 1}, std::vector<float>(std::size_t{5} * 6 * 7, 1)};
  grid.media[0].linear_interpolation = false;
  expect_same(homogeneous, grid);
}

TEST(OneVolumeInTwoWays, AGridIsTwoOfHalfItsDensity) {
  const SceneDescription one = scene_called("grid_linear_16");
  SceneDescription two = one;
  MediumDescription& half = two.media[0];
  half.sigma_a = 0.5f * half.sigma_a;
  half.sigma_s = 0.5f * half.sigma_s;
  two.media.push_back(half);
  two.media[1].name = "other";
  two.shapes.push_back(free_volume("other"));
  expect_same(one, two);
  two.media.pop_back();
  two.shapes[1] = two.shapes[0];  // one medium twice
  expect_same(one, two);
}

TEST(OneVolumeInTwoWays, ABoxIsTwoThatTouch) {
  SceneDescription one = scene_called("touching_boxes");
  const SceneDescription two = one;
  one.shapes = {box_shape({-1, -1, -1}, {1, 1, 1}, "ball")};
  expect_same(one, two);
}

TEST(OneVolumeInTwoWays, AGridInABoxThatHoldsItIsAFreeVolume) {
  const SceneDescription free = scene_called("grid_linear_16");
  SceneDescription boxed = free;
  boxed.shapes = {box_shape({-2, -2, -2}, {2, 2, 2}, "smoke")};
  boxed.shapes[0].world_from_object = rotate(30, {1, 2, 3});
  expect_same(free, boxed);
}

}  // namespace
}  // namespace brume

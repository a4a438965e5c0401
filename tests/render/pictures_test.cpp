// Pictures of whole scenes, 64 x 64, against stored ones. Seeds are fixed, so that only rounding (instruction sets, the
// mathematical library) may tell them apart: means of 8 x 8 blocks agree within 0.5 %.
// To renew the stored pictures after a change that is meant to change them, set BRUME_RENEW_PICTURES, run the test, and
// look at every picture before it is committed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "render/scenes.h"
#include "scene/read_scene.h"

namespace brume {
namespace {

constexpr int block = 8;

// The greatest difference of two pictures' block means, relative to the stored one's mean over the picture and the
// block.
double block_difference(const Image& picture, const Image& stored) {
  EXPECT_EQ(picture.width, stored.width);
  EXPECT_EQ(picture.height, stored.height);
  const auto mean = [](const Image& image, int x0, int y0, int width, int height, int channel) {
    double sum = 0;
    for (int y = y0; y < y0 + height; ++y)
      for (int x = x0; x < x0 + width; ++x)
        sum += static_cast<double>(image.pixels[static_cast<std::size_t>((y * image.width + x) * 3 + channel)]);
    return sum / (width * height);
  };
  double worst = 0;
  for (int channel = 0; channel < 3; ++channel) {
    const double whole = mean(stored, 0, 0, stored.width, stored.height, channel);
    for (int y = 0; y < stored.height; y += block)
      for (int x = 0; x < stored.width; x += block) {
        const double expected = mean(stored, x, y, block, block, channel);
        worst =
            std::max(worst, std::abs(mean(picture, x, y, block, block, channel) - expected) / (expected + 0.1 * whole));
      }
  }
  return worst;
}

class Pictures : public ::testing::TestWithParam<const char*> {
 protected:
  static SceneDescription scene() {
    std::vector<Diagnostic> warnings;
    return read_scene(path(".pbrt"), warnings);
  }
  static std::string stored_path() { return path(".exr"); }
  static std::string path(const std::string& suffix) {
    return (std::filesystem::path(TEST_DATA) / "pictures" / (GetParam() + suffix)).string();
  }
};

TEST_P(Pictures, LookAsTheyDid) {
  const SceneDescription s = scene();
  const Image picture = render_film(s, s.sampler.pixel_samples, 2).image();
  if (std::getenv("BRUME_RENEW_PICTURES")) write_image(stored_path(), picture, ImageMetadata{});
  EXPECT_LT(block_difference(picture, read_image(stored_path())), 0.005);
}

// Catches light that comes from a direction a little wrong.
TEST_P(Pictures, WouldShowALightTurnedByFiveDegrees) {
  SceneDescription s = scene();
  for (LightDescription& light : s.lights) {
    if (auto* distant = std::get_if<DistantLight>(&light.kind))
      distant->direction_to_light = rotate(5, {0, 1, 0}).vector(distant->direction_to_light);
    if (auto* point = std::get_if<PointLight>(&light.kind)) point->from = rotate(5, {0, 1, 0}).point(point->from);
  }
  const Image picture = render_film(s, s.sampler.pixel_samples, 2).image();
  EXPECT_GT(block_difference(picture, read_image(stored_path())), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Pictures,
                         ::testing::Values("surfaces_in_fog", "cloud_over_ground", "overlapping_media"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace brume

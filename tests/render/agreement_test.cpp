// reference = volpath on small scenes: the z-scores of block means, and of the means of whole pictures.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "image/compare.h"
#include "image/temporary_folder.h"
#include "render/agreement_scenes.h"

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

class Agreement : public ::testing::TestWithParam<std::size_t> {};

void expect_agreement(const AgreementScene& s, int samples, int factor) {
  const Image reference = picture(s.scene, "reference", 1, samples);
  const Image volpath = picture(s.scene, "volpath", 2, factor * samples);
  const ImageComparison c = compare_images(reference, volpath);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const ChannelComparison& d = c.channels[channel];
    const double z = mean_z(reference, volpath, channel);
    std::printf("%-34s %zu: reference %.6f volpath %.6f z %+.2f, blocks z %+.2f +- %.2f (%d)\n", s.name.c_str(),
                channel, d.mean_a, d.mean_b, z, d.scores->mean, d.scores->deviation, d.scores->blocks);
    EXPECT_LE(std::abs(z), 4) << s.name << " channel " << channel;
    EXPECT_TRUE(agree(*d.scores)) << s.name << " channel " << channel;
  }
}

TEST(Agreement, OfAll) {
  TemporaryFolder folder;
  for (const AgreementScene& s : agreement_scenes(folder.path())) {
    if (const char* only = std::getenv("ONLY"); only && s.name.find(only) == std::string::npos) continue;
    const char* n = std::getenv("SAMPLES");
    expect_agreement(s, n ? std::atoi(n) : 64, 4);
  }
}

}  // namespace
}  // namespace brume

#include "image/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brume {

namespace {

bool is_finite(const Spectrum& s, const Foreground& f) {
  for (int c = 0; c < channel_count; ++c)
    if (!std::isfinite(s[c])) return false;
  return std::isfinite(f.coverage) && std::isfinite(f.depth);
}

}  // namespace

Film::Film(int width, int height, const FilmResponse& response)
    : width_(width),
      height_(height),
      response_(response),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

void Film::add(int x, int y, const Spectrum& radiance, const Foreground& foreground, float weight) {
  Pixel& pixel = pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  const Spectrum weighted = weight * radiance;
  if (!is_finite(weighted, foreground)) {
    ++pixel.invalid;
    return;
  }
  const Spectrum rgb = weight * response_(radiance);
  for (int c = 0; c < channel_count; ++c) {
    const double value = rgb[c];
    pixel.sum[c] += value;
    pixel.sum_squares[c] += value * value;
  }
  const double coverage = foreground.coverage;
  pixel.alpha += static_cast<double>(weight) * coverage;
  pixel.coverage += coverage;
  pixel.depth += foreground.depth;
  ++pixel.count;
}

Image Film::image() const {
  static_assert(channel_count == 3, "other spectra need a conversion to red, green and blue here");
  Image image{width_, height_, {}};
  image.pixels.reserve(3 * pixels_.size());
  image.alpha.reserve(pixels_.size());
  image.depth.reserve(pixels_.size());
  for (const Pixel& pixel : pixels_) {
    const auto mean = [&](double sum) { return pixel.count > 0 ? static_cast<float>(sum / pixel.count) : 0.0f; };
    for (const double sum : pixel.sum) image.pixels.push_back(mean(sum));
    image.alpha.push_back(mean(pixel.alpha));
    image.depth.push_back(pixel.coverage > 0 ? static_cast<float>(pixel.depth / pixel.coverage)
                                             : std::numeric_limits<float>::infinity());
  }
  return image;
}

std::vector<float> Film::variance() const {
  std::vector<float> variance;
  variance.reserve(channel_count * pixels_.size());
  for (const Pixel& pixel : pixels_)
    for (int c = 0; c < channel_count; ++c) {
      const double n = pixel.count, mean = pixel.sum[c] / n;
      // Rounding can leave a difference below 0.
      variance.push_back(pixel.count < 2
                             ? std::numeric_limits<float>::quiet_NaN()
                             : static_cast<float>(std::max(pixel.sum_squares[c] / n - mean * mean, 0.0) / (n - 1)));
    }
  return variance;
}

std::int64_t Film::samples() const {
  std::int64_t samples = 0;
  for (const Pixel& pixel : pixels_) samples += pixel.count + pixel.invalid;
  return samples;
}

std::int64_t Film::invalid_samples() const {
  std::int64_t invalid = 0;
  for (const Pixel& pixel : pixels_) invalid += pixel.invalid;
  return invalid;
}

int Film::samples_per_pixel() const {
  std::int32_t least = pixels_.empty() ? 0 : std::numeric_limits<std::int32_t>::max();
  for (const Pixel& pixel : pixels_) least = std::min(least, pixel.count + pixel.invalid);
  return least;
}

}  // namespace brume

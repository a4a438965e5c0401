// The film: what the samples of each pixel add up to.
#pragma once

#include <cstdint>
#include <vector>

#include "base/film_response.h"
#include "base/spectrum.h"
#include "image/image.h"

namespace brume {

// What a sample of the camera sees before the environment: `coverage`, the share of its ray that surfaces and media
// stop on the way there, and `depth`, the sum of the shares times the distances along the camera's axis at which they
// do.
struct Foreground {
  float coverage = 0, depth = 0;
  void add(float share, float distance) {
    coverage += share;
    depth += share * distance;
  }
};

// Sums, sums of squares and counts, so that films of different sample ranges add. A sample contributes to one pixel
// only (filters are importance-sampled), and a pixel is written by one thread at a time, in sample order: the film's
// bits do not depend on the order in which tiles are rendered.
class Film {
 public:
  // `response` is what it makes of radiance.
  Film(int width, int height, const FilmResponse& response = {});
  // How much memory a film of this size takes.
  static std::int64_t bytes(int width, int height) {
    return std::int64_t{width} * height * static_cast<std::int64_t>(sizeof(Pixel));
  }
  int width() const { return width_; }
  int height() const { return height_; }

  // Adds one sample to pixel (x, y), times the weight that the pixel filter gives it. A sample that is not finite is
  // counted instead and left out of the sums.
  void add(int x, int y, const Spectrum& radiance, const Foreground& foreground = {}, float weight = 1);

  // The mean of each pixel's samples, with alpha and depth; black and transparent where there are none.
  Image image() const;
  // The variances of these means, estimated from the samples, as Image::variance has them: with n valid samples of mean
  // m and mean square s, (s - m^2) / (n - 1); NaN where n < 2. True to the picture where samples are independent.
  std::vector<float> variance() const;
  // Of all pixels together; the former counts the latter too.
  std::int64_t samples() const;
  std::int64_t invalid_samples() const;
  // The number of samples that every pixel has had at least, invalid ones included.
  int samples_per_pixel() const;

 private:
  struct Pixel {
    double sum[channel_count] = {}, sum_squares[channel_count] = {};
    double alpha = 0;                // sum of coverages, weighted as the radiance is
    double coverage = 0, depth = 0;  // sums without weights, which may be negative
    std::int32_t count = 0, invalid = 0;
  };
  int width_, height_;
  FilmResponse response_;
  std::vector<Pixel> pixels_;
};

}  // namespace brume

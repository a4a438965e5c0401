// Rendering a scene to a picture.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "brume/scene.h"
#include "brume/statistics.h"

namespace brume {

struct Progress {
  double fraction = 0;  // of the whole, 0 to 1
  double elapsed_seconds = 0;
  double remaining_seconds = -1;  // below 0: not known yet
  double samples_per_second = 0;  // of all pixels together, so far
};

struct Picture;

struct RenderOptions {
  int threads = 0;        // 0: one per core
  bool variance = false;  // estimate the picture's variance too, which takes two samples per pixel at least
  // Above 0: in place of the scene's number of samples per pixel, as many as fit in this time from the call on, at
  // least one and at most max_samples. All pixels get the same number, and the picture is the one that this number
  // gives without a time.
  double seconds = 0;
  int max_samples = 1 << 24;
  // Called now and then from the thread that called render; false stops the render early.
  std::function<bool(const Progress&)> on_progress;
  // Called from the same thread with each warning, ready to be shown, as soon as it is known.
  std::function<void(const std::string&)> on_warning;
  // Called from the same thread with the picture so far, marked partial: once each pixel has a sample, then every few
  // seconds, or as soon afterwards as all pixels have the same number again.
  std::function<void(const Picture&)> on_partial_picture;
};

// A picture with what its file says of it.
struct Picture {
  int width = 0, height = 0;
  std::vector<float> pixels;  // scene-linear Rec.709, rows from the top, three floats a pixel
  // One a pixel. Alpha is the share of the camera's rays that surfaces and media stop on the way to the environment,
  // coloured transmittances averaged; `pixels` holds what is seen through the rest too. Depth is the mean distance
  // along the camera's axis at which they are stopped, in world units; infinite where none is.
  std::vector<float> alpha, depth;
  // The variance of each of the pixels' values, estimated from the samples and true to the picture where these are
  // independent (sampler "independent"); NaN where a pixel has fewer than two samples. Empty unless asked for.
  std::vector<float> variance;
  int samples_per_pixel = 0;  // as rendered; of a partial picture, what every pixel has at least
  bool partial = false;       // not all of the samples asked for
  double seconds = 0;
  std::int64_t invalid_samples = 0;  // samples that were not finite and were left out
  std::vector<std::string> warnings;
  Statistics statistics;

  // Writes .exr, .png (sRGB, opaque) or .pfm by the suffix of `path`, whole or not at all. The values of a .png are
  // multiplied by 2^exposure. Into an .exr go
  // alpha as channel A and depth as Z, which has 32 bits always; and the variance as the layer Variance (Variance.R,
  // .G, .B), where all values are 32-bit floats then. Throws Error.
  void write(const std::string& path, double exposure = 0) const;
  // Throws Error unless write(path) can be expected to work: a known suffix, and a folder that can be written to. To be
  // called before a long render.
  static void check_output(const std::string& path);

  struct Metadata;
  std::shared_ptr<const Metadata> metadata;
};

// Renders a scene. Stopped early, it returns what there is, marked partial. The picture's bits depend on the scene and
// on the instruction set, not on the number of threads. The environment variable BRUME_ISA (avx512, avx2, sse4 or
// scalar) chooses a lower instruction set than the machine's best. Throws Error where the scene cannot be rendered (a
// missing volume file, say).
Picture render(const Scene& scene, const RenderOptions& options = {});

}  // namespace brume

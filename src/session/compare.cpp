#include "brume/compare.h"

#include <fmt/format.h>

#include "image/compare.h"
#include "session/errors.h"

namespace brume {

namespace {

void check_size(const std::string& path, const Image& image, const std::string& other_path, const Image& other) {
  if (image.width == other.width && image.height == other.height) return;
  throw InputError(path, fmt::format("its {} x {} pixels cannot be compared with the {} x {} of {}", image.width,
                                     image.height, other.width, other.height, other_path));
}

Comparison::Scores public_scores(const BlockScores& s) {
  return {s.blocks, s.unexplained, s.mean, mean_limit(s), s.deviation, deviation_limit(s), agree(s)};
}

Comparison::Channel public_channel(const ChannelComparison& c) {
  Comparison::Channel channel{c.mean_a, c.mean_b, c.mean_ratio, {}};
  if (c.scores) channel.scores = public_scores(*c.scores);
  return channel;
}

}  // namespace

Comparison compare(const std::string& a, const std::string& b, const std::string& reference, int block_size) {
  return with_public_errors([&] {
    if (block_size < 1) throw InputError(a, fmt::format("cannot be compared in blocks of size {}", block_size));
    const Image image_a = read_image(a), image_b = read_image(b);
    check_size(b, image_b, a, image_a);
    std::optional<Image> ref;
    if (!reference.empty()) {
      ref = read_image(reference);
      check_size(reference, *ref, a, image_a);
    }
    const ImageComparison c = compare_images(image_a, image_b, ref ? &*ref : nullptr, block_size);
    if (c.pixels == 0) throw InputError(a, "cannot be compared: no pixel is finite in all the pictures");

    Comparison result{image_a.width, image_a.height, c.pixels, c.invalid_pixels, {},
                      c.mean_ratio,  c.mse,          c.relmse, c.trimmed_relmse};
    for (std::size_t i = 0; i < result.channels.size(); ++i) result.channels[i] = public_channel(c.channels[i]);
    return result;
  });
}

}  // namespace brume

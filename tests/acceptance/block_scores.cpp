// check_block_scores A B: whether the difference of two pictures of one scene has structure, where at least one of them
// does not state its variance. In a block of pixels that differ by noise alone the differences have mean 0, and their
// spread says how far off 0 their mean may be: t = mean / (deviation / sqrt(pixels)). The scores' mean and deviation
// are judged as z-scores of blocks are; exit code 1 where a channel fails. A channel's factor, the median of the
// blocks' ratios, is taken out first: a spectral renderer reproduces the colour of a light to a thousandth or so. The
// noise of neighbouring pixels has to be independent: render with Sampler "independent".
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "image/image.h"

namespace brume {
namespace {

constexpr int block_edge = 16;

struct Sums {
  double sum = 0, squares = 0;
  int count = 0;
  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double mean() const { return sum / count; }
  double deviation() const { return std::sqrt(std::max(0.0, squares - sum * mean()) / (count - 1)); }
};

// Calls visit(values of a, values of b) with one channel of each block.
template <class Visit>
void visit_blocks(const Image& a, const Image& b, int channel, Visit visit) {
  std::vector<double> in_a(block_edge * block_edge), in_b(in_a.size());
  for (int y = 0; y + block_edge <= a.height; y += block_edge)
    for (int x = 0; x + block_edge <= a.width; x += block_edge) {
      for (std::size_t i = 0; i < in_a.size(); ++i) {
        const int row = y + static_cast<int>(i) / block_edge, column = x + static_cast<int>(i) % block_edge;
        const auto at = static_cast<std::size_t>(3 * (row * a.width + column) + channel);
        in_a[i] = static_cast<double>(a.pixels[at]);
        in_b[i] = static_cast<double>(b.pixels[at]);
      }
      visit(in_a, in_b);
    }
}

// Of one channel. Blocks without any noise are left out.
Sums scores(const Image& a, const Image& b, int channel) {
  std::vector<double> factors;
  visit_blocks(a, b, channel, [&](const auto& in_a, const auto& in_b) {
    factors.push_back(std::reduce(in_b.begin(), in_b.end()) / std::reduce(in_a.begin(), in_a.end()));
  });
  const auto median = factors.begin() + static_cast<std::ptrdiff_t>(factors.size() / 2);
  std::nth_element(factors.begin(), median, factors.end());
  Sums all;
  visit_blocks(a, b, channel, [&](const auto& in_a, const auto& in_b) {
    Sums block;
    for (std::size_t i = 0; i < in_a.size(); ++i) block.add(*median * in_a[i] - in_b[i]);
    if (block.deviation() > 1e-6) all.add(block.mean() / block.deviation() * block_edge);
  });
  return all;
}

bool check(const std::string& name_a, const std::string& name_b) {
  const Image a = read_image(name_a), b = read_image(name_b);
  if (a.width != b.width || a.height != b.height) throw InputError(name_b, "its size is not that of " + name_a);
  bool passes_all = true;
  for (int channel = 0; channel < 3; ++channel) {
    const Sums s = scores(a, b, channel);
    const bool agrees =
        std::abs(s.mean()) <= 4 / std::sqrt(s.count) && std::abs(s.deviation() - 1) <= 4 / std::sqrt(2.0 * s.count);
    std::printf("%c %+.3f +- %.3f of %d blocks: %s%s", "RGB"[channel], s.mean(), s.deviation(), s.count,
                agrees ? "agrees" : "DIFFERS", channel < 2 ? ", " : "\n");
    passes_all = passes_all && agrees;
  }
  return passes_all;
}

}  // namespace
}  // namespace brume

int main(int argc, char** argv) {
  if (argc != 3) return std::puts("usage: check_block_scores A B"), 1;
  try {
    return brume::check(argv[1], argv[2]) ? 0 : 1;
  } catch (const brume::InputError& e) {
    for (const brume::Diagnostic& d : e.diagnostics())
      std::printf("%s: %s\n", d.location.file.c_str(), d.message.c_str());
    return 1;
  }
}

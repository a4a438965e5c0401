// The plot of a phase function as a picture, labels included: digits of 3 x 5 pixels do for both axes.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/diagnostics.h"
#include "base/file.h"
#include "brume/phase.h"
#include "image/image.h"
#include "session/errors.h"
#include "session/version.h"

namespace brume {

namespace {

constexpr int width = 480, height = 320;
constexpr int left = 44, right = 460, top = 16, bottom = 290;  // the pixels that the axes span
constexpr float paper = 1, grid_grey = 0.75f, axis_grey = 0.25f, ink = 0.02f;

// Rows from the top, three bits each.
constexpr std::string_view glyphs = "0123456789-";
constexpr std::array<std::array<int, 5>, glyphs.size()> glyph_rows{{{7, 5, 5, 5, 7},
                                                                    {2, 6, 2, 2, 7},
                                                                    {7, 1, 7, 4, 7},
                                                                    {7, 1, 7, 1, 7},
                                                                    {5, 5, 7, 1, 1},
                                                                    {7, 4, 7, 1, 7},
                                                                    {7, 4, 7, 5, 7},
                                                                    {7, 1, 1, 2, 2},
                                                                    {7, 5, 7, 5, 7},
                                                                    {7, 5, 7, 1, 7},
                                                                    {0, 0, 7, 0, 0}}};

class Canvas {
 public:
  Canvas() : image_{width, height, std::vector<float>(std::size_t{3} * width * height, paper)} {}

  // Mixes a grey into a pixel.
  void blend(int x, int y, float grey, float share) {
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    for (int c = 0; c < 3; ++c) {
      float& value = image_.pixels[static_cast<std::size_t>(3 * (y * width + x) + c)];
      value += (grey - value) * share;
    }
  }

  // Digits twice their size, with the upper left corner at (x, y).
  void text(int x, int y, const std::string& digits) {
    for (const char digit : digits) {
      const auto& rows = glyph_rows[glyphs.find(digit)];
      for (int row = 0; row < 10; ++row)
        for (int column = 0; column < 6; ++column)
          if (rows[static_cast<std::size_t>(row / 2)] >> (2 - column / 2) & 1) blend(x + column, y + row, axis_grey, 1);
      x += 8;
    }
  }

  void vertical(int x, float grey) {
    for (int y = top; y <= bottom; ++y) blend(x, y, grey, 1);
  }
  void horizontal(int y, float grey) {
    for (int x = left; x <= right; ++x) blend(x, y, grey, 1);
  }
  const Image& image() const { return image_; }

 private:
  Image image_;
};

void draw_axes(Canvas& canvas, const Decades& range) {
  for (int angle = 0; angle <= 180; angle += 45) {
    const int x = left + (right - left) * angle / 180;
    const std::string label = std::to_string(angle);
    canvas.vertical(x, angle == 0 ? axis_grey : grid_grey);
    canvas.text(x - 4 * static_cast<int>(label.size()), bottom + 10, label);
  }
  // At most ten labels, written 10 with the exponent above.
  const int step = (range.hi - range.lo + 9) / 10;
  for (int decade = range.lo; decade <= range.hi; decade += step) {
    const int y = bottom - (bottom - top) * (decade - range.lo) / (range.hi - range.lo);
    canvas.horizontal(y, decade == range.lo ? axis_grey : grid_grey);
    canvas.text(4, y - 3, "10");
    canvas.text(21, y - 9, std::to_string(decade));
  }
}

// A line about two pixels wide, smoothed by the distance from it.
void draw_curve(Canvas& canvas, const PhaseCurve& curve, const Decades& range) {
  std::array<double, right - left + 1> line{};
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double at = static_cast<double>(i) / (right - left) * static_cast<double>(curve.values.size() - 1);
    const auto before = std::min(static_cast<std::size_t>(at), curve.values.size() - 2);
    const double share = at - static_cast<double>(before);
    const auto exponent = [&](std::size_t k) { return std::log10(std::max(curve.values[k], 1e-12)); };
    const double value = (1 - share) * exponent(before) + share * exponent(before + 1);
    line[i] = bottom - (bottom - top) * (value - range.lo) / (range.hi - range.lo);
  }
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double slope = 0.5 * (line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0]);
    const double across = std::sqrt(1 + slope * slope);
    for (int y = top - 2; y <= bottom + 2; ++y) {
      const double distance = std::abs(y - line[i]) / across;
      canvas.blend(left + static_cast<int>(i), y, ink, static_cast<float>(std::clamp(1.6 - distance, 0.0, 1.0)));
    }
  }
}

}  // namespace

void write_phase_plot(const PhaseCurve& curve, const std::string& path) {
  with_public_errors([&] {
    if (suffix(path) != ".png") throw InputError(path, "plots are written as .png");
    Canvas canvas;
    const Decades range = decades(curve);
    draw_axes(canvas, range);
    draw_curve(canvas, curve, range);
    ImageMetadata metadata;
    metadata.software = software_name();
    write_image(path, canvas.image(), metadata);
  });
}

}  // namespace brume

#pragma once

namespace brume {

// The pixels (x, y) with x0 <= x < x1 and y0 <= y < y1; y counts from the top.
struct PixelBox {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool operator==(const PixelBox&) const = default;
};

}  // namespace brume

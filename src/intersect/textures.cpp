#include "intersect/textures.h"

#include <algorithm>
#include <cmath>

namespace brume {

namespace {

struct TexturePoint {
  double s = 0, t = 0;
};

TexturePoint mapped(const CompiledMapping& m, const SurfacePlace& place) {
  const auto [x, y, z] = m.planar ? place.position : Vector3{place.uv[0], place.uv[1], 0};
  const auto along = [&](const std::array<double, 4>& row) { return row[0] * x + row[1] * y + row[2] * z + row[3]; };
  const TexturePoint p{along(m.rows[0]), along(m.rows[1])};
  return std::isfinite(p.s) && std::isfinite(p.t) ? p : TexturePoint{};
}

bool is_odd(double whole) { return std::fmod(whole, 2) != 0; }

// A pixel, columns from the left and rows from below, which may lie outside.
Spectrum pixel(const CompiledImage& image, CompiledTexture::Wrap wrap, int column, int row) {
  const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
  if (wrap == CompiledTexture::Wrap::repeat) {
    column = (column + width) % width;
    row = (row + height) % height;
  } else if (wrap == CompiledTexture::Wrap::clamp) {
    column = std::clamp(column, 0, width - 1);
    row = std::clamp(row, 0, height - 1);
  } else if (column < 0 || column >= width || row < 0 || row >= height) {
    return {};
  }
  const std::size_t place = static_cast<std::size_t>(height - 1 - row) * image.width + static_cast<std::size_t>(column);
  const float* v = image.pixels.data() + place * image.channels;
  return image.channels == 1 ? constant_spectrum(*v) : Spectrum{{v[0], v[1], v[2]}};
}

Spectrum look_up(const CompiledTexture& texture, const CompiledImage& image, TexturePoint p) {
  if (texture.wrap == CompiledTexture::Wrap::repeat) {
    p = {p.s - std::floor(p.s), p.t - std::floor(p.t)};
  } else {  // further out there is nothing new
    p = {std::clamp(p.s, -1.0, 2.0), std::clamp(p.t, -1.0, 2.0)};
  }
  const double x = p.s * image.width, y = p.t * image.height;
  if (!texture.bilinear)
    return pixel(image, texture.wrap, static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
  const double left = std::floor(x - 0.5), bottom = std::floor(y - 0.5);
  const auto right = static_cast<float>(x - 0.5 - left), up = static_cast<float>(y - 0.5 - bottom);
  const int column = static_cast<int>(left), row = static_cast<int>(bottom);
  const auto at = [&](int i, int j) { return pixel(image, texture.wrap, column + i, row + j); };
  return (1 - up) * ((1 - right) * at(0, 0) + right * at(1, 0)) + up * ((1 - right) * at(0, 1) + right * at(1, 1));
}

Spectrum image_value(const CompiledScene& scene, const CompiledTexture& texture, const SurfacePlace& place) {
  Spectrum v = texture.scale *
               look_up(texture, scene.images[static_cast<std::size_t>(texture.image)], mapped(texture.mapping, place));
  for (int c = 0; c < channel_count; ++c) v[c] = std::max(0.0f, texture.invert ? 1 - v[c] : v[c]);
  return v;
}

}  // namespace

SurfacePlace place_of(const SurfaceHit& hit) {
  const auto to_double = [](float v) { return static_cast<double>(v); };
  return {{to_double(hit.uv[0]), to_double(hit.uv[1])},
          {to_double(hit.position.x), to_double(hit.position.y), to_double(hit.position.z)}};
}

Spectrum texture_value(const CompiledScene& scene, std::int32_t texture, const SurfacePlace& place) {
  const CompiledTexture& t = scene.textures[static_cast<std::size_t>(texture)];
  const auto operand = [&](std::size_t i) { return texture_value(scene, t.operands[i], place); };
  switch (t.kind) {
    case CompiledTexture::Kind::constant:
      return t.value;
    case CompiledTexture::Kind::scale:
      return operand(0) * operand(1);
    case CompiledTexture::Kind::mix: {
      const float amount = operand(2)[0];
      return (1 - amount) * operand(0) + amount * operand(1);
    }
    case CompiledTexture::Kind::checkerboard: {
      const TexturePoint p = mapped(t.mapping, place);
      return operand(is_odd(std::floor(p.s)) != is_odd(std::floor(p.t)) ? 1 : 0);
    }
    case CompiledTexture::Kind::image:
      break;
  }
  return image_value(scene, t, place);
}

Spectrum texture_reflectance(const CompiledScene& scene, std::int32_t texture, const SurfaceHit& hit) {
  Spectrum v = texture_value(scene, texture, hit);
  for (int c = 0; c < channel_count; ++c) v[c] = v[c] > 0 ? std::min(v[c], 1.0f) : 0;  // of a NaN, 0
  return v;
}

}  // namespace brume

// Textures: their operands become textures of their own, and their pictures are read.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compile/compiler.h"
#include "image/image.h"

namespace brume {

namespace {

CompiledMapping compile_mapping(const TextureMapping& from) {
  CompiledMapping m;
  m.planar = from.planar;
  if (!from.planar) {
    m.rows = {{{from.u_scale, 0, 0, from.u_offset}, {0, from.v_scale, 0, from.v_offset}}};
    return m;
  }
  const Transform texture_from_world = inverse(from.world_from_texture);
  const auto row = [&](Vector3 v, double offset) {
    const Vector3 w = transposed(texture_from_world, v);
    return std::array{w.x, w.y, w.z, offset + dot(v, texture_from_world.point({}))};
  };
  m.rows = {row(from.v1, from.u_offset), row(from.v2, from.v_offset)};
  return m;
}

// A grey of three equal channels is their mean, as pbrt's float textures take it.
CompiledImage compile_image(Image&& image, bool is_float) {
  CompiledImage c{static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height), 3, {}};
  if (!is_float) {
    c.pixels = std::move(image.pixels);
    return c;
  }
  c.channels = 1;
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    c.pixels.push_back((image.pixels[i] + image.pixels[i + 1] + image.pixels[i + 2]) / 3);
  return c;
}

}  // namespace

std::int32_t Compiler::add_texture(const CompiledTexture& texture) {
  compiled_.textures.push_back(texture);
  return static_cast<std::int32_t>(compiled_.textures.size() - 1);
}

std::int32_t Compiler::operand(const Textured& value) {
  if (value.texture >= 0) return textures_.at(static_cast<std::size_t>(value.texture));
  CompiledTexture constant;
  constant.value = value.value;
  return add_texture(constant);
}

void Compiler::add_textures() {
  using Kind = CompiledTexture::Kind;
  for (const TextureDescription& description : scene_.textures) {
    CompiledTexture t;
    if (const auto* constant = std::get_if<ConstantTexture>(&description.kind)) {
      t.value = constant->value;
    } else if (const auto* scaled = std::get_if<ScaleTexture>(&description.kind)) {
      t.kind = Kind::scale;
      t.operands = {operand(scaled->texture), operand(scaled->scale)};
    } else if (const auto* mix = std::get_if<MixTexture>(&description.kind)) {
      t.kind = Kind::mix;
      t.operands = {operand(mix->first), operand(mix->second), operand(mix->amount)};
    } else if (const auto* board = std::get_if<CheckerboardTexture>(&description.kind)) {
      t.kind = Kind::checkerboard;
      t.operands = {operand(board->first), operand(board->second)};
      t.mapping = compile_mapping(board->mapping);
    } else {
      const auto& image = std::get<ImageTexture>(description.kind);
      t.kind = Kind::image;
      t.image = image_index(image, description.is_float, fmt::format("Texture \"{}\"", description.name));
      t.mapping = compile_mapping(image.mapping);
      t.wrap = static_cast<CompiledTexture::Wrap>(image.wrap);
      t.bilinear = image.bilinear;
      t.invert = image.invert;
      t.scale = static_cast<float>(image.scale);
    }
    textures_.push_back(add_texture(t));
  }
}

std::int32_t Compiler::normal_map(const Relief& relief) {
  const auto [known, is_new] = normal_maps_.try_emplace(relief.normal_map.text, -1);
  if (!is_new) return known->second;
  ImageTexture picture;
  picture.filename = relief.normal_map;
  picture.gamma = 1;
  CompiledTexture t;
  t.kind = CompiledTexture::Kind::image;
  t.image = image_index(picture, false, "the material's normal map");
  known->second = add_texture(t);
  return known->second;
}

std::int32_t Compiler::image_index(const ImageTexture& from, bool is_float, const std::string& owner) {
  const auto [known, is_new] = images_.try_emplace({from.filename.text, from.gamma, is_float}, -1);
  if (!is_new) return known->second;
  try {
    Image image = read_encoded_image(from.filename, from.gamma);
    if (!std::all_of(image.pixels.begin(), image.pixels.end(), [](float v) { return std::isfinite(v); })) {
      error(from.filename.location, fmt::format("{} has pixels that are infinite or not a number", from.filename.text));
      return -1;
    }
    compiled_.images.push_back(compile_image(std::move(image), is_float));
    known->second = static_cast<std::int32_t>(compiled_.images.size() - 1);
  } catch (const InputError& fault) {
    for (const Diagnostic& d : fault.diagnostics())
      error(from.filename.location, fmt::format("the image of {}: {}: {}", owner, d.location.file, d.message));
  }
  return known->second;
}

}  // namespace brume

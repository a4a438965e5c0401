#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <charconv>
#include <span>
#include <stdexcept>

#include "image/check_exr_header.h"
#include "image/exr_channels.h"
#include "image/exr_memory_stream.h"
#include "image/formats.h"

namespace brume {

namespace {

template <class Attribute, class Value>
void find(const Imf::Header& header, const char* name, Value& value) {
  if (const auto* attribute = header.findTypedAttribute<Attribute>(name)) value = Value(attribute->value());
}

// From OpenEXR's matrices, which act on row vectors.
std::optional<std::array<std::array<double, 4>, 4>> find_matrix(const Imf::Header& header, const char* name) {
  const auto* attribute = header.findTypedAttribute<Imf::M44fAttribute>(name);
  if (!attribute) return std::nullopt;
  std::array<std::array<double, 4>, 4> m{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      m[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = static_cast<double>(attribute->value()[j][i]);
  return m;
}

const Imf::Channel* find_channel(const Imf::InputFile& file, const char* name) {
  return file.header().channels().findChannel(name);
}

// Has channels of the file read into `values`, one float for each a pixel.
void insert(Imf::FrameBuffer& frame, const Imf::InputFile& file, std::span<const char* const> names,
            std::vector<float>& values) {
  for (const char* name : names) {
    const Imf::Channel* channel = find_channel(file, name);
    if (!channel) throw std::runtime_error(std::string("it has no channel ") + name);
    if (channel->xSampling != 1 || channel->ySampling != 1) throw std::runtime_error("its channels are subsampled");
  }
  const Imath::Box2i window = file.header().dataWindow();
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
  values.resize(width * static_cast<std::size_t>(window.max.y - window.min.y + 1) * names.size());
  const std::size_t pixel = names.size() * sizeof(float);
  float* first = values.data();
  for (const char* name : names)
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, first++, window, pixel, pixel * width));
}

}  // namespace

ImageMetadata decode_exr_metadata(std::string_view bytes) {
  check_exr_header(bytes);
  ExrMemoryStream stream(bytes);
  const Imf::InputFile file(stream);
  const Imf::Header& header = file.header();
  ImageMetadata metadata;
  find<Imf::IntAttribute>(header, "samplesPerPixel", metadata.samples_per_pixel);
  find<Imf::FloatAttribute>(header, "renderTimeSeconds", metadata.render_time_seconds);
  find<Imf::IntAttribute>(header, "partial", metadata.partial);
  find<Imf::StringAttribute>(header, "software", metadata.software);
  if (const auto m = find_matrix(header, "worldToCamera")) metadata.camera_from_world.m = *m;
  metadata.ndc_from_world = find_matrix(header, "worldToNDC");
  const Imath::Box2i whole = header.displayWindow(), window = header.dataWindow();
  if (whole != window) {
    metadata.x = window.min.x - whole.min.x;
    metadata.y = window.min.y - whole.min.y;
    metadata.whole_width = whole.max.x - whole.min.x + 1;
    metadata.whole_height = whole.max.y - whole.min.y + 1;
  }
  std::string seed;
  find<Imf::StringAttribute>(header, "seed", seed);
  std::from_chars(seed.data(), seed.data() + seed.size(), metadata.seed);
  const Imf::Channel* red = header.channels().findChannel("R");
  metadata.half = red && red->type == Imf::HALF;
  return metadata;
}

Image decode_exr(std::string_view bytes) {
  check_exr_header(bytes);
  ExrMemoryStream stream(bytes);
  Imf::InputFile file(stream);
  const Imath::Box2i window = file.header().dataWindow();
  Image image{window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, {}};
  Imf::FrameBuffer frame;
  insert(frame, file, colour_channels, image.pixels);
  if (find_channel(file, alpha_channel)) insert(frame, file, {&alpha_channel, 1}, image.alpha);
  if (find_channel(file, depth_channel)) insert(frame, file, {&depth_channel, 1}, image.depth);
  if (find_channel(file, variance_channels[0])) insert(frame, file, variance_channels, image.variance);
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace brume

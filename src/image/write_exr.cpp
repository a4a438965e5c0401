// OpenEXR: scanlines, channels R, G and B, and A, Z and the layer Variance where the image has them, ZIP.
#include <ImathBox.h>
#include <ImathMatrix.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <span>

#include "image/exr_channels.h"
#include "image/formats.h"

namespace brume {

namespace {

class MemoryStream : public Imf::OStream {
 public:
  MemoryStream() : Imf::OStream("") {}
  void write(const char data[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (position_ + size > bytes.size()) bytes.resize(position_ + size);
    std::copy_n(data, size, bytes.begin() + static_cast<std::ptrdiff_t>(position_));
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::string bytes;

 private:
  std::size_t position_ = 0;
};

// OpenEXR's matrices act on row vectors, p' = p M: the transpose of ours.
Imath::M44f row_vector_matrix(const std::array<std::array<double, 4>, 4>& m) {
  Imath::M44f r;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      r[i][j] = static_cast<float>(m[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)]);
  return r;
}

Imf::Chromaticities chromaticities(const Primaries& p) {
  const auto point = [](Chromaticity c) { return Imath::V2f(static_cast<float>(c.x), static_cast<float>(c.y)); };
  return {point(p.red), point(p.green), point(p.blue), point(p.white)};
}

Imf::Header make_header(const Image& image, const ImageMetadata& metadata) {
  const Imath::V2i first(metadata.x, metadata.y);
  const Imath::Box2i data_window(first, first + Imath::V2i(image.width - 1, image.height - 1));
  const bool is_part = metadata.whole_width > 0;
  Imf::Header header(
      is_part ? Imath::Box2i({0, 0}, {metadata.whole_width - 1, metadata.whole_height - 1}) : data_window, data_window);
  header.compression() = Imf::ZIP_COMPRESSION;
  const Imf::Channel colour(metadata.half ? Imf::HALF : Imf::FLOAT);
  for (const char* channel : colour_channels) header.channels().insert(channel, colour);
  if (!image.alpha.empty()) header.channels().insert(alpha_channel, colour);
  if (!image.depth.empty()) header.channels().insert(depth_channel, Imf::Channel(Imf::FLOAT));
  if (!image.variance.empty())
    for (const char* channel : variance_channels) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  header.insert("samplesPerPixel", Imf::IntAttribute(metadata.samples_per_pixel));
  header.insert("renderTimeSeconds", Imf::FloatAttribute(static_cast<float>(metadata.render_time_seconds)));
  header.insert("worldToCamera", Imf::M44fAttribute(row_vector_matrix(metadata.camera_from_world.m)));
  if (metadata.ndc_from_world)
    header.insert("worldToNDC", Imf::M44fAttribute(row_vector_matrix(*metadata.ndc_from_world)));
  // An attribute of integers is signed; a seed is not.
  header.insert("seed", Imf::StringAttribute(std::to_string(metadata.seed)));
  header.insert("partial", Imf::IntAttribute(metadata.partial ? 1 : 0));
  if (metadata.colour_space != ColourSpace::srgb)
    Imf::addChromaticities(header, chromaticities(primaries(metadata.colour_space)));
  header.insert("software", Imf::StringAttribute(metadata.software));
  return header;
}

// Has channels written from `values`, which hold one for each name a pixel; nothing where there are none.
template <class Value>
void insert(Imf::FrameBuffer& frame, const Imf::Header& header, std::span<const char* const> names, Imf::PixelType type,
            const std::vector<Value>& values) {
  if (values.empty()) return;
  const Imath::Box2i window = header.dataWindow();
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
  const std::size_t pixel = names.size() * sizeof(Value);
  for (std::size_t i = 0; i < names.size(); ++i)
    frame.insert(names[i], Imf::Slice::Make(type, values.data() + i, window, pixel, pixel * width));
}

// 65504 is the largest finite half.
half to_half(float v) { return half(std::clamp(v, -65504.0f, 65504.0f)); }

std::vector<half> to_halves(const std::vector<float>& values) {
  std::vector<half> halves(values.size());
  std::transform(values.begin(), values.end(), halves.begin(), to_half);
  return halves;
}

}  // namespace

std::string encode_exr(const Image& image, const ImageMetadata& metadata) {
  MemoryStream stream;
  {
    Imf::OutputFile file(stream, make_header(image, metadata));
    Imf::FrameBuffer frame;
    std::vector<half> colour, alpha;
    if (metadata.half) {
      colour = to_halves(image.pixels);
      alpha = to_halves(image.alpha);
      insert(frame, file.header(), colour_channels, Imf::HALF, colour);
      insert(frame, file.header(), {&alpha_channel, 1}, Imf::HALF, alpha);
    } else {
      insert(frame, file.header(), colour_channels, Imf::FLOAT, image.pixels);
      insert(frame, file.header(), {&alpha_channel, 1}, Imf::FLOAT, image.alpha);
    }
    insert(frame, file.header(), {&depth_channel, 1}, Imf::FLOAT, image.depth);
    insert(frame, file.header(), variance_channels, Imf::FLOAT, image.variance);
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  }  // the destructor writes the table of offsets
  return std::move(stream.bytes);
}

}  // namespace brume

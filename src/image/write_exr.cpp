// OpenEXR: scanlines, channels R, G and B, ZIP.
#include <ImathMatrix.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>

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

Imf::Header make_header(const Image& image, const ImageMetadata& metadata) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const char* channel : {"R", "G", "B"})
    header.channels().insert(channel, Imf::Channel(metadata.half ? Imf::HALF : Imf::FLOAT));
  header.insert("samplesPerPixel", Imf::IntAttribute(metadata.samples_per_pixel));
  header.insert("renderTimeSeconds", Imf::FloatAttribute(static_cast<float>(metadata.render_time_seconds)));
  header.insert("worldToCamera", Imf::M44fAttribute(row_vector_matrix(metadata.camera_from_world.m)));
  header.insert("worldToNDC", Imf::M44fAttribute(row_vector_matrix(metadata.ndc_from_world)));
  // An attribute of integers is signed; a seed is not.
  header.insert("seed", Imf::StringAttribute(std::to_string(metadata.seed)));
  header.insert("partial", Imf::IntAttribute(metadata.partial ? 1 : 0));
  header.insert("software", Imf::StringAttribute(metadata.software));
  return header;
}

template <class Value>
void write_pixels(Imf::OutputFile& file, const Image& image, Imf::PixelType type, Value* values) {
  const std::size_t x_stride = 3 * sizeof(Value), y_stride = x_stride * static_cast<std::size_t>(image.width);
  Imf::FrameBuffer frame;
  for (int c = 0; c < 3; ++c)
    frame.insert(c == 0   ? "R"
                 : c == 1 ? "G"
                          : "B",
                 Imf::Slice(type, reinterpret_cast<char*>(values + c), x_stride, y_stride));
  file.setFrameBuffer(frame);
  file.writePixels(image.height);
}

// 65504 is the largest finite half.
half to_half(float v) { return half(std::clamp(v, -65504.0f, 65504.0f)); }

}  // namespace

std::string encode_exr(const Image& image, const ImageMetadata& metadata) {
  MemoryStream stream;
  {
    Imf::OutputFile file(stream, make_header(image, metadata));
    if (metadata.half) {
      std::vector<half> values(image.pixels.size());
      std::transform(image.pixels.begin(), image.pixels.end(), values.begin(), to_half);
      write_pixels(file, image, Imf::HALF, values.data());
    } else {
      std::vector<float> values = image.pixels;
      write_pixels(file, image, Imf::FLOAT, values.data());
    }
  }  // the destructor writes the table of offsets
  return std::move(stream.bytes);
}

}  // namespace brume

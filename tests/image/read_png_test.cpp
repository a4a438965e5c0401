// PNG files of every kind as textures read them, and damaged ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <fstream>
#include <random>

#include "base/diagnostics.h"
#include "base/file.h"
#include "base/memory.h"
#include "image/image.h"
#include "image/temporary_folder.h"

namespace brume {
namespace {

using testing::HasSubstr;

struct Png {
  png_uint_32 width = 3, height = 2;
  int bits = 8, type = PNG_COLOR_TYPE_RGB;
  bool interlaced = false;
  std::vector<png_byte> data;  // rows, packed

  void write(const std::string& path) const {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, width, height, bits, type, interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    const png_color palette[] = {{10, 20, 30}, {255, 0, 128}};
    if (type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette, 2);
    png_write_info(png, info);
    const std::size_t row = data.size() / height;
    std::vector<png_bytep> rows;
    for (png_uint_32 y = 0; y < height; ++y) rows.push_back(const_cast<png_bytep>(data.data() + y * row));
    png_write_image(png, rows.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
  }
};

std::vector<png_byte> ramp(std::size_t size) {
  std::vector<png_byte> bytes;
  for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<png_byte>(13 * i + 5));
  return bytes;
}

double from_srgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

class PngFiles : public testing::Test {
 protected:
  Image read(const Png& png, double gamma = 0) {
    png.write(path_);
    return read_encoded_image(path_, gamma);
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.file("a.png");
};

TEST_F(PngFiles, ColoursFollowTheirCurve) {
  Png png;
  png.data = ramp(18);
  const Image srgb = read(png), linear = read(png, 1), squared = read(png, 2);
  ASSERT_EQ(srgb.width, 3);
  ASSERT_EQ(srgb.height, 2);
  ASSERT_EQ(srgb.pixels.size(), 18u);
  for (std::size_t i = 0; i < 18; ++i) {
    const double stored = png.data[i] / 255.0;
    EXPECT_NEAR(srgb.pixels[i], from_srgb(stored), 1e-6);
    EXPECT_NEAR(linear.pixels[i], stored, 1e-6);
    EXPECT_NEAR(squared.pixels[i], stored * stored, 1e-6);
  }
}

// What Brume writes comes back within half a step of its 8 bits.
TEST_F(PngFiles, ReadBackWhatBrumeWrites) {
  Image image{5, 3, {}};
  for (int i = 0; i < 45; ++i) image.pixels.push_back(static_cast<float>(i) / 44);
  write_image(path_, image, {});
  const Image back = read_encoded_image(path_, 0);
  ASSERT_EQ(back.pixels.size(), image.pixels.size());
  for (std::size_t i = 0; i < 45; ++i) EXPECT_NEAR(back.pixels[i], image.pixels[i], 0.0046);
}

TEST_F(PngFiles, AllKindsBecomeThreeChannels) {
  const Png grey{2, 1, 8, PNG_COLOR_TYPE_GRAY, false, {51, 204}};
  EXPECT_THAT(read(grey, 1).pixels,
              testing::Pointwise(testing::FloatNear(1e-6f), {0.2f, 0.2f, 0.2f, 0.8f, 0.8f, 0.8f}));
  const Png bits{2, 1, 1, PNG_COLOR_TYPE_GRAY, false, {0x40}};
  EXPECT_THAT(read(bits, 1).pixels, testing::ElementsAre(0, 0, 0, 1, 1, 1));
  const Png palette{2, 1, 8, PNG_COLOR_TYPE_PALETTE, false, {1, 0}};
  EXPECT_THAT(
      read(palette, 1).pixels,
      testing::Pointwise(testing::FloatNear(1e-6f), {1.0f, 0.0f, 128 / 255.0f, 10 / 255.0f, 20 / 255.0f, 30 / 255.0f}));
  const Png alpha{1, 1, 8, PNG_COLOR_TYPE_RGBA, false, {255, 0, 51, 3}};
  EXPECT_THAT(read(alpha, 1).pixels, testing::Pointwise(testing::FloatNear(1e-6f), {1.0f, 0.0f, 0.2f}));
  const Png deep{1, 1, 16, PNG_COLOR_TYPE_RGB, false, {0xff, 0xff, 0x80, 0x00, 0x00, 0x01}};
  EXPECT_THAT(read(deep, 1).pixels,
              testing::Pointwise(testing::FloatNear(1e-7f), {1.0f, 32768 / 65535.0f, 1 / 65535.0f}));
}

TEST_F(PngFiles, InterlacedOnesAreTheSame) {
  Png png{13, 11, 8, PNG_COLOR_TYPE_RGB, false, ramp(429)};
  const Image plain = read(png);
  png.interlaced = true;
  EXPECT_EQ(read(png).pixels, plain.pixels);
}

std::string error(const std::string& path) {
  try {
    read_encoded_image(path, 0);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST_F(PngFiles, ThatClaimMoreThanTheyHoldAreRefused) {
  Png png;
  png.data = ramp(18);
  png.write(path_);
  std::string bytes = read_file(path_);
  const auto claim = [&](std::uint32_t width, std::uint32_t height) {
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[16 + i] = static_cast<char>(width >> (24 - 8 * i));
      bytes[20 + i] = static_cast<char>(height >> (24 - 8 * i));
    }
    const auto* from = reinterpret_cast<const png_byte*>(bytes.data()) + 12;
    std::uint32_t crc = 0xffffffffu;  // of the chunk's name and data
    for (int i = 0; i < 17; ++i) {
      crc ^= from[i];
      for (int k = 0; k < 8; ++k) crc = crc & 1 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
    for (std::size_t i = 0; i < 4; ++i) bytes[29 + i] = static_cast<char>(~crc >> (24 - 8 * i));
    std::ofstream(path_, std::ios::binary) << bytes;
    return error(path_);
  };
  EXPECT_EQ(claim(3, 2), "no error");
  EXPECT_THAT(claim(8000, 8000), HasSubstr("it is too short for its size"));
  EXPECT_THAT(claim(100000, 100000), HasSubstr("it has more than 67108864 pixels"));
  EXPECT_THAT(claim(3, 3), HasSubstr("cannot be read"));
  std::ofstream(path_, std::ios::binary).close();
  EXPECT_THAT(error(path_), HasSubstr("ends too early"));
  EXPECT_THAT(error(folder_.file("none.png")), HasSubstr("No such file"));
  EXPECT_THAT(error(folder_.file("a.jpg")), HasSubstr("pictures are read from .exr, .pfm and .png files"));
}

// libpng would make room for the 2 GiB that a text's length claims.
TEST_F(PngFiles, AChunkLongerThanTheFileIsRefused) {
  Png png;
  png.data = ramp(18);
  png.write(path_);
  const std::string good = read_file(path_), text("\x7f\x7f\xff\xfftEXtabc", 11);
  write_bytes_to(path_, good.substr(0, 33) + text + good.substr(33));  // behind the header
  const std::int64_t before = peak_memory();
  EXPECT_THAT(error(path_), HasSubstr("a.png: error: cannot be read: the file ends too early"));
  EXPECT_LT(peak_memory() - before, 1 << 28);
}

// Every truncation, and random changes: read or refused with the file's name, no more.
TEST_F(PngFiles, DamagedOnesAreReadOrRefused) {
  Png png{13, 11, 8, PNG_COLOR_TYPE_RGB, true, ramp(429)};
  png.write(path_);
  const std::string good = read_file(path_), damaged = folder_.file("b.png");
  std::mt19937 random(20240501);
  int refused = 0;
  const auto attempt = [&](const std::string& bytes) {
    std::ofstream(damaged, std::ios::binary) << bytes;
    try {
      read_encoded_image(damaged, 0);
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr(damaged));
      ++refused;
    }
    std::filesystem::remove(damaged);  // writing over a file would wait for the disk
  };
  for (std::size_t size = 0; size < good.size(); ++size) attempt(good.substr(0, size));
  EXPECT_EQ(refused, static_cast<int>(good.size()));
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = good;
    for (auto edits = 1 + random() % 3; edits > 0; --edits) {
      const std::size_t at = random() % bytes.size();
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
    }
    attempt(bytes);
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace brume

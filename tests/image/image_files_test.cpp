// Pictures in files: values and metadata survive, damage is an error and nothing else.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <limits>
#include <set>

#include "base/diagnostics.h"
#include "image/exr_header.h"
#include "image/image.h"
#include "image/temporary_folder.h"

namespace brume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Image test_image(int width, int height) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height * 3; ++i) image.pixels.push_back(0.01f * static_cast<float>(i) - 0.05f);
  return image;
}

ImageMetadata test_metadata() {
  ImageMetadata m;
  m.samples_per_pixel = 16;
  m.render_time_seconds = 2.5;
  m.camera_from_world = translate({1, 2, 3}) * rotate(30, {0, 1, 0});
  m.ndc_from_world = {{{1, 2, 3, 4}, {5, 6, 7, 8}, {0, 0, 0, 1}, {0, 0, 1, 0}}};
  m.seed = 4000000000u;
  m.partial = true;
  m.half = false;
  m.software = "Brume";
  return m;
}

TEST(ImageFiles, FloatsSurviveInExrAndPfm) {
  const TemporaryFolder folder;
  const Image image = test_image(19, 33);  // more than two blocks of ZIP's 16 rows
  for (const char* name : {"a.exr", "a.pfm"}) {
    write_image(folder.file(name), image, test_metadata());
    const Image back = read_image(folder.file(name));
    EXPECT_EQ(back.width, 19);
    EXPECT_EQ(back.height, 33);
    EXPECT_EQ(back.pixels, image.pixels) << name;
  }
}

// An .exr keeps the pixels and says what they are; a .png holds the same light in sRGB. 0.5 grey is 188.
TEST(ImageFiles, ColourSpacesAreToldOrTurnedIntoSrgb) {
  const TemporaryFolder folder;
  ImageMetadata metadata = test_metadata();
  metadata.colour_space = ColourSpace::aces2065_1;
  const Vector3 aces = inverse(rec709_from(ColourSpace::aces2065_1, Whites::kept)) * Vector3{0.5, 0.5, 0.5};
  const Image image{1, 1, {static_cast<float>(aces.x), static_cast<float>(aces.y), static_cast<float>(aces.z)}};
  write_image(folder.file("a.exr"), image, metadata);
  EXPECT_EQ(read_image(folder.file("a.exr")).pixels, image.pixels);
  const Imf::InputFile file(folder.file("a.exr").c_str());
  ASSERT_TRUE(Imf::hasChromaticities(file.header()));
  EXPECT_FLOAT_EQ(Imf::chromaticities(file.header()).red.x, 0.7347f);
  EXPECT_FLOAT_EQ(Imf::chromaticities(file.header()).white.y, 0.33767f);
  write_image(folder.file("a.png"), image, metadata);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&png, folder.file("a.png").c_str()));
  png.format = PNG_FORMAT_RGB;
  std::uint8_t values[3] = {};
  ASSERT_TRUE(png_image_finish_read(&png, nullptr, values, 0, nullptr));
  for (const std::uint8_t value : values) EXPECT_EQ(value, 188);
}

TEST(ImageFiles, TheVarianceIsALayerOfFloatsInExr) {
  const TemporaryFolder folder;
  Image image = test_image(3, 20);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.variance.push_back(1e-7f * static_cast<float>(i + 1));
  ImageMetadata metadata = test_metadata();
  for (const bool half : {false, true}) {
    metadata.half = half;
    write_image(folder.file("a.exr"), image, metadata);
    const Image back = read_image(folder.file("a.exr"));
    EXPECT_EQ(back.variance, image.variance);
    EXPECT_NEAR(back.pixels[3], image.pixels[3], 1e-4);
    const Imf::InputFile file(folder.file("a.exr").c_str());
    std::set<std::string> layers;
    file.header().channels().layers(layers);
    EXPECT_THAT(layers, ElementsAre("Variance"));
  }
  // The others hold the colours only.
  write_image(folder.file("a.pfm"), image, metadata);
  EXPECT_EQ(read_image(folder.file("a.pfm")).pixels, image.pixels);
  EXPECT_THAT(read_image(folder.file("a.pfm")).variance, IsEmpty());
}

TEST(ImageFiles, AlphaAndDepthAreChannelsInExr) {
  const TemporaryFolder folder;
  Image image = test_image(3, 20);
  for (int i = 0; i < 60; ++i) {
    image.alpha.push_back(static_cast<float>(i) / 64);
    image.depth.push_back(1e6f + static_cast<float>(i));  // more than a half holds
  }
  image.depth[7] = std::numeric_limits<float>::infinity();
  ImageMetadata metadata = test_metadata();
  for (const bool half : {false, true}) {
    metadata.half = half;
    write_image(folder.file("a.exr"), image, metadata);
    const Image back = read_image(folder.file("a.exr"));
    EXPECT_EQ(back.alpha, image.alpha);
    EXPECT_EQ(back.depth, image.depth);
    const Imf::InputFile file(folder.file("a.exr").c_str());
    EXPECT_EQ(file.header().channels()["A"].type, half ? Imf::HALF : Imf::FLOAT);
    EXPECT_EQ(file.header().channels()["Z"].type, Imf::FLOAT);
  }
}

TEST(ImageFiles, HalvesAreRoundedAndStayFinite) {
  const TemporaryFolder folder;
  Image image{2, 1, {0.1f, 1e6f, -1e6f, 65504, 1, 0}};
  ImageMetadata metadata = test_metadata();
  metadata.half = true;
  write_image(folder.file("a.exr"), image, metadata);
  const Image back = read_image(folder.file("a.exr"));
  EXPECT_NEAR(back.pixels[0], 0.1f, 0.1f / 2048);
  EXPECT_THAT(std::vector<float>(back.pixels.begin() + 1, back.pixels.end()), ElementsAre(65504, -65504, 65504, 1, 0));
  EXPECT_TRUE(read_image_metadata(folder.file("a.exr")).half);
}

TEST(ImageFiles, ExrKeepsMetadata) {
  const TemporaryFolder folder;
  const ImageMetadata m = test_metadata();
  write_image(folder.file("a.exr"), test_image(2, 2), m);
  const ImageMetadata back = read_image_metadata(folder.file("a.exr"));
  EXPECT_EQ(back.samples_per_pixel, m.samples_per_pixel);
  EXPECT_EQ(back.render_time_seconds, m.render_time_seconds);
  EXPECT_EQ(back.seed, m.seed);
  EXPECT_EQ(back.partial, m.partial);
  EXPECT_EQ(back.half, m.half);
  EXPECT_EQ(back.software, m.software);
  EXPECT_EQ(back.ndc_from_world, m.ndc_from_world);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(back.camera_from_world.m[i][j], m.camera_from_world.m[i][j], 1e-6);
}

// By OpenEXR's own means, and as its documentation has it: "multiply the 3D point by the worldToNDC matrix".
TEST(ImageFiles, ExrMatricesActOnRowVectors) {
  const TemporaryFolder folder;
  const ImageMetadata m = test_metadata();
  write_image(folder.file("a.exr"), test_image(2, 2), m);
  const Imf::InputFile file(folder.file("a.exr").c_str());
  EXPECT_EQ(file.header().displayWindow(), file.header().dataWindow());
  EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
  const auto* matrix = file.header().findTypedAttribute<Imf::M44fAttribute>("worldToCamera");
  ASSERT_TRUE(matrix);
  const Imath::V3f p_camera = Imath::V3f(0.5f, -1, 2) * matrix->value();
  const Vector3 expected = m.camera_from_world.point({0.5, -1, 2});
  EXPECT_NEAR(p_camera.x, expected.x, 1e-6);
  EXPECT_NEAR(p_camera.y, expected.y, 1e-6);
  EXPECT_NEAR(p_camera.z, expected.z, 1e-6);
}

// A part of a larger picture says where it lies; the others are whole.
TEST(ImageFiles, ExrHeaderAsText) {
  const TemporaryFolder folder;
  write_image(folder.file("a.exr"), test_image(2, 3), test_metadata());
  const ExrHeader header = read_exr_header(folder.file("a.exr"));
  EXPECT_THAT(header.data_window, ElementsAre(0, 0, 1, 2));
  EXPECT_THAT(header.channels, ElementsAre(std::pair("B", "float"), std::pair("G", "float"), std::pair("R", "float")));
  const auto value = [&](const std::string& name) {
    for (const ExrAttribute& a : header.attributes)
      if (a.name == name) return a.type + " " + a.value;
    return std::string("none");
  };
  EXPECT_EQ(value("seed"), "string 4000000000");
  EXPECT_EQ(value("samplesPerPixel"), "int 16");
  EXPECT_EQ(value("renderTimeSeconds"), "float 2.5");
  EXPECT_EQ(value("worldToNDC"), "m44f (1 5 0 0) (2 6 0 0) (3 7 0 1) (4 8 1 0)");
  EXPECT_EQ(value("compression"), "none");
}

TEST(ImageFiles, ExrOfAPartHasItsPlace) {
  const TemporaryFolder folder;
  Image image = test_image(3, 20);
  image.variance = image.pixels;
  ImageMetadata metadata = test_metadata();
  metadata.x = 5;
  metadata.y = 7;
  metadata.whole_width = 64;
  metadata.whole_height = 48;
  for (const bool half : {false, true}) {
    metadata.half = half;
    write_image(folder.file("a.exr"), image, metadata);
    const Imf::InputFile file(folder.file("a.exr").c_str());
    EXPECT_EQ(file.header().displayWindow(), Imath::Box2i({0, 0}, {63, 47}));
    EXPECT_EQ(file.header().dataWindow(), Imath::Box2i({5, 7}, {7, 26}));
    const Image back = read_image(folder.file("a.exr"));
    EXPECT_EQ(back.width, 3);
    EXPECT_EQ(back.height, 20);
    EXPECT_EQ(back.variance, image.variance);
    EXPECT_FLOAT_EQ(back.pixels.back(), half ? 1.7402344f : image.pixels.back());
    const ImageMetadata read = read_image_metadata(folder.file("a.exr"));
    EXPECT_EQ(read.x, 5);
    EXPECT_EQ(read.y, 7);
    EXPECT_EQ(read.whole_width, 64);
    EXPECT_EQ(read.whole_height, 48);
  }
  write_image(folder.file("b.exr"), image, test_metadata());
  EXPECT_EQ(read_image_metadata(folder.file("b.exr")).whole_width, 0);
}

TEST(Srgb, MatchesTheStandard) {
  EXPECT_EQ(srgb_from_linear(0), 0);
  EXPECT_EQ(srgb_from_linear(1), 255);
  EXPECT_EQ(srgb_from_linear(-3), 0);
  EXPECT_EQ(srgb_from_linear(7), 255);
  EXPECT_EQ(srgb_from_linear(std::numeric_limits<float>::infinity()), 255);
  EXPECT_EQ(srgb_from_linear(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(srgb_from_linear(0.18f), 118);  // middle grey
  EXPECT_EQ(srgb_from_linear(0.5f), 188);
  EXPECT_EQ(srgb_from_linear(0.002f), 7);  // the linear part: 12.92 * 0.002 * 255 = 6.59
  // Every code decodes to a value that encodes to it.
  for (int code = 0; code < 256; ++code) {
    const double v = code / 255.0, linear = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    EXPECT_EQ(srgb_from_linear(static_cast<float>(linear)), code);
  }
}

TEST(ImageFiles, PngIsSrgb) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.png");
  write_image(path, Image{2, 2, {0, 0.18f, 1, 2, -1, 0.5f, 1, 0, 0, 0, 1, 0}}, test_metadata());

  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&png, path.c_str()));
  EXPECT_EQ(png.width, 2u);
  EXPECT_EQ(png.height, 2u);
  png.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> values(PNG_IMAGE_SIZE(png));
  ASSERT_TRUE(png_image_finish_read(&png, nullptr, values.data(), 0, nullptr));
  EXPECT_THAT(values, ElementsAre(0, 118, 255, 255, 0, 188, 255, 0, 0, 0, 255, 0));

  const std::string bytes = bytes_of(path);
  EXPECT_THAT(bytes, HasSubstr("sRGB"));
  EXPECT_THAT(bytes, HasSubstr("16 samples per pixel"));
  EXPECT_THAT(bytes, HasSubstr("partial"));
}

TEST(ImageFiles, UnknownSuffixesAreRefused) {
  const TemporaryFolder folder;
  const std::string message = error_of([&] { write_image(folder.file("a.jpg"), test_image(1, 1), {}); });
  EXPECT_THAT(message, HasSubstr(".jpg"));
  EXPECT_THAT(message, HasSubstr(image_suffixes));
  EXPECT_THAT(error_of([&] { write_image(folder.file("a"), test_image(1, 1), {}); }), HasSubstr("no suffix"));
  EXPECT_THAT(error_of([&] { read_image(folder.file("a.png")); }), HasSubstr(".exr and .pfm"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(ImageFiles, GreyAndBigEndianPfm) {
  const TemporaryFolder folder;
  // 1.0 and 2.0 in big-endian bytes, bottom row first, with scale 2.
  const std::string values{"\x3f\x80\x00\x00\x40\x00\x00\x00", 8};
  write_bytes_to(folder.file("a.pfm"), "Pf\n1 2\n2.0\n" + values);
  EXPECT_THAT(read_image(folder.file("a.pfm")).pixels, ElementsAre(4, 4, 4, 2, 2, 2));
}

TEST(ImageFiles, DamagedPfmIsAnError) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.pfm");
  for (const char* header :
       {"", "P6\n1 1\n-1\n", "PF\n", "PF\n0 1\n-1\n", "PF\n-1 1\n-1\n", "PF\n1 1\nnan\n", "PF\n1 1\n0\n",
        "PF\n2147483647 2147483647\n-1\n", "PF\n99999999999 1\n-1\n", "PF\n2 1\n-1\n", "PF\n1x 1\n-1\n"}) {
    write_bytes_to(path, header + std::string(12, 'a'));
    EXPECT_NE(error_of([&] { read_image(path); }), "no error") << header;
  }
}

// Every truncation of a file, and every byte of its header changed in turn, is read or refused, no more.
TEST(ImageFiles, DamagedExrIsAnErrorOrAPicture) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.exr"), damaged = folder.file("b.exr");
  Image image = test_image(5, 20);
  image.variance = image.pixels;
  image.alpha = image.depth = std::vector<float>(100, 0.25f);
  write_image(path, image, test_metadata());
  const std::string bytes = bytes_of(path);
  int refused = 0;
  const auto try_reading = [&](const std::string& content) {
    write_bytes_to(damaged, content);
    try {
      read_exr_header(damaged);
      read_image(damaged);
      read_image_metadata(damaged);
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr(damaged));
      ++refused;
    }
  };
  for (std::size_t length = 0; length < bytes.size(); length += 3) try_reading(bytes.substr(0, length));
  EXPECT_GT(refused, static_cast<int>(bytes.size()) / 3 - 20);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string content = bytes;
    content[i] = static_cast<char>(content[i] ^ 0x7f);
    try_reading(content);
  }
}

// A header of 2^30 x 2^30 pixels must not make us allocate them.
TEST(ImageFiles, AnExrThatClaimsTooMuchIsRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.exr");
  write_image(path, test_image(5, 20), test_metadata());
  std::string bytes = bytes_of(path);
  const std::size_t window = bytes.find("dataWindow") + 11 + 6 + 4;  // name, type "box2i", size
  bytes.replace(window + 8, 8, std::string("\xff\xff\x00\x00\xff\xff\x00\x00", 8));
  write_bytes_to(path, bytes);
  EXPECT_NE(error_of([&] { read_image(path); }), "no error");
}

// 3 MB could be 2^28 pixels of one colour, which take 3 GB.
TEST(ImageFiles, AnExrOfMoreThanItsBytesAreWorthIsRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.exr");
  write_image(path, test_image(5, 20), test_metadata());
  std::string bytes = bytes_of(path);
  const std::size_t window = bytes.find("dataWindow") + 11 + 6 + 4;  // name, type "box2i", size
  bytes.replace(window + 8, 8, std::string("\xff\x3f\0\0\xff\x3f\0\0", 8));
  bytes.resize(3'000'000);
  write_bytes_to(path, bytes);
  EXPECT_THAT(error_of([&] { read_image(path); }), HasSubstr("its header gives a size that the file cannot hold"));
}

// OpenEXR has no name for what it reads from memory.
TEST(ImageFiles, ErrorsOfOpenExrNameNoOtherFile) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.exr");
  write_image(path, test_image(5, 20), test_metadata());
  std::string bytes = bytes_of(path);
  const std::size_t compression = bytes.find("compression") + 12 + 12 + 4;  // name, type "compression", size
  bytes[compression] = 99;
  write_bytes_to(path, bytes);
  const std::string error = error_of([&] { read_image(path); });
  EXPECT_THAT(error, HasSubstr("a.exr: error: cannot be read: "));
  EXPECT_THAT(error, testing::Not(HasSubstr("\"\"")));
}

TEST(ImageFiles, ASingleColourCompressesAndIsReadBack) {
  const TemporaryFolder folder;
  const Image image{2000, 2000, std::vector<float>(2000 * 2000 * 3, 0.5f)};
  ImageMetadata metadata = test_metadata();
  metadata.half = true;
  write_image(folder.file("a.exr"), image, metadata);
  EXPECT_EQ(read_image(folder.file("a.exr")).pixels, image.pixels);
}

}  // namespace
}  // namespace brume

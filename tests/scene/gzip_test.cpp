// Scenes compressed by gzip.
#include "base/gzip.h"

#include <zlib.h>

#include <random>

#include "scene_test.h"

namespace brume {
namespace {

std::string packed(const std::string& text) {
  z_stream z{};
  deflateInit2(&z, Z_BEST_COMPRESSION, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string bytes(deflateBound(&z, static_cast<uLong>(text.size())), '\0');
  std::string input = text;
  z.next_in = reinterpret_cast<Bytef*>(input.data());
  z.avail_in = static_cast<uInt>(input.size());
  z.next_out = reinterpret_cast<Bytef*>(bytes.data());
  z.avail_out = static_cast<uInt>(bytes.size());
  EXPECT_EQ(deflate(&z, Z_FINISH), Z_STREAM_END);
  bytes.resize(z.total_out);
  deflateEnd(&z);
  return bytes;
}

std::string sample_text() {
  std::mt19937 random(1);
  std::string text = "WorldBegin\n";
  for (int i = 0; i < 2000; ++i) text += "# " + std::to_string(random()) + "\n";
  return text;
}

TEST(Gzip, UnpacksWhatWasPacked) {
  const std::string text = sample_text();
  EXPECT_EQ(unpacked("a", packed(text)), text);
  EXPECT_EQ(unpacked("a", packed("")), "");
  EXPECT_EQ(unpacked("a", packed(text) + packed("more")), text + "more");  // pieces in a row
  EXPECT_EQ(unpacked("a", packed(std::string(1 << 20, ' '))), std::string(1 << 20, ' '));
  EXPECT_EQ(unpacked("a", text), text);
  EXPECT_EQ(unpacked("a", ""), "");
}

// A bomb ends where the limit is passed, before the text is whole; the peak shows that no more is held.
TEST(Gzip, NoMoreIsUnpackedThanTheLimit) {
  const std::string text = sample_text(), piece = packed(std::string(1 << 24, ' '));
  std::string bomb;  // of 512 MB
  for (int i = 0; i < 32; ++i) bomb += piece;
  EXPECT_EQ(unpacked("a", packed(text), text.size()), text);
  EXPECT_THROW(unpacked("a", packed(text), text.size() - 1), InputError);
  const std::int64_t before = peak_memory();
  try {
    unpacked("a.pbrt.gz", bomb, 1'000'000);
    ADD_FAILURE() << "nothing thrown";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "a.pbrt.gz: error: has more than 1000000 bytes of text, an eighth of the memory");
  }
  EXPECT_LT(peak_memory() - before, 1 << 27);
}

TEST(Gzip, DamagedFilesAreRefusedOrUnpackedToSomething) {
  const std::string good = packed(sample_text());
  std::mt19937 random(2);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  for (int i = 0; i < 300; ++i) {
    std::string bytes = good;
    if (i % 3 == 0)
      bytes.resize(2 + below(good.size() - 2));
    else
      bytes[2 + below(good.size() - 2)] = static_cast<char>(below(256));
    try {
      const std::string text = unpacked("damaged", bytes);
      EXPECT_NE(i % 3, 0) << "cut to " << bytes.size();
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("damaged: error: is compressed by gzip"), std::string::npos) << e.what();
    }
  }
}

TEST(Gzip, NamesOfScenes) {
  for (const char* name : {"a.pbrt", "a.PBRT", "a.pbrt.gz", "folder/a.b.pbrt.GZ", "-"})
    EXPECT_TRUE(is_scene_file(name)) << name;
  for (const char* name : {"", ".gz", "gz", "a.gz", "a.pbrt.bz2", "a.vdb.gz", "a.pbr", "--"})
    EXPECT_FALSE(is_scene_file(name)) << name;
}

}  // namespace
}  // namespace brume

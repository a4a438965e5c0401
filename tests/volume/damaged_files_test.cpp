// Damaged files give an InputError or a volume, and nothing else: no crash, no hang, no read out of bounds (which the
// build with sanitizers sees).
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "base/diagnostics.h"
#include "volume/formats.h"
#include "volume/make_vol.h"
#include "volume/write_files.h"

namespace brume {
namespace {

using List = std::vector<GridInfo> (*)(const std::string& file, std::string_view bytes);
using Read = VolumeGrid (*)(const std::string& file, std::string_view bytes, std::size_t index, GridReading reading);

struct Format {
  List list;
  Read read;
};
constexpr Format vdb{list_vdb, read_vdb}, nvdb{list_nvdb, read_nvdb}, vol{list_vol, read_vol};

// Whether all that can be read of the file was read.
bool survives(const Format& format, const std::string& bytes) {
  const std::vector<char> exact(bytes.begin(), bytes.end());  // ends where its memory does, for AddressSanitizer
  const std::string_view view(exact.data(), exact.size());
  try {
    const std::vector<GridInfo> infos = format.list("damaged", view);
    for (std::size_t i = 0; i < infos.size(); ++i) {
      if (infos[i].renderable) format.read("damaged", view, i, Storage::u16);
    }
    return true;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()), "");
    return false;
  }
}

void expect_truncations_refused(const Format& format, const std::string& good) {
  ASSERT_TRUE(survives(format, good));
  std::mt19937 random(11);
  for (int i = 0; i < 150; ++i) {
    const std::size_t most = i < 75 ? std::min<std::size_t>(good.size(), 2000) : good.size();
    const std::size_t length = std::uniform_int_distribution<std::size_t>(0, most - 1)(random);
    EXPECT_FALSE(survives(format, good.substr(0, length))) << "cut to " << length << " of " << good.size();
  }
}

// Half of the damage in the first 2000 bytes, where headers are; half of the rest where bytes are not 0.
void expect_flips_survived(const Format& format, const std::string& good, int trials) {
  std::mt19937 random(12);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  for (int i = 0; i < trials; ++i) {
    std::string bytes = good;
    const std::size_t flips = 1 + below(4);
    for (std::size_t f = 0; f < flips; ++f) {
      std::size_t at = below(i % 2 == 0 ? std::min<std::size_t>(2000, good.size()) : good.size());
      if (i % 4 == 1) {
        for (int tries = 0; tries < 1000 && bytes[at] == 0; ++tries) at = below(good.size());
      }
      bytes[at] = static_cast<char>(below(256));
    }
    survives(format, bytes);
  }
}

// Overwrites aligned and unaligned 64-bit words with numbers that make bad sizes and offsets.
void expect_odd_sizes_survived(const Format& format, const std::string& good, int trials) {
  std::mt19937 random(13);
  const std::int64_t odd[] = {-1,
                              1,
                              -20000,
                              20000,
                              64,
                              INT64_MAX,
                              INT64_MIN,
                              std::int64_t{1} << 40,
                              -(std::int64_t{1} << 40),
                              0xffffffff,
                              INT64_MIN + 32};
  for (int i = 0; i < trials; ++i) {
    std::string bytes = good;
    std::size_t at = 0;
    std::int64_t old = 0;
    for (int tries = 0; tries < 2000 && (old <= 0 || old > 100000); ++tries) {  // what looks like a size or an offset
      at = std::uniform_int_distribution<std::size_t>(0, good.size() - 8)(random);
      std::memcpy(&old, good.data() + at, 8);
    }
    std::memcpy(bytes.data() + at, &odd[std::uniform_int_distribution<std::size_t>(0, std::size(odd) - 1)(random)], 8);
    survives(format, bytes);
  }
}

class DamagedFiles : public testing::TestWithParam<VdbPacking> {
 protected:
  static VdbOptions options() {
    VdbOptions options;
    options.packing = GetParam();
    return options;
  }
};
INSTANTIATE_TEST_SUITE_P(All, DamagedFiles, testing::Values(VdbPacking::none, VdbPacking::zip, VdbPacking::blosc));

TEST_P(DamagedFiles, Vdb) {
  const std::string path = temporary_file("damaged.vdb");
  write_vdb(path, options());
  const std::string good = read_bytes(path);
  expect_truncations_refused(vdb, good);
  expect_flips_survived(vdb, good, 300);
  expect_odd_sizes_survived(vdb, good, 200);
}

TEST_P(DamagedFiles, Nvdb) {
  for (const NvdbValues values : {NvdbValues::float32, NvdbValues::fpn}) {
    const std::string path = temporary_file("damaged.nvdb");
    write_nvdb(path, options(), values);
    const std::string good = read_bytes(path);
    expect_truncations_refused(nvdb, good);
    expect_flips_survived(nvdb, good, 200);
    expect_odd_sizes_survived(nvdb, good, 100);
  }
}

TEST(DamagedFiles, Vol) {
  for (const int encoding : {1, 2, 3}) {
    const std::string good = make_vol(encoding, {9, 5, 17}, 1);
    expect_truncations_refused(vol, good);
    expect_flips_survived(vol, good, 300);
    expect_odd_sizes_survived(vol, good, 200);
    for (std::size_t at = 0; at < 48; ++at) {
      std::string bytes = good;
      bytes.replace(at, 4, "\xff\xff\xff\x7f");
      survives(vol, bytes);
    }
  }
}

// A name of 4 GiB, a tree of 2^32 nodes: sizes are checked before memory is taken for them.
TEST(DamagedFiles, HugeCountsAreRefused) {
  const std::string path = temporary_file("huge.vdb");
  write_vdb(path, {});
  const std::string good = read_bytes(path);
  for (std::size_t at = 12; at < 1200; at += 1) {
    std::string bytes = good;
    bytes.replace(at, 4, "\xff\xff\xff\xff");
    survives(vdb, bytes);
  }
}

}  // namespace
}  // namespace brume

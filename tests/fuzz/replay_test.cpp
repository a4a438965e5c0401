// The corpus of the fuzzers, and each of its files damaged in a few ways, through the same targets without a fuzzer.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "base/file.h"
#include "fuzz/targets.h"

namespace brume {
namespace {

std::vector<std::string> corpus(const FuzzTarget& target) {
  std::vector<std::string> paths, all;
  const std::filesystem::path folder = std::filesystem::path(FUZZ_TESTS) / "corpus" / target.name;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  for (const std::string& path : paths) all.push_back(read_file(path));
  return all;
}

TEST(FuzzReplay, TheCorpusDoesNoHarm) {
  for (const FuzzTarget& target : fuzz_targets()) {
    const std::vector<std::string> all = corpus(target);
    EXPECT_GE(all.size(), 2u) << target.name;
    for (const std::string& bytes : all) EXPECT_NO_THROW(target.run(bytes)) << target.name;
  }
}

TEST(FuzzReplay, NorDoesWhatIsLeftOfItOrWrongWithIt) {
  std::mt19937 random(5);
  for (const FuzzTarget& target : fuzz_targets())
    for (const std::string& bytes : corpus(target))
      for (int i = 0; i < 60; ++i) {
        std::string damaged = bytes;
        if (i % 3 == 0) damaged.resize(random() % (bytes.size() + 1));
        for (int k = 0; k < i % 4 && !damaged.empty(); ++k)
          damaged[random() % damaged.size()] = static_cast<char>(random());
        EXPECT_NO_THROW(target.run(damaged)) << target.name << " " << i;
      }
}

}  // namespace
}  // namespace brume

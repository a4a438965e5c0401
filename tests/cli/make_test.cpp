// brume make: procedural volumes as files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/run_program.h"
#include "image/temporary_folder.h"
#include "volume/read_volume.h"

namespace brume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Make, WritesAVolumeThatRenders) {
  const TemporaryFolder folder;
  const Outcome made =
      run(folder.path(), {"make", "smoke", "--size", "40", "--seed", "3", "--set", "turbulence=0.9", "-o", "a.vdb"});
  EXPECT_EQ(made.exit_code, 0) << made.error;
  EXPECT_THAT(made.error, HasSubstr("a.vdb: grid density, 20 x 40 x 20 voxels"));
  EXPECT_THAT(folder.names(), ElementsAre("a.vdb"));
  const std::vector<GridInfo> grids = list_grids(folder.file("a.vdb"));
  ASSERT_EQ(grids.size(), 1u);
  EXPECT_EQ(grids[0].type, "float");
  EXPECT_TRUE(grids[0].renderable);
  EXPECT_EQ(run(folder.path(), {"a.vdb", "--spp", "1", "--resolution", "9x9", "--quiet"}).exit_code, 0);
}

TEST(Make, AFireHasTemperatures) {
  const TemporaryFolder folder;
  EXPECT_EQ(run(folder.path(), {"make", "fire", "--size", "32", "--half", "-o", "f.vdb", "--quiet"}).error, "");
  const std::vector<GridInfo> grids = list_grids(folder.file("f.vdb"));
  ASSERT_EQ(grids.size(), 2u);
  EXPECT_EQ(grids[0].name, "density");
  EXPECT_EQ(grids[1].name, "temperature");
  EXPECT_EQ(grids[1].type, "half");
}

TEST(Make, TheSameForAnyNumberOfThreadsAndNotForAnotherSeed) {
  const TemporaryFolder folder;
  const auto made = [&](const std::string& threads, const std::string& seed) {
    run(folder.path(), {"make", "fog", "--size", "24", "--nthreads", threads, "--seed", seed, "-o", "a.vdb"});
    return bytes_of(folder.file("a.vdb"));
  };
  EXPECT_EQ(made("1", "5"), made("3", "5"));
  EXPECT_NE(made("1", "5"), made("1", "6"));
}

TEST(Make, HelpNamesEveryKindAndParameter) {
  const TemporaryFolder folder;
  const Outcome help = run(folder.path(), {"make", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* word : {"cloud", "smoke", "fog", "fire", "turbulence", "spread", "height", "patchiness", "billows",
                           "1000 to 3000 K", "default 2000", "--half", "--set", "brume make smoke"})
    EXPECT_THAT(help.out, HasSubstr(word));
}

TEST(Make, MistakesAreNamedAndNothingIsWritten) {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{}, "needs the kind of volume"},
      {{"smoke"}, "needs a file to write, as in -o smoke.vdb"},
      {{"smok", "-o", "a.vdb"}, "unknown kind of volume \"smok\"; did you mean smoke?"},
      {{"lava", "-o", "a.vdb"}, "known are cloud, smoke, fog, fire"},
      {{"smoke", "-o", "a.nvdb"}, "volumes are written as .vdb"},
      {{"smoke", "-o", "missing/a.vdb"}, "there is no folder missing"},
      {{"smoke", "-o", "a.vdb", "--size", "7"}, "--size: \"7\" is not a whole number from 8 to 2048"},
      {{"smoke", "-o", "a.vdb", "--set", "spread"}, "--set \"spread\" is not NAME=VALUE"},
      {{"smoke", "-o", "a.vdb", "--set", "spread=wide"}, "what follows = is not a number"},
      {{"smoke", "-o", "a.vdb", "--set", "spread=nan"}, "what follows = is not a number"},
      {{"smoke", "-o", "a.vdb", "--set", "spread=2"}, "spread of smoke must be from 0 to 1, found 2"},
      {{"smoke", "-o", "a.vdb", "--set", "spred=1"}, "smoke has no parameter \"spred\"; did you mean spread?"},
      {{"fog", "-o", "a.vdb", "--set", "spread=1"}, "fog has no parameter \"spread\"; known are height, patchiness"},
      {{"fog", "-o", "a.vdb", "--haf"}, "did you mean --half?"},
  };
  for (const auto& [arguments, message] : cases) {
    std::vector<std::string> all{"make"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run(folder.path(), all);
    EXPECT_EQ(outcome.exit_code, 1) << message;
    EXPECT_THAT(outcome.error, HasSubstr(message));
    EXPECT_THAT(outcome.out, IsEmpty());
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace brume

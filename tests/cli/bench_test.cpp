// brume bench, with a small cloud and little time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "cli/run_program.h"
#include "image/temporary_folder.h"
#include "lanes/instruction_set.h"

namespace brume {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

Outcome bench(std::vector<std::string> arguments) {
  const TemporaryFolder folder;
  arguments.insert(arguments.begin(), {"bench", "--time", "0.01", "--size", "24"});
  return run(folder.path(), arguments);
}

// Lines for each instruction set and storage of the first size, and for the other volumes, each with a rate above 0.
TEST(Bench, PrintsATable) {
  const Outcome outcome = bench({"--size", "32", "--sparse", "40"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.error, IsEmpty());
  EXPECT_THAT(outcome.out, HasSubstr("one thread\n\n| measured | volume | storage | instruction set |"));
  const auto lines = [&](const std::string& pattern) {
    const std::regex line(pattern);
    return std::distance(std::sregex_iterator(outcome.out.begin(), outcome.out.end(), line), {});
  };
  const std::string rate = R"(\| (?!0\.0 )[0-9.]+ \|\n)";
  for (const InstructionSet& set : available_instruction_sets())
    for (const char* bits : {"8", "16", "32"})
      EXPECT_EQ(lines("tracking, events \\| 24 \\| " + std::string(bits) + " bits \\| " + std::string(set.title) + " " +
                      rate),
                1)
          << set.title << bits;
  EXPECT_EQ(lines("\\| 32 \\| 16 bits "), 3);
  EXPECT_EQ(lines("tracking, events \\| 40 sparse \\| 16 bits \\| [^|]+ " + rate), 1);
  EXPECT_EQ(lines("paths, events \\| 40 sparse \\| 16 bits \\| [^|]+ " + rate), 1);
  EXPECT_EQ(lines("marching, look-ups \\| 40 sparse \\| 16 bits \\| [^|]+ " + rate), 1);
  EXPECT_EQ(lines("surface rays, rays \\| - \\| - \\| - " + rate), 1);
}

TEST(Bench, PrintsJson) {
  const Outcome outcome = bench({"--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, StartsWith("{\"machine\": \""));
  EXPECT_THAT(outcome.out, HasSubstr("{\"measured\": \"tracking\", \"unit\": \"events\", \"volume\": \"24\", "
                                     "\"storage\": \"8 bits\", \"instruction_set\": \""));
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '{'),
            std::count(outcome.out.begin(), outcome.out.end(), '}'));
}

TEST(Bench, MistakesAreNamed) {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"bench", "--size", "7"}, "--size: \"7\" is not a whole number from 8 to 2048"},
      {{"bench", "--sparse", "4096"}, "--sparse: \"4096\" is not a whole number from 8 to 2048"},
      {{"bench", "--time", "0"}, "--time: \"0\" is not a number of seconds above 0"},
      {{"bench", "cloud.vdb"}, "unexpected argument \"cloud.vdb\""},
  };
  for (const auto& [arguments, message] : cases) {
    const Outcome outcome = run(folder.path(), arguments);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.error, HasSubstr(message));
  }
}

}  // namespace
}  // namespace brume

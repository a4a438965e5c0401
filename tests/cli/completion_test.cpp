// Completion in bash: what it offers for words typed so far.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "cli/run_program.h"
#include "image/temporary_folder.h"

namespace brume {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

// What is offered in `folder` for the last of the words, which follow the program's name.
std::vector<std::string> offered(const TemporaryFolder& folder, const std::string& words) {
  std::ofstream(folder.file("ask.sh")) << "cd '" << folder.path() << "'\n. '" << BRUME_COMPLETION << "'\n"
                                       << "COMP_WORDS=('" << BRUME_PROGRAM << "' " << words << ")\n"
                                       << "COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_brume\n"
                                       << "((${#COMPREPLY[@]})) && printf '%s\\n' \"${COMPREPLY[@]}\" > answer\n";
  const int status = std::system(("bash '" + folder.file("ask.sh") + "' > /dev/null 2>&1").c_str());
  EXPECT_GE(status, 0);
  std::istringstream answer(bytes_of(folder.file("answer")));
  std::remove(folder.file("answer").c_str());
  std::remove(folder.file("ask.sh").c_str());
  std::vector<std::string> lines;
  for (std::string line; std::getline(answer, line);) lines.push_back(line);
  return lines;
}

TEST(Completion, OffersCommandsAndFilesThatCanBeRendered) {
  const TemporaryFolder folder;
  for (const char* name : {"a.pbrt", "b c.vdb", "d.vol", "e.png", "f.exr"}) write_bytes_to(folder.file(name), "");
  EXPECT_THAT(offered(folder, "''"), UnorderedElementsAre("a.pbrt", "b c.vdb", "d.vol", "bench", "compare", "info",
                                                          "make", "phase", "render"));
  EXPECT_THAT(offered(folder, "inf"), ElementsAre("info"));
  EXPECT_THAT(offered(folder, "compare ''"), ElementsAre("f.exr"));
  EXPECT_THAT(offered(folder, "a.pbrt -o e"), ElementsAre("e.png"));
}

TEST(Completion, OffersTheOptionsOfTheCommand) {
  const TemporaryFolder folder;
  const std::vector<std::string> of_render = offered(folder, "a.pbrt -");
  for (const char* option : {"--output", "--spp", "--cropwindow", "--write-partial-images", "--variance"})
    EXPECT_THAT(of_render, Contains(option));
  EXPECT_THAT(offered(folder, "--vari"), ElementsAre("--variance"));
  EXPECT_THAT(offered(folder, "make smoke --ha"), ElementsAre("--half"));
  EXPECT_THAT(offered(folder, "make smoke -"), Not(Contains("--spp")));
  EXPECT_THAT(offered(folder, "a.pbrt --integrator c"), ElementsAre("classic"));
  EXPECT_THAT(offered(folder, "a.pbrt --spp ''"), IsEmpty());
}

TEST(Completion, OffersVolumesAndPhaseFunctionsWithTheirParameters) {
  const TemporaryFolder folder;
  EXPECT_THAT(offered(folder, "make ''"), ElementsAre("cloud", "smoke", "fog", "fire"));
  EXPECT_THAT(offered(folder, "make fog --set ''"), ElementsAre("height=", "patchiness="));
  EXPECT_THAT(offered(folder, "phase two"), ElementsAre("two_lobe"));
  EXPECT_THAT(offered(folder, "phase two_lobe ''"), ElementsAre("g1=", "g2=", "w="));
  EXPECT_THAT(offered(folder, "phase two_lobe g1 = ''"), IsEmpty());
  EXPECT_THAT(offered(folder, "phase isotropic ''"), IsEmpty());
}

}  // namespace
}  // namespace brume

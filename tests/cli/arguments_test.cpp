// Help, version and what happens with arguments that make no sense.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "cli/run_program.h"
#include "image/temporary_folder.h"

namespace brume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

void expect_narrow(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

TEST(Arguments, HelpFitsOnAScreen) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder.path(), {"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.error, IsEmpty());
  EXPECT_LT(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 24);
  expect_narrow(outcome.out);
  for (const char* command : {"render", "info", "make", "phase", "compare", "bench"}) {
    EXPECT_THAT(outcome.out, testing::ContainsRegex("brume \\[?" + std::string(command)));
    const std::string own = run(folder.path(), {command, "--help"}).out;
    EXPECT_THAT(own, testing::ContainsRegex("Usage: brume \\[?" + std::string(command)));
    EXPECT_THAT(own, testing::ContainsRegex("\n  brume [a-z]")) << "no example";
  }
}

TEST(Arguments, HelpOfRenderHasAllItsOptions) {
  const TemporaryFolder folder;
  const std::string help = run(folder.path(), {"render", "--help"}).out;
  expect_narrow(help);
  for (const char* word : {"--output",   "--spp",     "--time",        "--cropwindow",  "--write-partial-images",
                           "--seed",     "--quiet",   "--nthreads",    "--resolution",  "--integrator",
                           "--grid",     "--strict",  "--write-scene", "--variance",    "--version",
                           "--example",  "BRUME_ISA", ".pfm",          "--pixelbounds", "--quick",
                           "--exposure", "--stats ",  "--stats-json",  "--sanitize"})
    EXPECT_THAT(help, HasSubstr(word));
  EXPECT_EQ(run(folder.path(), {"a.pbrt", "--help"}).out, help);
}

TEST(Arguments, VersionNamesTheInstructionSets) {
  const TemporaryFolder folder;
  const Outcome best = run(folder.path(), {"--version"});
  EXPECT_EQ(best.exit_code, 0);
  EXPECT_THAT(best.out, StartsWith("Brume " BRUME_VERSION "\n"));
  EXPECT_THAT(best.out, HasSubstr("one lane"));
  const Outcome scalar = run(folder.path(), {"--version"}, {{"BRUME_ISA", "scalar"}});
  EXPECT_THAT(scalar.out, HasSubstr("In use: one lane"));
  const Outcome unknown = run(folder.path(), {"--version"}, {{"BRUME_ISA", "avx513"}});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_THAT(unknown.error, HasSubstr("avx513"));
  EXPECT_THAT(unknown.error, HasSubstr("scalar"));
}

struct BadArguments {
  std::vector<std::string> arguments;
  std::string message;
};

TEST(Arguments, MistakesAreNamedAndNothingIsWritten) {
  const TemporaryFolder folder;
  write_small_scene(folder.file("a.pbrt"));
  const std::vector<BadArguments> cases = {
      {{}, "a scene or a volume to render is missing"},
      {{"a.pbrt", "b.pbrt"}, "b.pbrt: error: cannot be read: No such file"},
      {{"a.pbrt", "b.vdb"}, "b.vdb: error: a volume is rendered on its own, or named by a scene"},
      {{"a.pbrt", "a.pbrt"}, "this WorldBegin is the second one"},
      {{"a.pbrt", "--sppp", "3"}, "unknown option --sppp, did you mean --spp?"},
      {{"a.pbrt", "--threads", "3"}, "did you mean --nthreads?"},
      {{"a.pbrt", "--spp"}, "--spp needs a value"},
      {{"a.pbrt", "--spp="}, "--spp needs a value"},
      {{"a.pbrt", "--spp", ""}, "--spp needs a value"},
      {{"a.pbrt", "--spp=", "4"}, "--spp needs a value"},
      {{"a.pbrt", "--spp", "1", "--spp", "2"}, "--spp is given twice"},
      {{"a.pbrt", "-o", "--quick"}, "--output needs a value"},
      {{"a.pbrt", "--quiet=maybe"}, "--quiet takes no value"},
      {{"rendr", "a.pbrt"}, "unknown command rendr, did you mean render?"},
      {{"a.pbrt", "--", "-b.pbrt"}, "-b.pbrt: error: cannot be read: No such file"},
      {{"a.pbrt", "--spp", "0"}, "--spp: \"0\" is not a whole number from 1"},
      {{"a.pbrt", "--spp", "-5"}, "--spp: \"-5\""},
      {{"a.pbrt", "--spp", "4.5"}, "--spp: \"4.5\""},
      {{"a.pbrt", "--spp", "99999999999999999999"}, "--spp"},
      {{"a.pbrt", "--time", "0"}, "--time: \"0\" is not a number of seconds above 0"},
      {{"a.pbrt", "--time", "soon"}, "--time: \"soon\""},
      {{"a.pbrt", "--time", "nan"}, "--time: \"nan\""},
      {{"a.pbrt", "--seed", "-1"}, "--seed: \"-1\" is not a whole number from 0 to 4294967295"},
      {{"a.pbrt", "--nthreads", "many"}, "--nthreads: \"many\""},
      {{"a.pbrt", "--resolution", "0x0"}, "--resolution: width: \"0\""},
      {{"a.pbrt", "--resolution", "16x-1"}, "--resolution: height: \"-1\""},
      {{"a.pbrt", "--resolution", "640"}, "is not WIDTHxHEIGHT"},
      {{"a.pbrt", "--resolution", "65536x65536"}, "65536x65536 is out of range"},
      {{"a.pbrt", "--cropwindow", "0,1,0"}, "is not X0,X1,Y0,Y1"},
      {{"a.pbrt", "--cropwindow", "0,1,0,1,"}, "is not X0,X1,Y0,Y1"},
      {{"a.pbrt", "--cropwindow", "0,1,0,nan"}, "0 <= y0 < y1 <= 1"},
      {{"a.pbrt", "--cropwindow", "0.5,0.5,0,1"}, "0 <= x0 < x1 <= 1"},
      {{"a.pbrt", "--cropwindow", "0,1.5,0,1"}, "crop window 0,1.5,0,1"},
      {{"a.pbrt", "--cropwindow", "0.01,0.02,0,1"}, "holds no pixel of the 16 x 12"},
      {{"a.pbrt", "--pixelbounds", "0,8,0,4.5"}, "is not X0,X1,Y0,Y1"},
      {{"a.pbrt", "--pixelbounds", "0,17,0,12"}, "0 <= x0 < x1 <= 16 and 0 <= y0 < y1 <= 12"},
      {{"a.pbrt", "--pixelbounds", "8,8,0,12"}, "pixel bounds 8,8,0,12"},
      {{"a.pbrt", "--pixelbounds", "-1,8,0,12"}, "pixel bounds -1,8,0,12"},
      {{"a.pbrt", "--pixelbounds", "0,17,0,12", "--resolution", "16x12"}, "the size of the picture"},
      {{"a.pbrt", "--pixelbounds", "0,8,0,8", "--cropwindow", "0,1,0,1"}, "only one can be given"},
      {{"a.pbrt", "--exposure", "bright"}, "--exposure: \"bright\" is not a number from -100 to 100"},
      {{"a.pbrt", "--exposure", "1", "-o", "x.exr"}, "--exposure needs a .png"},
      {{"a.pbrt", "--stats-json", "missing/s.json"}, "missing/s.json: error: cannot be written: there is no folder"},
      {{"a.pbrt", "--integrator", "clasic"}, "did you mean \"classic\"?"},
      {{"a.pbrt", "--grid", "density"}, "a.pbrt: error: not a volume file"},
      {{"a.pbrt", "--example"}, "--example takes no scene"},
      {{"--example", "--grid", "g"}, "--grid and --sanitize are for one volume file"},
      {{"a.pbrt", "-o", "x.jpg"}, ".exr, .png and .pfm"},
      {{"a.pbrt", "-o", "x"}, "no suffix"},
      {{"a.pbrt", "-o", "missing/x.png"}, "missing/x.png: error: cannot be written: there is no folder missing"},
      {{"missing.pbrt"}, "missing.pbrt: error: cannot be read: No such file"},
      {{"missing.vdb"}, "missing.vdb: error:"},
      {{"a.obj"}, "scenes are .pbrt or .pbrt.gz files, volumes .vdb, .nvdb or .vol"},
      {{"info", "a.obj"}, ".nvdb"},
      {{"info"}, "needs the name of a file"},
      {{"make", "clod", "-o", "a.vdb"}, "error: unknown kind of volume \"clod\"; did you mean cloud?"},
      {{"phase", "mie", "d=900"}, "error: d of mie must be from 0.1 to 50"},
  };
  for (const BadArguments& c : cases) {
    const Outcome outcome = run(folder.path(), c.arguments);
    const std::string shown = testing::PrintToString(c.arguments);
    EXPECT_EQ(outcome.exit_code, 1) << shown;
    EXPECT_THAT(outcome.error, HasSubstr(c.message)) << shown;
    EXPECT_THAT(outcome.error, HasSubstr("error: ")) << shown;
    EXPECT_THAT(outcome.out, IsEmpty()) << shown;
  }
  EXPECT_THAT(folder.names(), ElementsAre("a.pbrt"));
}

TEST(Arguments, SceneErrorsHaveTheirPlace) {
  const TemporaryFolder folder;
  write_bytes_to(folder.file("a.pbrt"), "WorldBegin\nShape \"sphere\" \"float radus\" 2\n");
  const Outcome outcome = run(folder.path(), {"a.pbrt", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.error, HasSubstr("a.pbrt:2:"));
  EXPECT_THAT(folder.names(), ElementsAre("a.pbrt"));
}

// Those of the text and those of the files that it names, in one go, each with a caret where the file or the grid is
// named.
TEST(Arguments, AllErrorsOfASceneAreShownAtOnce) {
  const TemporaryFolder folder;
  std::filesystem::copy(BRUME_TEST_FOLDER "/ellipsoid.vdb", folder.file("e.vdb"));
  write_bytes_to(folder.file("empty.vdb"), "");
  const std::string text = R"(WorldBegin
MakeNamedMedium "a" "string type" "vdb" "string filename" "e.vdb" "string gridname" "densty"
MakeNamedMedium "b" "string type" "vdb" "string filename" "empty.vdb"
Texture "t" "spectrum" "imagemap" "string filename" "none.png"
MediumInterface "a" ""
Shape "volume"
Material "interface"
MediumInterface "b" ""
Shape "sphere"
)";
  const std::string errors =
      R"(a.pbrt:2:85: error: e.vdb: has no grid "densty"; did you mean "density"? it has density (half, fog volume)
  MakeNamedMedium "a" "string type" "vdb" "string filename" "e.vdb" "string gridname" "densty"
                                                                                      ^
a.pbrt:3:59: error: empty.vdb: not an OpenVDB file: it does not begin with the format's mark
  MakeNamedMedium "b" "string type" "vdb" "string filename" "empty.vdb"
                                                            ^
a.pbrt:4:53: error: the image of Texture "t": none.png: cannot be read: No such file or directory
  Texture "t" "spectrum" "imagemap" "string filename" "none.png"
                                                      ^
)";
  write_bytes_to(folder.file("a.pbrt"), text);
  EXPECT_EQ(run(folder.path(), {"a.pbrt"}).error, errors);
  write_bytes_to(folder.file("a.pbrt"), text + "Shape \"sphere\" \"float radus\" 2\n");
  EXPECT_EQ(run(folder.path(), {"a.pbrt"}).error,
            errors + R"(a.pbrt:10:16: error: Shape "sphere" has no parameter "float radus"; did you mean "float radius"?
  Shape "sphere" "float radus" 2
                 ^
)");
}

TEST(Arguments, SeveralFilesAreOneScene) {
  const TemporaryFolder folder;
  write_bytes_to(folder.file("film.pbrt"), "Film \"rgb\" \"integer xresolution\" 3 \"integer yresolution\" 2\n");
  write_bytes_to(folder.file("world.pbrt"), "WorldBegin\nLightSource \"infinite\"\nWorldEnd\n");
  const Outcome outcome = run(folder.path(), {"film.pbrt", "world.pbrt", "--spp", "1", "-o", "x.pfm"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.error, HasSubstr("world.pbrt:3:1: warning: WorldEnd is no longer needed"));
  EXPECT_THAT(outcome.error, HasSubstr("3 x 2 pixels"));
  const Outcome strict = run(folder.path(), {"film.pbrt", "world.pbrt", "--strict", "-o", "y.pfm"});
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_THAT(strict.error, HasSubstr("world.pbrt:3:1: error: WorldEnd is no longer needed"));
}

TEST(Arguments, InfoDescribesAScene) {
  const TemporaryFolder folder;
  write_small_scene(folder.file("a.pbrt"));
  const Outcome outcome = run(folder.path(), {"info", "a.pbrt"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  for (const char* part :
       {"16 x 12 pixels", "2 samples", "classic", "2 x 2 x 2 voxels", "1 volume", "distant", "infinite"})
    EXPECT_THAT(outcome.out, HasSubstr(part));
}

}  // namespace
}  // namespace brume

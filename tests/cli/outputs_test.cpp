// What the program writes: the files asked for, the same bits whenever the same is asked, nothing else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "cli/run_program.h"
#include "image/image.h"
#include "image/temporary_folder.h"
#include "sanitized.h"

namespace brume {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Outputs : public testing::Test {
 protected:
  Outputs() { write_small_scene(folder_.file("a.pbrt")); }

  void expect_success(const std::vector<std::string>& arguments,
                      const std::map<std::string, std::string>& environment = {}) {
    const Outcome outcome = run(folder_.path(), arguments, environment);
    EXPECT_EQ(outcome.exit_code, 0) << testing::PrintToString(arguments) << outcome.error;
    EXPECT_THAT(outcome.out, IsEmpty());
    error_ = outcome.error;
  }
  std::string bytes(const std::string& name) const { return bytes_of(folder_.file(name)); }

  TemporaryFolder folder_;
  std::string error_;  // of the last run
};

TEST_F(Outputs, GoesToTheFileThatTheSceneNames) {
  expect_success({"a.pbrt"});
  EXPECT_THAT(folder_.names(), ElementsAre("a.pbrt", "named by scene.pfm"));
  EXPECT_THAT(error_, HasSubstr("named by scene.pfm: 16 x 12 pixels, 2 samples per pixel"));
}

TEST_F(Outputs, AWrittenSceneFindsItsPicturesFromAnotherFolder) {
  expect_success({"a.pbrt", "-o", "sky.exr", "--resolution", "8x8"});
  std::ofstream(folder_.file("lit.pbrt")) << R"(
    Film "rgb" "integer xresolution" 4 "integer yresolution" 4
    WorldBegin
    LightSource "infinite" "string filename" "sky.exr"
    Texture "t" "spectrum" "imagemap" "string filename" "sky.exr"
    Material "diffuse" "texture reflectance" "t"
    Shape "sphere")";
  std::filesystem::create_directory(folder_.file("else"));
  expect_success({"lit.pbrt", "--write-scene", "else/lit.pbrt"});
  expect_success({"else/lit.pbrt", "--spp", "1", "-o", "lit.pfm"});
  expect_success({"lit.pbrt", "--spp", "1", "-o", "again.pfm"});
  EXPECT_EQ(bytes("lit.pfm"), bytes("again.pfm"));
}

TEST_F(Outputs, ManyAtOnce) {
  expect_success(
      {"render", "a.pbrt", "-o", "ü b.exr", "--output", "b.png", "-o", "b.pfm", "--resolution", "8x4", "--seed", "7"});
  EXPECT_THAT(folder_.names(), ElementsAre("a.pbrt", "b.pfm", "b.png", "ü b.exr"));
  EXPECT_EQ(read_image(folder_.file("b.pfm")).width, 8);
  EXPECT_EQ(read_image(folder_.file("b.pfm")).height, 4);
  const ImageMetadata metadata = read_image_metadata(folder_.file("ü b.exr"));
  EXPECT_EQ(metadata.samples_per_pixel, 2);
  EXPECT_EQ(metadata.seed, 7u);
  EXPECT_FALSE(metadata.partial);
  EXPECT_THAT(metadata.software, HasSubstr("Brume"));
  // The camera looks from (0, 0, 5) at the origin: 5 in front of it, in the middle of the picture.
  EXPECT_NEAR(metadata.camera_from_world.point({0, 0, 0}).z, 5, 1e-5);
  ASSERT_TRUE(metadata.ndc_from_world);
  const auto& m = *metadata.ndc_from_world;
  EXPECT_NEAR(m[0][3] / m[3][3], 0.5, 1e-5);
  EXPECT_NEAR(m[1][3] / m[3][3], 0.5, 1e-5);
  // fov 30 degrees across the height of 4 pixels: a point at y = 5 tan 15 degrees is at the upper edge, v = 0.
  const double y = 5 * 0.2679491924311227;
  EXPECT_NEAR((m[1][1] * y + m[1][3]) / (m[3][1] * y + m[3][3]), 0, 1e-5);
}

TEST_F(Outputs, QuietSaysNothing) {
  expect_success({"a.pbrt", "--quiet", "-o", "b.pfm"});
  EXPECT_THAT(error_, IsEmpty());
}

TEST_F(Outputs, TheSameBitsForAnyNumberOfThreads) {
  expect_success({"a.pbrt", "--nthreads", "1", "-o", "one.pfm", "--resolution", "64x48"});
  expect_success({"a.pbrt", "--nthreads", "2", "-o", "two.pfm", "--resolution", "64x48"});
  expect_success({"a.pbrt", "--nthreads", "2", "-o", "other seed.pfm", "--resolution", "64x48", "--seed", "1"});
  EXPECT_EQ(bytes("one.pfm"), bytes("two.pfm"));
  EXPECT_NE(bytes("one.pfm"), bytes("other seed.pfm"));
}

// As many samples as fit, and the bits of a render with that number. The twin has one more.
TEST_F(Outputs, ATimeGivesThePictureOfItsNumberOfSamples) {
  expect_success({"a.pbrt", "--time", "0.3", "-o", "timed.pfm"});
  int samples = 0;
  ASSERT_EQ(std::sscanf(error_.c_str(), "timed.pfm: 16 x 12 pixels, %d samples per pixel, 0:0", &samples), 1) << error_;
  EXPECT_GE(samples, 1);
  expect_success({"a.pbrt", "--spp", std::to_string(samples), "-o", "counted.pfm"});
  EXPECT_EQ(bytes("timed.pfm"), bytes("counted.pfm"));
  expect_success({"a.pbrt", "--spp", std::to_string(samples + 1), "-o", "one more.pfm"});
  EXPECT_NE(bytes("timed.pfm"), bytes("one more.pfm"));
  expect_success({"a.pbrt", "--time", "1e6", "--spp", "3", "-o", "limited.pfm"});
  EXPECT_THAT(error_, HasSubstr("3 samples per pixel"));
}

// Shorter than any render: each pixel has a sample nevertheless.
TEST_F(Outputs, TheShortestTimeGivesOneSample) {
  expect_success({"a.pbrt", "--time", "1e-9", "-o", "timed.pfm"});
  EXPECT_THAT(error_, HasSubstr("1 samples per pixel"));
}

// By the command line and by the scene, which is written with it.
TEST_F(Outputs, ACropWindowHasThePixelsOfTheWholePicture) {
  expect_success({"a.pbrt", "-o", "whole.pfm"});
  const std::vector<std::string> crop = {"a.pbrt", "--cropwindow", "0.25,0.7,0.5,1", "-o",    "part.pfm",
                                         "-o",     "part.exr",     "--write-scene",  "b.pbrt"};
  expect_success(crop);
  EXPECT_THAT(error_, HasSubstr("part.pfm: 8 x 6 pixels, "));
  const Image whole = read_image(folder_.file("whole.pfm")), part = read_image(folder_.file("part.pfm"));
  ASSERT_EQ(part.width, 8);  // from ceil(0.25 * 16) to ceil(0.7 * 16)
  ASSERT_EQ(part.height, 6);
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x)
      EXPECT_EQ(part.pixels[static_cast<std::size_t>(3 * (y * part.width + x))],
                whole.pixels[static_cast<std::size_t>(3 * ((y + 6) * whole.width + x + 4))]);
  const ImageMetadata metadata = read_image_metadata(folder_.file("part.exr"));
  EXPECT_EQ(metadata.x, 4);
  EXPECT_EQ(metadata.y, 6);
  EXPECT_EQ(metadata.whole_width, 16);
  EXPECT_EQ(metadata.whole_height, 12);
  expect_success({"b.pbrt", "-o", "again.pfm"});
  EXPECT_EQ(bytes("again.pfm"), bytes("part.pfm"));
  expect_success({"b.pbrt", "--cropwindow", "0,1,0,1", "-o", "again.pfm"});
  EXPECT_EQ(bytes("again.pfm"), bytes("whole.pfm"));
}

TEST_F(Outputs, PixelBoundsAreTheCropWindowInPixels) {
  expect_success({"a.pbrt", "--pixelbounds", "3,11,5,12", "-o", "bounds.pfm"});
  EXPECT_THAT(error_, HasSubstr("bounds.pfm: 8 x 7 pixels, "));
  expect_success({"a.pbrt", "--cropwindow", "0.1875,0.6875,0.41666667,1", "-o", "window.pfm"});
  EXPECT_EQ(bytes("bounds.pfm"), bytes("window.pfm"));
}

TEST_F(Outputs, QuickIsAQuarterOfWhatIsNotSet) {
  expect_success({"a.pbrt", "--quick", "-o", "a.pfm"});
  EXPECT_THAT(error_, HasSubstr("a.pfm: 4 x 3 pixels, 1 samples per pixel"));
  expect_success({"a.pbrt", "--resolution", "16x12", "--quick", "-o", "a.pfm"});
  EXPECT_THAT(error_, HasSubstr("a.pfm: 16 x 12 pixels, 1 samples per pixel"));
  expect_success({"a.pbrt", "--spp", "9", "--quick", "-o", "a.pfm"});
  EXPECT_THAT(error_, HasSubstr("a.pfm: 4 x 3 pixels, 9 samples per pixel"));
}

TEST_F(Outputs, InfoShowsAPicture) {
  expect_success({"a.pbrt", "--pixelbounds", "3,11,5,12", "--seed", "7", "-o", "a.exr"});
  const std::string shown = run(folder_.path(), {"info", "a.exr"}).out;
  for (const char* part :
       {"picture of 8 x 7 pixels", "data window (3, 5) to (10, 11), display window (0, 0) to (15, 11)",
        "channels: A half, B half, G half, R half, Z float\n", "samplesPerPixel: 2\n", "seed: 7\n", "partial: 0\n",
        "software: Brume " BRUME_VERSION "\n", "worldToCamera: (1 0 0 0) (0 1 0 0) (0 0 -1 0) (0 0 5 1)\n",
        "worldToNDC: (", "renderTimeSeconds: "})
    EXPECT_THAT(shown, HasSubstr(part));
}

// A stop doubles. Only .png files have it.
TEST_F(Outputs, ExposureIsForPngAlone) {
  const auto first_value = [&](const std::string& name) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_file(&png, folder_.file(name).c_str()));
    png.format = PNG_FORMAT_RGB;
    std::vector<png_byte> values(PNG_IMAGE_SIZE(png));
    EXPECT_TRUE(png_image_finish_read(&png, nullptr, values.data(), 0, nullptr));
    return static_cast<int>(values.front());
  };
  expect_success({"a.pbrt", "-o", "a.pfm", "-o", "a.png"});
  expect_success({"a.pbrt", "--exposure", "1", "-o", "b.pfm", "-o", "b.png"});
  expect_success({"a.pbrt", "--exposure", "-1.5", "-o", "c.png"});
  const float value = read_image(folder_.file("a.pfm")).pixels.front();
  EXPECT_EQ(first_value("a.png"), srgb_from_linear(value));
  EXPECT_EQ(first_value("b.png"), srgb_from_linear(2 * value));
  EXPECT_EQ(first_value("c.png"), srgb_from_linear(std::exp2(-1.5f) * value));
  EXPECT_EQ(bytes("a.pfm"), bytes("b.pfm"));
}

// Of the value of a member in the file.
double member(const std::string& json, const std::string& name) {
  const std::size_t at = json.find('"' + name + "\": ");
  EXPECT_NE(at, std::string::npos) << name;
  return at == std::string::npos ? -1 : std::strtod(json.c_str() + at + name.size() + 4, nullptr);
}

TEST_F(Outputs, StatisticsCountWhatWasDone) {
  for (const std::string integrator : {"classic", "reference", "volpath"}) {
    expect_success({"a.pbrt", "--integrator", integrator, "-o", "a.pfm", "--stats", "--stats-json", "s.json"});
    for (const char* part : {"samples", "384", "shadow rays", "look-ups of density", "rendering", "memory"})
      EXPECT_THAT(error_, HasSubstr(part));
    const std::string json = bytes("s.json");
    EXPECT_THAT(json, HasSubstr("\"integrator\": \"" + integrator + "\""));
    EXPECT_EQ(member(json, "samples"), 16 * 12 * 2);
    // One ray a sample, and one more for each scattering at the most: maxdepth is 1.
    const double rays = member(json, "rays"), collisions = member(json, "collisions");
    EXPECT_GE(rays, 384);
    EXPECT_LE(rays, 384 + collisions);
    EXPECT_GT(member(json, "shadow_rays"), 0);
    EXPECT_GT(member(json, "look_ups"), 0);
    if (integrator == "classic")
      EXPECT_EQ(collisions, 0);
    else
      EXPECT_GT(collisions, 20);
    EXPECT_EQ(member(json, "majorant_violations"), 0);
    EXPECT_GT(member(json, "volume_bytes"), 512 * 2);
    EXPECT_GT(member(json, "peak_bytes"), 1e6);
    EXPECT_GT(member(json, "rendering_seconds"), 0);
  }
}

TEST_F(Outputs, OtherInstructionSetsRender) {
  expect_success({"a.pbrt", "-o", "best.pfm"});
  expect_success({"a.pbrt", "-o", "scalar.pfm"}, {{"BRUME_ISA", "scalar"}});
  const Image best = read_image(folder_.file("best.pfm")), scalar = read_image(folder_.file("scalar.pfm"));
  for (std::size_t i = 0; i < best.pixels.size(); ++i) EXPECT_NEAR(best.pixels[i], scalar.pixels[i], 1e-4f);
}

TEST_F(Outputs, AWrittenSceneGivesTheSameBits) {
  expect_success({"a.pbrt", "--seed", "3", "--spp", "3", "--write-scene", "b.pbrt"});
  EXPECT_THAT(error_, HasSubstr("b.pbrt: scene written"));
  EXPECT_THAT(folder_.names(), ElementsAre("a.pbrt", "b.pbrt"));  // nothing was rendered
  expect_success({"a.pbrt", "--seed", "3", "--spp", "3", "-o", "a.pfm"});
  expect_success({"b.pbrt", "-o", "b.pfm"});
  EXPECT_EQ(bytes("a.pfm"), bytes("b.pfm"));
}

TEST_F(Outputs, TheWrittenExampleGivesTheSameBits) {
  expect_success({"--example", "--resolution", "24x16", "--spp", "1", "-o", "a.pfm", "--write-scene", "example.pbrt"});
  expect_success({"example.pbrt", "-o", "b.pfm"});
  EXPECT_EQ(bytes("a.pfm"), bytes("b.pfm"));
}

TEST_F(Outputs, FallsBackToVolpathWithOneWarning) {
  expect_success({"a.pbrt", "--integrator", "bdpt", "-o", "b.pfm"});
  EXPECT_THAT(error_, HasSubstr("there is no integrator \"bdpt\""));
  EXPECT_EQ(error_.find("bdpt"), error_.rfind("bdpt"));
  expect_success({"a.pbrt", "--integrator", "volpath", "-o", "a.pfm"});
  EXPECT_THAT(error_, Not(HasSubstr("warning")));
  EXPECT_EQ(bytes("a.pfm"), bytes("b.pfm"));
}

TEST_F(Outputs, BadOutputsAreRefusedBeforeRendering) {
  std::filesystem::create_directory(folder_.file("folder.pfm"));
  const Outcome outcome = run(folder_.path(), {"a.pbrt", "-o", "b.pfm", "-o", "folder.pfm"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.error, HasSubstr("folder.pfm: error: cannot be written: it is a folder"));
  EXPECT_THAT(run(folder_.path(), {"a.pbrt", "-o", "."}).error, HasSubstr("it is a folder"));
  EXPECT_THAT(folder_.names(), ElementsAre("a.pbrt", "folder.pfm"));
}

TEST_F(Outputs, NoInputIsReplaced) {
  const std::string scene = bytes("a.pbrt");
  std::filesystem::create_symlink("a.pbrt", folder_.file("link.pbrt"));
  const auto expect_refused = [&](const std::vector<std::string>& arguments, const std::string& message) {
    const Outcome outcome = run(folder_.path(), arguments);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.error, HasSubstr(message));
    EXPECT_EQ(bytes("a.pbrt"), scene);
  };
  for (const char* output : {"a.pbrt", "./a.pbrt", "link.pbrt"}) {
    const std::string is_read = std::string(output) + " is read, so it cannot be an output";
    expect_refused({"a.pbrt", "--write-scene", output}, is_read);
    expect_refused({"a.pbrt", "-o", "b.pfm", "--stats-json", output}, is_read);
  }
  expect_refused({"a.pbrt", "--write-scene", "b.vdb"}, "--write-scene: b.vdb is not a .pbrt file");
  expect_refused({"a.pbrt", "-o", "b.pfm", "-o", "./b.pfm"}, "./b.pfm is given for two outputs");
  expect_refused({"a.pbrt", "--write-scene", "b.pbrt", "--stats-json", folder_.file("b.pbrt")},
                 "b.pbrt is given for two outputs");
  // The scene's own name for its picture.
  expect_refused({"a.pbrt", "--stats-json", "named by scene.pfm"}, "is given for two outputs");
  EXPECT_THAT(folder_.names(), ElementsAre("a.pbrt", "link.pbrt"));
}

// Redirected, the standard input is a file that is read.
TEST_F(Outputs, AStandardInputThatIsAFileIsNotReplaced) {
  const std::string scene = bytes("a.pbrt");
  const int status = std::system(
      ("cd '" + folder_.path() + "' && '" BRUME_PROGRAM "' - --write-scene a.pbrt < a.pbrt" + " 2> /dev/null").c_str());
  EXPECT_NE(status, 0);
  EXPECT_EQ(bytes("a.pbrt"), scene);
}

// What a scene includes or names: text, a mesh, a volume, a picture. The last case is the picture that it names for
// output.
TEST_F(Outputs, NoInputThatTheSceneNamesIsReplaced) {
  std::filesystem::copy(BRUME_TEST_FOLDER "/ellipsoid.vdb", folder_.file("smoke.vdb"));
  expect_success({"a.pbrt", "-o", "sky.exr", "--resolution", "8x8"});
  std::ofstream(folder_.file("part.pbrt")) << "LightSource \"infinite\" \"string filename\" \"sky.exr\"";
  const std::string world = R"(
    WorldBegin
    Include "part.pbrt"
    MakeNamedMedium "smoke" "string type" "vdb" "string filename" "smoke.vdb"
    MediumInterface "smoke" ""
    Shape "volume")";
  std::ofstream(folder_.file("s.pbrt")) << R"(Film "rgb" "integer xresolution" 4 "integer yresolution" 4)" << world;
  std::ofstream(folder_.file("own.pbrt")) << R"(Film "rgb" "string filename" "sky.exr")" << world;
  const std::string sky = bytes("sky.exr"), part = bytes("part.pbrt"), smoke = bytes("smoke.vdb");
  const std::vector<std::string> files = folder_.names();
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"s.pbrt", "-o", "./sky.exr"},
                                                    {"s.pbrt", "--write-scene", "part.pbrt"},
                                                    {"s.pbrt", "-o", "b.pfm", "--stats-json", "smoke.vdb"},
                                                    {"own.pbrt"}}) {
    const Outcome outcome = run(folder_.path(), arguments);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.error, HasSubstr("is read, so it cannot be an output; name another file"));
  }
  EXPECT_EQ(folder_.names(), files);
  EXPECT_EQ(bytes("sky.exr") + bytes("part.pbrt") + bytes("smoke.vdb"), sky + part + smoke);
  expect_success({"s.pbrt", "--spp", "1", "-o", "b.pfm", "--write-scene", "c.pbrt", "--stats-json", "d.json"});
}

// The limit on a file's size, which programs inherit, stands in for a full disk: writing fails after some bytes, when
// all is rendered.
TEST_F(Outputs, AFullDiskLeavesNothingBehind) {
  write_bytes_to(folder_.file("old.pfm"), "old");
  const auto run_with_a_small_disk = [&](const std::vector<std::string>& arguments) {
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{8192, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    const Outcome outcome = run(folder_.path(), arguments);
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(outcome.exit_code, 1);
    return outcome.error;
  };
  EXPECT_EQ(run_with_a_small_disk({"a.pbrt", "--resolution", "64x48", "--quiet", "-o", "old.pfm"}),
            "old.pfm: error: cannot be written: File too large\n");
  EXPECT_EQ(run_with_a_small_disk({"make", "cloud", "--size", "48", "--quiet", "-o", "c.vdb"}),
            "c.vdb: error: cannot be written: File too large\n");
  EXPECT_EQ(bytes("old.pfm"), "old");
  EXPECT_THAT(folder_.names(), ElementsAre("a.pbrt", "old.pfm"));
  // What has room is written nevertheless: a .png of these pixels is small.
  EXPECT_THAT(run_with_a_small_disk({"a.pbrt", "--resolution", "64x48", "-o", "old.pfm", "-o", "b.png"}),
              HasSubstr("old.pfm: error: cannot be written: File too large\nb.png: 64 x 48 pixels"));
  EXPECT_THAT(folder_.names(), ElementsAre("a.pbrt", "b.png", "old.pfm"));
}

TEST_F(Outputs, AFullStandardOutputIsAnError) {
  const std::string command = "cd '" + folder_.path() + "' && " BRUME_PROGRAM " info a.pbrt > /dev/full 2> error";
  EXPECT_NE(std::system(command.c_str()), 0);
  EXPECT_EQ(bytes("error"), "error: the standard output cannot be written: No space left on device\n");
}

// A terminal sees the progress, with speed; a file sees only what stays.
TEST_F(Outputs, ProgressIsShownOnATerminal) {
  const std::string render = BRUME_PROGRAM " a.pbrt --resolution 64x48 --time 1.2 -o a.pfm";
  const std::string on_terminal = "script --quiet --return --command '" + render + "' seen < /dev/null > /dev/null";
  if (std::system("command -v script > /dev/null") != 0) GTEST_SKIP() << "there is no program script";
  EXPECT_EQ(std::system(("cd '" + folder_.path() + "' && " + on_terminal).c_str()), 0);
  const std::string seen = bytes("seen");
  for (const char* part :
       {"\rRendering:   0 %, 0:00 elapsed", " remaining, ", " samples a second\033[K", "\r\033[Ka.pfm: "})
    EXPECT_THAT(seen, HasSubstr(part));
  expect_success({"a.pbrt", "--resolution", "64x48", "--time", "0.2", "-o", "a.pfm"});
  EXPECT_THAT(error_, Not(HasSubstr("Rendering")));
  EXPECT_THAT(error_, Not(HasSubstr("\r")));
}

// The same bits from the file, from it packed, and from either on the standard input.
TEST(Inputs, ScenesComePackedAndFromTheStandardInput) {
  const TemporaryFolder folder;
  write_small_scene(folder.file("a.pbrt"));
  EXPECT_EQ(run(folder.path(), {"a.pbrt", "-o", "expected.pfm"}).exit_code, 0);
  const std::string program = BRUME_PROGRAM, there = "cd '" + folder.path() + "' && ";
  EXPECT_EQ(std::system((there + "gzip -k a.pbrt").c_str()), 0);
  EXPECT_EQ(run(folder.path(), {"a.pbrt.gz", "-o", "packed.pfm"}).exit_code, 0);
  EXPECT_EQ(std::system((there + program + " - -o read.pfm --quiet < a.pbrt").c_str()), 0);
  EXPECT_EQ(std::system((there + "cat a.pbrt.gz | " + program + " - -o both.pfm --quiet").c_str()), 0);
  for (const char* picture : {"packed.pfm", "read.pfm", "both.pfm"})
    EXPECT_EQ(bytes_of(folder.file(picture)), bytes_of(folder.file("expected.pfm"))) << picture;
  EXPECT_NE(std::system((there + "echo Shape | " + program + " - -o none.pfm 2> error").c_str()), 0);
  EXPECT_THAT(bytes_of(folder.file("error")), HasSubstr("standard input:1:1: error:"));
  EXPECT_THAT(folder.names(), Not(Contains("none.pfm")));
}

TEST(Inputs, AFileThatMemoryDoesNotHoldIsNamed) {
  if (sanitized) GTEST_SKIP() << "sanitizers take all addresses there are";
  const TemporaryFolder folder;
  const std::string there = "cd '" + folder.path() + "' && truncate -s 4G a.vol && ulimit -v 4000000 && ";
  EXPECT_NE(std::system((there + BRUME_PROGRAM " info a.vol 2> error").c_str()), 0);
  EXPECT_EQ(bytes_of(folder.file("error")), "a.vol: error: cannot be read: not enough memory\n");
}

// An eighth of what the process may have.
TEST(Inputs, AnEndlessStandardInputIsRefused) {
  if (sanitized) GTEST_SKIP() << "sanitizers take all addresses there are";
  const TemporaryFolder folder;
  const std::string program = BRUME_PROGRAM, there = "cd '" + folder.path() + "' && ulimit -v 4000000 && ";
  EXPECT_NE(std::system((there + "yes '#' | " + program + " - 2> error").c_str()), 0);
  EXPECT_EQ(bytes_of(folder.file("error")),
            "standard input: error: has more than 512000000 bytes of text, an eighth of the memory\n");
}

}  // namespace
}  // namespace brume

// Ctrl-C and SIGTERM: what is rendered so far is saved and marked, and the exit code says so. Pictures so far are saved
// without them too, where that is asked for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "cli/run_program.h"
#include "image/image.h"
#include "image/temporary_folder.h"

namespace brume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using Arguments = std::vector<std::string>;

// More samples, or more time, than a test has.
const Arguments many_samples = {"a.pbrt", "--spp", "16000000", "--integrator", "path", "-o", "b.exr", "-o", "b.png"};
const Arguments much_time = {"a.pbrt", "--time", "1e6", "--integrator", "path", "-o", "b.exr", "-o", "b.png"};

// The warning about the integrator comes when rendering is about to begin.
void wait_for_start(const RunningProgram& program) {
  for (int i = 0; i < 600 && program.error().empty(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ASSERT_THAT(program.error(), HasSubstr("warning"));
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
}

void expect_partial_picture(const Arguments& arguments, int signal) {
  const TemporaryFolder folder;
  write_small_scene(folder.file("a.pbrt"));
  RunningProgram program(folder.path(), arguments);
  ASSERT_NO_FATAL_FAILURE(wait_for_start(program));
  program.send(signal);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_THAT(outcome.error, HasSubstr("interrupted"));
  EXPECT_THAT(outcome.error, HasSubstr("partial"));
  EXPECT_THAT(folder.names(), ElementsAre("a.pbrt", "b.exr", "b.png"));
  EXPECT_THAT(bytes_of(folder.file("b.png")), HasSubstr("partial: stopped before its end"));
  const ImageMetadata metadata = read_image_metadata(folder.file("b.exr"));
  EXPECT_TRUE(metadata.partial);
  EXPECT_GT(metadata.samples_per_pixel, 0);
  EXPECT_LT(metadata.samples_per_pixel, 16000000);
  const Image image = read_image(folder.file("b.exr"));
  EXPECT_GT(image.pixels.front(), 0);
  EXPECT_GT(image.pixels.back(), 0);
}

TEST(Interrupt, SigintSavesWhatThereIs) { expect_partial_picture(many_samples, SIGINT); }
TEST(Interrupt, SigtermSavesWhatThereIs) { expect_partial_picture(much_time, SIGTERM); }
TEST(Interrupt, SighupSavesWhatThereIs) { expect_partial_picture(much_time, SIGHUP); }

// As it does the shell's other programs. The pipe stays open: nothing ever comes.
TEST(Interrupt, OneSigintEndsWhatWaitsForAScene) {
  const TemporaryFolder folder;
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const int usual_input = dup(STDIN_FILENO);
  dup2(pipe_ends[0], STDIN_FILENO);
  RunningProgram program(folder.path(), {"-"});
  dup2(usual_input, STDIN_FILENO);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  program.send(SIGINT);
  EXPECT_EQ(program.wait().exit_code, 130);
  for (const int descriptor : {usual_input, pipe_ends[0], pipe_ends[1]}) close(descriptor);
}

// A program that is killed has left the picture of some seconds ago. The twin, not asked for it, has left nothing.
TEST(Interrupt, PartialImagesAreThereWhileItRenders) {
  for (const bool asked : {true, false}) {
    const TemporaryFolder folder;
    write_small_scene(folder.file("a.pbrt"));
    Arguments arguments = many_samples;
    if (asked) arguments.push_back("--write-partial-images");
    {
      RunningProgram program(folder.path(), arguments);
      ASSERT_NO_FATAL_FAILURE(wait_for_start(program));
      program.send(SIGKILL);
    }
    ASSERT_EQ(folder.names().size(), asked ? 3u : 1u);
    if (!asked) continue;
    const ImageMetadata metadata = read_image_metadata(folder.file("b.exr"));
    EXPECT_TRUE(metadata.partial);
    EXPECT_GT(metadata.samples_per_pixel, 0);
    EXPECT_GT(read_image(folder.file("b.exr")).pixels.front(), 0);
  }
}

}  // namespace
}  // namespace brume

// brume compare, and the variance that it lives on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "cli/run_program.h"
#include "image/image.h"
#include "image/temporary_folder.h"

namespace brume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class Compare : public testing::Test {
 protected:
  void write(const std::string& name, const Image& image) const {
    ImageMetadata metadata;
    metadata.half = false;
    write_image(folder_.file(name), image, metadata);
  }
  void render(const std::string& name, int seed) const {
    write_small_scene(folder_.file("scene.pbrt"));
    const Outcome outcome = run(folder_.path(), {"scene.pbrt", "-o", name, "--variance", "--seed", std::to_string(seed),
                                                 "--resolution", "96x72", "--spp", "16"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  }
  // What a successful run prints.
  std::string output(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run(folder_.path(), arguments);
    EXPECT_EQ(outcome.exit_code, 0) << testing::PrintToString(arguments) << outcome.error;
    EXPECT_THAT(outcome.error, IsEmpty());
    return outcome.out;
  }

  const TemporaryFolder folder_;
};

TEST_F(Compare, PrintsATable) {
  write("a.pfm", {2, 1, {1, 2, 6, 1, 2, 6}});
  write("b.exr", {2, 1, {2, 2, 4, 2, 2, 4}});
  const std::string table = output({"compare", "a.pfm", "b.exr"});
  for (const char* part : {"2 x 1 pixels", "mean A", "0.5            1          1.5        1.125\n", "0.833333\n",
                           "relMSE", "No z-scores"})
    EXPECT_THAT(table, HasSubstr(part));
}

// The pictures differ by 1 in red: MSE is (1/2 + 0 + 0) / 3, relMSE that over 4 + 0.01 because of the reference. Block
// means in red have z = 1 / sqrt(2 * 0.01 / 2).
TEST_F(Compare, JsonIsOneObject) {
  const std::vector<float> variance(6, 0.01f);
  write("a.exr", {2, 1, {1, 2, 0, 1, 2, 0}, variance});
  write("b.exr", {2, 1, {2, 2, 0, 2, 2, 0}, variance});
  write("ref.pfm", {2, 1, {2, 2, 2, 2, 2, 2}});
  const std::string scores =
      R"("unexplained": 0, "mean": 0, "mean_limit": 4, "deviation": null, "deviation_limit": 2.82842712475, "agree": true}})";
  const std::string json = output({"compare", "a.exr", "b.exr", "ref.pfm", "--json"});
  EXPECT_THAT(json,
              StartsWith(R"({"width": 2, "height": 1, "pixels": 2, "invalid_pixels": 0, "mean_ratio": 0.75, )"
                         R"("mse": 0.166666666667, "relmse": 0.0415627597672, "trimmed_relmse": 0.0415627597672, )"
                         R"("R": {"mean_a": 1, "mean_b": 2, "mean_ratio": 0.5, "z": {"block_size": 8, "blocks": 1)"));
  EXPECT_THAT(json, HasSubstr(R"("mean": -10.0000001118, "mean_limit": 4, "deviation": null)"));
  EXPECT_THAT(json, HasSubstr(R"("agree": false}}, "G": {"mean_a": 2, "mean_b": 2, "mean_ratio": 1, )"
                              R"("z": {"block_size": 8, "blocks": 1, )" +
                              scores +
                              R"(, "B": {"mean_a": 0, "mean_b": 0, "mean_ratio": null, )"
                              R"("z": {"block_size": 8, "blocks": 1, )" +
                              scores + "}\n"));
  EXPECT_THAT(output({"compare", "--json", "--block", "1", "a.exr", "b.exr"}),
              HasSubstr(R"("block_size": 1, "blocks": 2)"));
  EXPECT_THAT(output({"compare", "a.exr", "ref.pfm", "--json"}), HasSubstr(R"("z": null)"));
}

// Two seeds agree. The twins: a picture that is 1 % too bright, and one that shares its noise with the other.
TEST_F(Compare, RendersWithVarianceAgree) {
  render("a.exr", 1);
  render("b.exr", 2);
  const std::string table = output({"compare", "a.exr", "b.exr"});
  EXPECT_THAT(table, HasSubstr("agrees       agrees       agrees\n"));
  EXPECT_THAT(output({"compare", "a.exr", "a.exr"}), HasSubstr("DIFFERS      DIFFERS      DIFFERS\n"));
  Image bright = read_image(folder_.file("b.exr"));
  for (float& value : bright.pixels) value *= 1.01f;
  write("bright.exr", bright);
  EXPECT_THAT(output({"compare", "a.exr", "bright.exr"}), HasSubstr("DIFFERS      DIFFERS      DIFFERS\n"));
  EXPECT_THAT(output({"info", "a.exr"}), HasSubstr("R float"));
  EXPECT_THAT(output({"info", "a.exr"}), HasSubstr("Variance.R float"));
}

TEST_F(Compare, MistakesAreNamed) {
  write("a.pfm", {2, 1, std::vector<float>(6)});
  write("b.pfm", {1, 2, std::vector<float>(6)});
  write("nan.pfm", {2, 1, std::vector<float>(6, std::numeric_limits<float>::quiet_NaN())});
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"a.pfm"}, "needs the names of two pictures"},
      {{"a.pfm", "a.pfm", "a.pfm", "a.pfm"}, "unexpected argument"},
      {{"a.pfm", "b.pfm"}, "b.pfm: error: its 1 x 2 pixels cannot be compared with the 2 x 1 of a.pfm"},
      {{"a.pfm", "a.pfm", "b.pfm"}, "b.pfm: error: its 1 x 2"},
      {{"a.pfm", "nan.pfm"}, "no pixel is finite"},
      {{"a.pfm", "missing.exr"}, "missing.exr: error: cannot be read"},
      {{"a.pfm", "a.png"}, "pictures are read from .exr and .pfm"},
      {{"a.pfm", "a.pfm", "--block", "0"}, "--block: \"0\" is not a whole number from 1"},
      {{"a.pfm", "a.pfm", "--jsn"}, "did you mean --json?"},
  };
  for (const auto& [arguments, message] : cases) {
    std::vector<std::string> all = arguments;
    all.insert(all.begin(), "compare");
    const Outcome outcome = run(folder_.path(), all);
    EXPECT_EQ(outcome.exit_code, 1) << message;
    EXPECT_THAT(outcome.error, HasSubstr(message));
    EXPECT_THAT(outcome.out, IsEmpty());
  }
  EXPECT_THAT(output({"compare", "--help"}), StartsWith("Usage: brume compare A B [REF]"));
}

TEST_F(Compare, VarianceThatCannotBeWrittenIsRefusedBeforeRendering) {
  write_small_scene(folder_.file("a.pbrt"));
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"a.pbrt", "--variance", "-o", "a.png"},
                                                    {"a.pbrt", "--variance"}}) {  // the scene names a .pfm
    const Outcome outcome = run(folder_.path(), arguments);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.error, HasSubstr("--variance needs an .exr file"));
  }
  const Outcome one_sample = run(folder_.path(), {"a.pbrt", "--variance", "-o", "a.exr", "--spp", "1"});
  EXPECT_EQ(one_sample.exit_code, 1);
  EXPECT_THAT(one_sample.error, HasSubstr("two samples per pixel"));
  EXPECT_THAT(folder_.names(), ElementsAre("a.pbrt"));
}

TEST_F(Compare, VarianceGoesToTheExrAndChangesNoColour) {
  write_small_scene(folder_.file("a.pbrt"));
  EXPECT_EQ(run(folder_.path(), {"a.pbrt", "--variance", "-o", "a.EXR", "-o", "a.pfm"}).exit_code, 0);
  EXPECT_EQ(run(folder_.path(), {"a.pbrt", "-o", "plain.pfm"}).exit_code, 0);
  EXPECT_EQ(bytes_of(folder_.file("a.pfm")), bytes_of(folder_.file("plain.pfm")));
  const Image picture = read_image(folder_.file("a.EXR"));
  EXPECT_EQ(picture.pixels, read_image(folder_.file("plain.pfm")).pixels);
  EXPECT_EQ(picture.variance.size(), picture.pixels.size());
  EXPECT_THAT(picture.variance, Not(testing::Each(0)));
}

}  // namespace
}  // namespace brume

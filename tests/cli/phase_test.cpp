// brume phase: the phase functions as tables and plots.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brume/phase.h"
#include "cli/run_program.h"
#include "image/temporary_folder.h"
#include "kernel/phase_table.h"

namespace brume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

TEST(Phase, AloneItListsEveryFunctionAndParameter) {
  const TemporaryFolder folder;
  const Outcome list = run(folder.path(), {"phase"});
  EXPECT_EQ(list.exit_code, 0) << list.error;
  for (const PhaseEntry& entry : phase_functions()) {
    EXPECT_THAT(list.out, HasSubstr(std::string(entry.table.name) + ": " + std::string(entry.table.meaning)));
    for (const PhaseParameter& parameter : entry.table.parameters)
      if (!parameter.name.empty()) {
        EXPECT_THAT(list.out, HasSubstr(std::string(parameter.meaning)));
      }
  }
  EXPECT_THAT(list.out, HasSubstr("0.1 to 50 um      default 10 "));
  EXPECT_THAT(list.out, HasSubstr("above -1, below 1 default 0.8"));
}

TEST(Phase, TableOfValuesInClosedForm) {
  const TemporaryFolder folder;
  const Outcome table = run(folder.path(), {"phase", "henyey_greenstein", "g=0.5", "--step", "90"});
  EXPECT_EQ(table.exit_code, 0) << table.error;
  EXPECT_EQ(table.out,
            "henyey_greenstein, g = 0.5\nmean cosine 0.5\n\n"
            "  angle          mu     p (1/sr)\n"
            "      0    1.000000     0.477465\n"    // (1 - g^2) / (4 pi (1 - g)^3)
            "     90    0.000000    0.0427057\n"    // (1 - g^2) / (4 pi (1 + g^2)^(3/2))
            "    180   -1.000000    0.0176839\n");  // (1 - g^2) / (4 pi (1 + g)^3)
  const Outcome usual = run(folder.path(), {"phase", "two_lobe", "g2=-0.5"});
  EXPECT_THAT(usual.out, StartsWith("two_lobe, g1 = 0.8, g2 = -0.5, w = 0.7\nmean cosine 0.41\n"));
  EXPECT_EQ(std::count(usual.out.begin(), usual.out.end(), '\n'), 4 + 19);
}

// A step that does not divide 180 has the row of 180 too.
TEST(Phase, EveryTableEndsStraightBack) {
  const TemporaryFolder folder;
  EXPECT_THAT(run(folder.path(), {"phase", "isotropic", "--step", "50"}).out,
              HasSubstr("    150   -0.866025    0.0795775\n    180   -1.000000    0.0795775\n"));
}

TEST(Phase, CurvesIntegrateToOneAndToTheirMeanCosine) {
  for (const PhaseInfo& phase : phase_infos()) {
    constexpr int steps = 100000;
    const PhaseCurve curve = phase_curve(phase.name, {}, steps + 1);
    double sum = 0, cosines = 0;
    for (int i = 0; i <= steps; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double angle = curve.angles[at] * std::numbers::pi / 180;
      const double weight = 2 * std::numbers::pi * std::numbers::pi / steps * std::sin(angle) * curve.values[at];
      sum += weight;
      cosines += weight * std::cos(angle);
    }
    EXPECT_NEAR(sum, 1, 2e-3) << phase.name;
    EXPECT_NEAR(cosines, curve.mean_cosine, 2e-3) << phase.name;
  }
}

TEST(Phase, PlotsOnTheTerminalAndAsAPicture) {
  const TemporaryFolder folder;
  const Outcome plot = run(folder.path(), {"phase", "mie", "d=20", "--plot"});
  EXPECT_EQ(plot.exit_code, 0) << plot.error;
  EXPECT_THAT(plot.out, HasSubstr("  1e+4 +"));
  EXPECT_THAT(plot.out, HasSubstr("  1e-3 +"));
  EXPECT_THAT(plot.out, HasSubstr("180 degrees"));
  const Outcome picture = run(folder.path(), {"phase", "mie", "d=20", "-o", "a.png"});
  EXPECT_EQ(picture.exit_code, 0) << picture.error;
  EXPECT_THAT(picture.out, IsEmpty());
  EXPECT_THAT(bytes_of(folder.file("a.png")), StartsWith("\x89PNG"));
  EXPECT_THAT(bytes_of(folder.file("a.png")), Not(HasSubstr("samples per pixel")));  // it has none
  for (const char* extreme : {"isotropic", "rayleigh"})
    EXPECT_EQ(run(folder.path(), {"phase", extreme, "--plot", "-o", "a.png"}).exit_code, 0);
  for (const char* g : {"g=0.9999", "g=-0.9999", "g=0"})
    EXPECT_EQ(run(folder.path(), {"phase", "henyey_greenstein", g, "--plot", "-o", "a.png"}).exit_code, 0);
  EXPECT_THAT(folder.names(), ElementsAre("a.png"));
}

TEST(Phase, MistakesAreNamedAndNothingIsWritten) {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"mei"}, "unknown phase function \"mei\"; did you mean mie?"},
      {{"lambert"}, "known are draine, henyey_greenstein, isotropic, mie"},
      {{"mie", "g=1"}, "mie has no parameter \"g\""},
      {{"isotropic", "scale=1"}, "isotropic has no parameter \"scale\"; it has none"},
      {{"mie", "d=51"}, "d of mie must be from 0.1 to 50, found 51"},
      {{"schlick", "k=1"}, "k of schlick must be above -1 and below 1, found 1"},
      {{"schlick", "k=0.99999999999"}, "k of schlick must be above -1 and below 1"},  // 1 as a float
      {{"schlick", "k"}, "\"k\" is not NAME=VALUE"},
      {{"schlick", "k=x"}, "what follows = is not a number"},
      {{"schlick", "k=0.1", "k=0.2"}, "\"k\" is given twice"},
      {{"schlick", "--step", "0"}, "--step: \"0\" is not a whole number from 1 to 90"},
      {{"schlick", "-o", "a.exr"}, "plots are written as .png"},
      {{"schlick", "-o", "missing/a.png"}, "there is no folder missing"},
      {{"--plot"}, "needs the name of a phase function"},
      {{"schlick", "--plott"}, "did you mean --plot?"},
  };
  for (const auto& [arguments, message] : cases) {
    std::vector<std::string> all{"phase"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run(folder.path(), all);
    EXPECT_EQ(outcome.exit_code, 1) << message;
    EXPECT_THAT(outcome.error, HasSubstr(message));
    EXPECT_THAT(outcome.out, IsEmpty());
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Phase, HelpHasAnExample) {
  const TemporaryFolder folder;
  EXPECT_THAT(run(folder.path(), {"phase", "--help"}).out, HasSubstr("brume phase mie d=20 --plot"));
}

}  // namespace
}  // namespace brume

// Golden files of messages: for each errors/NAME.pbrt what the reader says of it, whole, is in errors/NAME.expected.
// Names that begin with strict_ are read with old spellings as errors.
// After a change that was meant, BRUME_UPDATE_EXPECTED=1 in the environment rewrites them; read the difference.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/file.h"
#include "scene_test.h"

namespace brume {
namespace {

std::vector<std::string> error_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(test_folder("errors")))
    if (entry.path().extension() == ".pbrt") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

// All warnings, then all errors, with the folder's name taken out.
std::string messages_about(const std::string& path) {
  std::vector<Diagnostic> warnings;
  std::string errors;
  try {
    read_scene_files({path}, warnings, std::filesystem::path(path).filename().string().starts_with("strict_"));
  } catch (const InputError& e) {
    errors = std::string(e.what()) + '\n';
  }
  std::string text;
  for (const Diagnostic& w : warnings) text += to_string(w) + '\n';
  text += errors;
  const std::string folder = test_folder("errors/");
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
    text.erase(at, folder.size());
  return text;
}

// The first line in which two texts differ, or "".
std::string difference(const std::string& expected, const std::string& found) {
  std::istringstream a(expected), b(found);
  std::string line_a, line_b;
  for (int line = 1;; ++line) {
    const bool more_a = static_cast<bool>(std::getline(a, line_a)), more_b = static_cast<bool>(std::getline(b, line_b));
    if (!more_a && !more_b) return expected == found ? "" : "they differ at the end";
    if (!more_a) line_a = "(nothing)";
    if (!more_b) line_b = "(nothing)";
    if (more_a != more_b || line_a != line_b)
      return "line " + std::to_string(line) + "\n  expected: " + line_a + "\n  found:    " + line_b;
  }
}

class ErrorFile : public testing::TestWithParam<std::string> {};
TEST_P(ErrorFile, SaysWhatIsExpected) {
  const std::string base = test_folder("errors/" + GetParam());
  const std::string found = messages_about(base + ".pbrt");
  if (std::getenv("BRUME_UPDATE_EXPECTED")) std::ofstream(base + ".expected", std::ios::binary) << found;
  EXPECT_EQ(difference(read_file(base + ".expected"), found), "");
}
INSTANTIATE_TEST_SUITE_P(Scenes, ErrorFile, testing::ValuesIn(error_scenes()),
                         [](const auto& parameter) { return parameter.param; });

TEST(ErrorFiles, AreManyAndNoneIsEmpty) {
  EXPECT_GE(error_scenes().size(), 25u);
  for (const std::string& name : error_scenes())
    EXPECT_FALSE(read_file(test_folder("errors/" + name + ".expected")).empty());
}

// The comparison must see a planted mismatch: another letter, a caret moved by one, a line more or less.
TEST(ErrorFiles, ComparisonFindsPlantedMismatches) {
  const std::string good = read_file(test_folder("errors/wrong_type.expected"));
  EXPECT_EQ(difference(good, good), "");
  std::string letter = good;
  letter[letter.find("wrong")] = 'W';
  EXPECT_NE(difference(letter, good), "");
  std::string caret = good;
  caret.insert(caret.find('^'), " ");
  EXPECT_NE(difference(caret, good), "");
  EXPECT_NE(difference(good + "more\n", good), "");
  EXPECT_NE(difference(good, good + "more\n"), "");
  EXPECT_NE(difference(good, good.substr(0, good.size() - 1)), "");
  EXPECT_NE(difference(good, read_file(test_folder("errors/wrong_count.expected"))), "");
}

}  // namespace
}  // namespace brume

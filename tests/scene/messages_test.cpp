#include "scene/messages.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "image/temporary_folder.h"
#include "scene/read_scene.h"

namespace brume {
namespace {

// The message about `needle` in a text of one file, as it would be shown.
std::string message_at(const std::string& text, const std::string& needle, int line, int column) {
  const Source source{"t", text, 0};
  Messages messages;
  messages.error({&source, text.find(needle), line, column}, "here");
  std::vector<Diagnostic> warnings;
  return to_string(messages.finish(warnings).at(0));
}

// The character above the caret.
char pointed_at(const std::string& message) {
  const std::size_t caret_line = message.rfind('\n') + 1, line = message.rfind('\n', caret_line - 2) + 1;
  return message.at(line + message.find('^', caret_line) - caret_line);
}

TEST(Messages, ShowShortLinesWhole) {
  EXPECT_EQ(message_at("one\ntwo X\nthree", "X", 2, 5), "t:2:5: error: here\n  two X\n      ^");
}

TEST(Messages, PutTheCaretUnderItsPlaceInLongLines) {
  for (const int before : {0, 10, 59, 60, 61, 100, 159, 160, 161, 5000})
    for (const int after : {0, 10, 100, 5000}) {
      const std::string text = std::string(static_cast<std::size_t>(before), 'a') + "X" +
                               std::string(static_cast<std::size_t>(after), 'b') + "\nnext";
      const std::string message = message_at(text, "X", 1, before + 1);
      EXPECT_EQ(pointed_at(message), 'X') << before << ' ' << after << '\n' << message;
      EXPECT_LT(message.size(), 500u);
    }
}

TEST(Messages, AreSortedByPlaceAndEndAtTwenty) {
  const Source source{"t", "", 0};
  Messages messages;
  for (int i = 0; i < 19; ++i) messages.error({&source, 0, 100 - i, 1}, "e");
  EXPECT_THROW(messages.error({&source, 0, 1, 1}, "last"), TooManyErrors);
  std::vector<Diagnostic> warnings;
  const std::vector<Diagnostic> errors = messages.finish(warnings);
  ASSERT_EQ(errors.size(), 20u);
  for (std::size_t i = 1; i < 20; ++i) EXPECT_LT(errors[i - 1].location.line, errors[i].location.line);
}

TEST(Messages, GiveAWarningOnce) {
  const Source source{"t", "", 0};
  Messages messages;
  messages.warning({&source, 0, 2, 1}, "w");
  messages.warning({&source, 0, 3, 1}, "w");
  std::vector<Diagnostic> warnings;
  EXPECT_TRUE(messages.finish(warnings).empty());
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].location.line, 2);
}

TEST(Messages, NamesCannotCommandATerminal) {
  EXPECT_EQ(printable("a\x1b[31mb\x7f\n"), "a?[31mb??");
  EXPECT_EQ(printable("\xc2\x9b\xc2\xa0"), "?\xc2\xa0");  // the control sequence introducer in one, and a space
  EXPECT_EQ(to_string({Severity::error, {"a\x1b.vdb", 0, 0}, "no grid \x1b[31m", {}}), "a?.vdb: error: no grid ?[31m");
  EXPECT_EQ(printable("caf\xc3\xa9"), "caf\xc3\xa9");
  EXPECT_EQ(printable("\xff\xc3"), "??");
  EXPECT_LT(printable(std::string(1000, 'x')).size(), 70u);
}

// What is wrong with a scene after it was read: the line is fetched from its file, which may be there no more, or be
// another one by now.
TEST(Messages, LinesAreFoundInTheirFiles) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.pbrt");
  write_file_atomically(file, "one\n\xc3\xa9\xc3\xa9 X\nthree");
  const auto error_at = [&](const std::string& name, int line, int column) {
    std::vector<Diagnostic> all{{Severity::error, {name, line, column}, "here", {}}};
    add_source_lines(all);
    return to_string(all[0]).substr(name.size());
  };
  EXPECT_EQ(error_at(file, 2, 4), ":2:4: error: here\n  \xc3\xa9\xc3\xa9 X\n     ^");
  EXPECT_EQ(error_at(file, 3, 1), ":3:1: error: here\n  three\n  ^");
  EXPECT_EQ(error_at(file, 4, 1), ":4:1: error: here");
  EXPECT_EQ(error_at(file, 3, 100), ":3:100: error: here");
  EXPECT_EQ(error_at(file, 0, 0), ": error: here");
  EXPECT_EQ(error_at("standard input", 1, 1), ":1:1: error: here");
}

}  // namespace
}  // namespace brume

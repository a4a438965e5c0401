#include "scene/messages.h"

#include <gtest/gtest.h>

namespace brume {
namespace {

// The message about `needle` in a text of one file, as it would be shown.
std::string message_at(const std::string& text, const std::string& needle, int line, int column) {
  const Source source{"t", text, 0};
  Messages messages;
  messages.error({&source, text.find(needle), line, column}, "here");
  std::vector<Diagnostic> warnings;
  try {
    messages.finish(warnings);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
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
  try {
    messages.finish(warnings);
    FAIL();
  } catch (const InputError& e) {
    ASSERT_EQ(e.diagnostics().size(), 20u);
    for (std::size_t i = 1; i < 20; ++i)
      EXPECT_LT(e.diagnostics()[i - 1].location.line, e.diagnostics()[i].location.line);
  }
}

TEST(Messages, GiveAWarningOnce) {
  const Source source{"t", "", 0};
  Messages messages;
  messages.warning({&source, 0, 2, 1}, "w");
  messages.warning({&source, 0, 3, 1}, "w");
  std::vector<Diagnostic> warnings;
  messages.finish(warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].location.line, 2);
}

TEST(Messages, NamesCannotCommandATerminal) {
  EXPECT_EQ(printable("a\x1b[31mb\x7f"), "a?[31mb?");
  EXPECT_EQ(printable("caf\xc3\xa9"), "caf\xc3\xa9");
  EXPECT_EQ(printable("\xff\xc3"), "??");
  EXPECT_LT(printable(std::string(1000, 'x')).size(), 70u);
}

}  // namespace
}  // namespace brume

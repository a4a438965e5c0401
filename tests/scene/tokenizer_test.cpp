#include "scene/tokenizer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace brume {
namespace {

std::vector<Token> tokens_of(std::string_view text, Messages& messages) {
  static std::vector<std::unique_ptr<Source>> sources;  // tokens point into them
  sources.push_back(std::make_unique<Source>(Source{"t", text, 0}));
  TokenStream stream(messages);
  stream.push(*sources.back());
  std::vector<Token> tokens;
  do tokens.push_back(stream.next());
  while (tokens.back().kind != Token::Kind::end);
  return tokens;
}

TEST(Tokenizer, SplitsKindsAndSkipsComments) {
  Messages messages;
  const auto t = tokens_of("Shape\"a b\"[1 -2.5e3]# Shape \"x\"\n\ttrue .5#end", messages);
  using K = Token::Kind;
  const std::vector<std::pair<K, std::string_view>> expected = {
      {K::word, "Shape"}, {K::string, "a b"}, {K::open, "["},    {K::number, "1"}, {K::number, "-2.5e3"},
      {K::close, "]"},    {K::word, "true"},  {K::number, ".5"}, {K::end, ""}};
  ASSERT_EQ(t.size(), expected.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    EXPECT_EQ(t[i].kind, expected[i].first) << i;
    EXPECT_EQ(t[i].text, expected[i].second) << i;
  }
}

TEST(Tokenizer, PlacesCountLinesAndCharacters) {
  Messages messages;
  const auto t = tokens_of("A\r\n  B \"\xc3\xa9t\xc3\xa9\" C\n\nD", messages);
  ASSERT_EQ(t.size(), 6u);
  const std::vector<std::pair<int, int>> expected = {{1, 1}, {2, 3}, {2, 5}, {2, 11}, {4, 1}, {4, 2}};
  for (std::size_t i = 0; i < t.size(); ++i) {
    EXPECT_EQ(t[i].place.line, expected[i].first) << i;
    EXPECT_EQ(t[i].place.column, expected[i].second) << i;
  }
  EXPECT_EQ(t[4].place.offset, 18u);
}

TEST(Tokenizer, ReplacesEscapes) {
  Messages messages;
  const auto t = tokens_of(R"("a\\b\"c\n\t\'")", messages);
  EXPECT_FALSE(messages.any_error());
  EXPECT_EQ(unescaped(t[0]), "a\\b\"c\n\t'");
}

TEST(Tokenizer, ReportsStringsThatDoNotEnd) {
  Messages messages;
  const auto t = tokens_of("\"abc\nShape", messages);
  EXPECT_TRUE(messages.any_error());
  ASSERT_EQ(t.size(), 3u);
  EXPECT_EQ(t[1].text, "Shape");
}

TEST(Tokenizer, ReadsAllFormsOfNumbers) {
  const std::vector<std::pair<std::string_view, double>> good = {
      {"0", 0},
      {"+1", 1},
      {"-1", -1},
      {".5", 0.5},
      {"5.", 5},
      {"-.25e1", -2.5},
      {"1e3", 1e3},
      {"1E+3", 1e3},
      {"2.5e-3", 2.5e-3},
      {"0000012", 12},
      {"3.4028235e+38", 3.4028235e+38},
      {"1e-45", 1e-45},
      {"123456789012345678901234567890", 123456789012345678901234567890.0}};
  for (const auto& [text, value] : good) {
    double v = std::nan("");
    EXPECT_EQ(read_number(text, v), NumberStatus::ok) << text;
    EXPECT_EQ(v, value) << text;
  }
}

TEST(Tokenizer, RefusesWhatIsNoNumber) {
  double v = 0;
  for (const std::string_view text :
       {"", "+", "-", ".", "-.", "+-1", "--1", "1e", "1e+", "1.2.3", "1,5", "0x10", "-inf", "-nan", "+nan", "1f", "1 "})
    EXPECT_EQ(read_number(text, v), NumberStatus::malformed) << text;
  for (const std::string_view text : {"1e39", "-3.5e38", "1e999", "3.4028236e+38"})
    EXPECT_EQ(read_number(text, v), NumberStatus::out_of_range) << text;
}

TEST(Tokenizer, ReadsIntegersOf32Bits) {
  std::int64_t v = 0;
  EXPECT_EQ(read_integer("-2147483648", v), NumberStatus::ok);
  EXPECT_EQ(v, std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(read_integer("+4294967295", v), NumberStatus::ok);
  EXPECT_EQ(v, 4294967295);
  for (const std::string_view text : {"4294967296", "-2147483649", "99999999999999999999"})
    EXPECT_EQ(read_integer(text, v), NumberStatus::out_of_range) << text;
  for (const std::string_view text : {"1.0", "1e3", "", "-", "0x1", "1a"})
    EXPECT_EQ(read_integer(text, v), NumberStatus::malformed) << text;
}

TEST(Tokenizer, FastPathStopsBeforeWhatIsNoNumber) {
  Messages messages;
  const Source source{"t", "1 2.5 # x\n 3e0 4x 5", 0};
  TokenStream stream(messages);
  stream.push(source);
  double v = 0, sum = 0;
  while (stream.next_number(v)) sum += v;
  EXPECT_EQ(sum, 6.5);
  EXPECT_EQ(stream.next().text, "4x");
  EXPECT_EQ(stream.next().text, "5");
}

// Short numbers have a way of their own; to the last bit it is the long one. Digits, points and signs at random, 1 to
// 20 of them, are numbers or not.
TEST(Tokenizer, FastPathReadsNumbersAsTheSlowOneDoes) {
  std::mt19937 random(3);
  int numbers = 0, others = 0;
  for (int i = 0; i < 200000; ++i) {
    std::string text;
    const std::size_t length = 1 + random() % 20;
    for (std::size_t k = 0; k < length; ++k) text += "0123456789012345678901234567890123456789.-"[random() % 42];
    double expected = 0, found = 0;
    const bool is_number = read_number(text, expected) == NumberStatus::ok;
    Messages messages;
    const Source source{"t", text, 0};
    TokenStream stream(messages);
    stream.push(source);
    ASSERT_EQ(stream.next_number(found), is_number) << text;
    if (is_number) {
      ASSERT_EQ(found, expected) << text;
      ASSERT_EQ(std::signbit(found), std::signbit(expected)) << text;
      EXPECT_EQ(stream.next().kind, Token::Kind::end);
    }
    ++(is_number ? numbers : others);
  }
  EXPECT_GT(numbers, 10000);
  EXPECT_GT(others, 10000);
}

TEST(Tokenizer, ContinuesAfterAnIncludedSource) {
  Messages messages;
  const Source outer{"outer", "A B", 0}, inner{"inner", "X [1", 1};
  TokenStream stream(messages);
  stream.push(outer);
  std::string all(stream.next().text);
  stream.push(inner);
  for (Token t = stream.next(); t.kind != Token::Kind::end; t = stream.next()) all += t.text;
  EXPECT_EQ(all, "AX[1B");
  EXPECT_EQ(stream.next().place.source, &outer);
}

TEST(Tokenizer, GoesOnAtTheNextDirective) {
  Messages messages;
  const Source source{"t", "1 ] \"x true false oops \n [ Shape", 0};
  TokenStream stream(messages);
  stream.push(source);
  stream.skip_to_directive();
  EXPECT_EQ(stream.next().text, "Shape");
  EXPECT_FALSE(messages.any_error());
}

}  // namespace
}  // namespace brume

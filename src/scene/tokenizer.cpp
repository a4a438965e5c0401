#include "scene/tokenizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace brume {

namespace {

enum class Class : std::uint8_t { other, space, delimiter, number };

// One look-up per character: what may begin or end a token.
constexpr std::array<Class, 256> make_classes() {
  std::array<Class, 256> classes{};
  for (const char c : {' ', '\t', '\r', '\n'}) classes[static_cast<unsigned char>(c)] = Class::space;
  for (const char c : {'[', ']', '"', '#'}) classes[static_cast<unsigned char>(c)] = Class::delimiter;
  for (const char c : {'0', '1', '2', '3', '4', '5', '6', '7', '8', '9', '+', '-', '.'})
    classes[static_cast<unsigned char>(c)] = Class::number;
  return classes;
}
constexpr std::array<Class, 256> classes = make_classes();

Class class_of(char c) { return classes[static_cast<unsigned char>(c)]; }
bool ends_token(char c) { return class_of(c) == Class::space || class_of(c) == Class::delimiter; }

// What is nearer to 2^128 than to the largest float.
constexpr double float_overflow = 0x1.ffffffp127;

constexpr std::string_view escapes = "bfnrt\\'\"";
constexpr std::string_view escaped = "\b\f\n\r\t\\'\"";

int to_int(std::int64_t v) { return static_cast<int>(std::min<std::int64_t>(v, std::numeric_limits<int>::max())); }

// from_chars takes no '+', and takes "inf" and "nan" after a '-'; this leaves it with what it may see.
const char* number_begin(std::string_view text, bool point_allowed) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  const char* digits = begin != end && (*begin == '+' || *begin == '-') ? begin + 1 : begin;
  if (digits == end) return nullptr;
  const bool digit = *digits >= '0' && *digits <= '9';
  if (!digit && !(point_allowed && *digits == '.')) return nullptr;
  return *begin == '+' ? digits : begin;
}

// The number that begins at `at`, where it is a short one: a sign, and up to 15 digits with a point among them. Such
// digits and the power of ten below them are doubles, and so their quotient is rounded once, to the nearest: what
// from_chars finds. Returns where the number ends, or null.
const char* read_short_number(const char* at, const char* end, double& value) {
  static constexpr double powers[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                      1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  constexpr std::ptrdiff_t most_digits = 15;
  const bool negative = at != end && *at == '-';
  if (negative) ++at;
  std::int64_t digits = 0;
  const auto read_digits = [&] {
    const char* const first = at;
    for (; at != end && *at >= '0' && *at <= '9' && at - first <= most_digits; ++at) digits = 10 * digits + (*at - '0');
    return at - first;
  };
  const std::ptrdiff_t whole = read_digits();
  std::ptrdiff_t places = 0;
  if (at != end && *at == '.' && whole <= most_digits) {
    ++at;
    const std::int64_t before = digits;
    digits = 0;
    places = read_digits();
    if (whole + places > most_digits) return nullptr;
    digits += before * static_cast<std::int64_t>(powers[places]);
  }
  if (whole + places == 0 || whole + places > most_digits || (at != end && !ends_token(*at))) return nullptr;
  const double magnitude = static_cast<double>(digits) / powers[places];
  value = negative ? -magnitude : magnitude;
  return at;
}

}  // namespace

std::string describe(const Token& token) {
  switch (token.kind) {
    case Token::Kind::word:
      return fmt::format("the word {}", printable(token.text));
    case Token::Kind::number:
      return fmt::format("the number {}", printable(token.text));
    case Token::Kind::string:
      return fmt::format("the string \"{}\"", printable(token.text));
    case Token::Kind::open:
      return "\"[\"";
    case Token::Kind::close:
      return "\"]\"";
    case Token::Kind::end:
      break;
  }
  return "the end of the scene";
}

bool begins_directive(const Token& token) {
  return token.kind == Token::Kind::word && token.text[0] >= 'A' && token.text[0] <= 'Z';
}

std::string unescaped(const Token& token) {
  std::string value;
  value.reserve(token.text.size());
  for (std::size_t i = 0; i < token.text.size(); ++i) {
    const std::size_t escape =
        token.text[i] == '\\' && i + 1 < token.text.size() ? escapes.find(token.text[i + 1]) : std::string_view::npos;
    if (escape == std::string_view::npos) {
      value += token.text[i];
    } else {
      value += escaped[escape];
      ++i;
    }
  }
  return value;
}

NumberStatus read_number(std::string_view text, double& value) {
  const char* const end = text.data() + text.size();
  const char* const begin = number_begin(text, true);
  if (!begin) return NumberStatus::malformed;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (stop != end) return NumberStatus::malformed;
  if (error != std::errc() || std::abs(value) >= float_overflow) return NumberStatus::out_of_range;
  return NumberStatus::ok;
}

NumberStatus read_integer(std::string_view text, std::int64_t& value) {
  const char* const end = text.data() + text.size();
  const char* const begin = number_begin(text, false);
  if (!begin) return NumberStatus::malformed;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (stop != end) return NumberStatus::malformed;
  if (error != std::errc() || value < std::numeric_limits<std::int32_t>::min() ||
      value > std::numeric_limits<std::uint32_t>::max())
    return NumberStatus::out_of_range;
  return NumberStatus::ok;
}

void TokenStream::push(const Source& source) {
  cursors_.push_back({&source, source.text.data(), source.text.data(), 1, 0});
}

std::vector<const Source*> TokenStream::open_sources() const {
  std::vector<const Source*> sources;
  for (const Cursor& c : cursors_) sources.push_back(c.source);
  return sources;
}

Place TokenStream::place() const {
  const Cursor& c = cursors_.back();
  return {c.source, static_cast<std::size_t>(c.at - c.source->text.data()), to_int(c.line),
          to_int(c.at - c.line_begin - c.continuation_bytes + 1)};
}

bool TokenStream::skip_space() {
  while (!cursors_.empty()) {
    Cursor& c = cursors_.back();
    const char* const end = c.source->text.data() + c.source->text.size();
    while (c.at != end && (class_of(*c.at) == Class::space || *c.at == '#')) {
      if (*c.at == '#') {
        // Columns are those of tokens, and no token follows on this line.
        c.at = std::find(c.at, end, '\n');
      } else if (*c.at++ == '\n') {
        ++c.line;
        c.line_begin = c.at;
        c.continuation_bytes = 0;
      }
    }
    if (c.at != end) return true;
    end_ = place();
    cursors_.pop_back();
  }
  return false;
}

const Token& TokenStream::peek() {
  if (!peeked_) peeked_ = scan();
  return *peeked_;
}

Token TokenStream::next() {
  if (!peeked_) return scan();
  const Token token = *peeked_;
  peeked_.reset();
  return token;
}

Token TokenStream::scan() {
  if (!skip_space()) return {Token::Kind::end, {}, end_};
  Cursor& c = cursors_.back();
  if (*c.at == '"') return scan_string();
  Token token{Token::Kind::word, {}, place()};
  const char* const begin = c.at;
  const char* const end = c.source->text.data() + c.source->text.size();
  if (*c.at == '[' || *c.at == ']') {
    token.kind = *c.at == '[' ? Token::Kind::open : Token::Kind::close;
    ++c.at;
  } else {
    if (class_of(*c.at) == Class::number) token.kind = Token::Kind::number;
    for (; c.at != end && !ends_token(*c.at); ++c.at)
      c.continuation_bytes += (static_cast<unsigned char>(*c.at) & 0xc0) == 0x80;
  }
  token.text = {begin, static_cast<std::size_t>(c.at - begin)};
  return token;
}

Token TokenStream::scan_string() {
  Token token{Token::Kind::string, {}, place()};
  Cursor& c = cursors_.back();
  const char* const end = c.source->text.data() + c.source->text.size();
  const char* const begin = ++c.at;
  while (c.at != end && *c.at != '"' && *c.at != '\n') {
    if (*c.at == '\\' && c.at + 1 != end && c.at[1] != '\n') {
      if (escapes.find(c.at[1]) == std::string_view::npos && !quiet_)
        messages_.error(place(), fmt::format("unknown escape \"\\{}\" in a string; a backslash itself is written \\\\",
                                             printable({c.at + 1, 1})));
      ++c.at;
    }
    c.continuation_bytes += (static_cast<unsigned char>(*c.at) & 0xc0) == 0x80;
    ++c.at;
  }
  token.text = {begin, static_cast<std::size_t>(c.at - begin)};
  if (c.at != end && *c.at == '"')
    ++c.at;
  else if (!quiet_)
    messages_.error(token.place, "this string has no closing quote on its line");
  return token;
}

// The text of the number that stands next, or nothing; the cursor stays.
std::string_view TokenStream::number_run() {
  if (peeked_ || !skip_space()) return {};
  const Cursor& c = cursors_.back();
  if (class_of(*c.at) != Class::number) return {};
  const char* const end = c.source->text.data() + c.source->text.size();
  const char* stop = c.at;
  while (stop != end && !ends_token(*stop)) ++stop;
  return {c.at, static_cast<std::size_t>(stop - c.at)};
}

bool TokenStream::next_number(double& value) {
  if (peeked_ || !skip_space()) return false;
  Cursor& c = cursors_.back();
  if (const char* stop = read_short_number(c.at, c.source->text.data() + c.source->text.size(), value)) {
    c.at = stop;
    return true;
  }
  const std::string_view run = number_run();
  if (run.empty() || read_number(run, value) != NumberStatus::ok) return false;
  cursors_.back().at += run.size();
  return true;
}

bool TokenStream::next_integer(std::int64_t& value) {
  const std::string_view run = number_run();
  if (run.empty() || read_integer(run, value) != NumberStatus::ok) return false;
  cursors_.back().at += run.size();
  return true;
}

void TokenStream::skip_to_directive() {
  quiet_ = true;
  while (peek().kind != Token::Kind::end && !begins_directive(peek())) next();
  quiet_ = false;
}

}  // namespace brume

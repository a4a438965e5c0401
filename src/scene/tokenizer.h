// The words of the scene language: one stream of tokens over the files of a scene, an included file's tokens standing
// where its Include stands.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/messages.h"

namespace brume {

struct Token {
  enum class Kind {
    word,    // anything that is none of the others: a directive, true, false
    number,  // what begins like a number; read_number says whether it is one
    string,  // "..." on one line
    open,    // [
    close,   // ]
    end,     // of the scene
  };
  Kind kind = Kind::end;
  std::string_view text;  // of a string: what stands between its quotes, escapes as written
  Place place;
};

// What a message calls a token: `the number 5`.
std::string describe(const Token& token);

// True of a word with a capital: every directive begins so, and no value does. Reading goes on there after an error.
bool begins_directive(const Token& token);

// A string's value: its text with the escapes \b \f \n \r \t \\ \' \" replaced.
std::string unescaped(const Token& token);

enum class NumberStatus { ok, malformed, out_of_range };

// The value of a number token's text. A number is [+-] digits with at most one point and a decimal exponent; it is out
// of range where a float cannot hold it (an infinite or a wholly underflowing one).
NumberStatus read_number(std::string_view text, double& value);
// [+-] digits from -2^31 to 2^32 - 1.
NumberStatus read_integer(std::string_view text, std::int64_t& value);

class TokenStream {
 public:
  explicit TokenStream(Messages& messages) : messages_(messages) {}

  // Continues with the tokens of `source`, then with what came after. No token may have been peeked at.
  void push(const Source& source);
  // Whether any token of the sources from the `depth`th open one on is still to be read.
  bool is_open(std::size_t depth) const { return cursors_.size() >= depth; }
  // Open sources, the outermost first.
  std::vector<const Source*> open_sources() const;

  const Token& peek();
  Token next();

  // The fast path for lists: where a number stands next, and is one, its value; else false, and next() gives the token.
  bool next_number(double& value);
  bool next_integer(std::int64_t& value);

  // Drops tokens, without messages about them, up to the next directive.
  void skip_to_directive();

 private:
  struct Cursor {
    const Source* source;
    const char* at;
    const char* line_begin;
    std::int64_t line;
    std::int64_t continuation_bytes;  // of UTF-8, on this line: bytes that are no columns
  };

  Token scan();
  Token scan_string();
  bool skip_space();  // false at the end of all files
  std::string_view number_run();
  Place place() const;

  Messages& messages_;
  std::vector<Cursor> cursors_;
  std::optional<Token> peeked_;
  Place end_;
  bool quiet_ = false;
};

}  // namespace brume

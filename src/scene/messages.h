// Where things stand in a scene's files, and the messages about them: collected while reading, thrown once at the end.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"

namespace brume {

// The text of one file of a scene.
struct Source {
  std::string name;  // as messages show it
  std::string_view text;
  int order = 0;  // of the files of a scene, in the order in which they were first opened
};

// A place in a source. Columns count characters, not bytes.
struct Place {
  const Source* source = nullptr;
  std::size_t offset = 0;
  int line = 0, column = 0;
};
Location location(const Place& place);

// Leaves the directive being read, after an error was noted.
struct Abandon {};
// Leaves the reading altogether: there are as many errors as anybody wants to see.
struct TooManyErrors {};

// A name or token of the user's for a message, without quotes: shortened where it is long, and with what a terminal
// could take for a command replaced by '?'.
std::string printable(std::string_view text);

// `; did you mean "NAME"?` for the valid name nearest to `name`; else "; " with `otherwise`, or nothing where that is
// empty.
std::string suggestion(std::string_view name, const std::vector<std::string_view>& valid, const std::string& otherwise);

// "a, b and c"
std::string enumerate(const std::vector<std::string>& words, std::string_view conjunction);

class Messages {
 public:
  static constexpr std::size_t max_errors = 20, max_warnings = 100;

  // Strict: old spellings are errors.
  explicit Messages(bool strict = false) : strict_(strict) {}

  // Throws TooManyErrors with the last one that is kept. A message that the same place has already is not repeated.
  void error(const Place& place, const std::string& message);
  [[noreturn]] void fail(const Place& place, const std::string& message);
  // A message that was already given is not repeated.
  void warning(const Place& place, const std::string& message);
  // About what old scenes write otherwise than the language now has it: a warning, or an error where messages are
  // strict; not repeated.
  void old_spelling(const Place& place, const std::string& message);
  bool any_error() const { return !errors_.empty(); }

  // Appends the warnings to `warnings`, and returns the errors, both in the order of their places. Nothing is left
  // here.
  std::vector<Diagnostic> finish(std::vector<Diagnostic>& warnings);

 private:
  struct Entry {
    Diagnostic diagnostic;
    Place place;
    std::string message;  // without the excerpt that the diagnostic's may have
  };
  static std::vector<Diagnostic> sorted(std::vector<Entry>& entries);

  bool strict_;
  std::vector<Entry> errors_, warnings_;
  std::set<std::string> warned_;
};

}  // namespace brume

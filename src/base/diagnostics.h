// Errors as data: what was found, where, and what was expected. The library throws; it never prints and never exits.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace brume {

// A place in a file. line and column count from 1; line 0 means the file as a whole.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

enum class Severity { note, warning, error };

struct Diagnostic {
  Severity severity = Severity::error;
  Location location;
  std::string message;
  std::string source_line;  // the text of the line, where there is one
};

// The same number of characters, with control characters (but tabs and ends of lines) and broken UTF-8 replaced by '?':
// what comes from files cannot command a terminal.
std::string without_controls(std::string_view text);

// "file:line:column: error: message", and below it the line with a caret under the column.
std::string to_string(const Diagnostic& diagnostic);

// By line and column; files stay in the order in which they come first.
void sort_by_place(std::vector<Diagnostic>& diagnostics);

// What every operation of the library throws when its input is at fault. what() holds all diagnostics as text.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Diagnostic> diagnostics);
  InputError(const std::string& file, const std::string& message);
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

// The name nearest to `name` in edit distance, or "" where none is within a third of its length (at least 2).
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> valid);

}  // namespace brume

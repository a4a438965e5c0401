// What the commands share in reading their arguments.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "brume/parameter.h"

namespace CLI {
class App;
}

// Arguments that make no sense; what() is ready to be shown.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The name that is nearest to `given` in edit distance, or "" where none is near.
std::string nearest_name(const std::string& given, const std::vector<std::string>& names);

// What a command takes, and where its values go. Names are as CLI11 has them: "-o,--output", or "FILE" for an argument
// that is known by its place. CLI11 itself is included by command_line.cpp alone: it takes longer to compile than all
// else in a command.
class CommandLine {
 public:
  CommandLine();
  ~CommandLine();
  void flag(const std::string& names, bool& value);
  // A value that is given must not be empty.
  void option(const std::string& names, std::string& value);
  void option(const std::string& names, std::optional<std::string>& value);
  // May be repeated.
  void options(const std::string& names, std::vector<std::string>& values);
  // Throws UsageError, which for an unknown option names the nearest valid one. What follows "--" is no option.
  void parse(std::vector<std::string> arguments);

 private:
  std::unique_ptr<CLI::App> app_;
};

// A whole number from lo to hi, given for `option`; throws UsageError.
std::int64_t parse_number(const std::string& option, const std::string& text, std::int64_t lo, std::int64_t hi);
// A number from lo to hi, given for `option`; throws UsageError.
double parse_real(const std::string& option, const std::string& text, double lo, double hi);
// NAME=VALUE, a parameter's name and a number; `option` is what it was given for, with a space, or "". Throws
// UsageError.
std::pair<std::string, double> parse_setting(const std::string& option, const std::string& text);
// Shows each parameter on a line that begins with `indent`: name, range, default, meaning.
void show_parameters(const std::vector<brume::ParameterInfo>& parameters, const char* indent);
// A number of seconds above 0, given for `option`; throws UsageError.
double parse_seconds(const std::string& option, const std::string& text);

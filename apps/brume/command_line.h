// What the commands share in reading their arguments.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "brume/parameter.h"

// Arguments that make no sense; what() is ready to be shown.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Parses; throws UsageError, which for an unknown option names the nearest valid one.
void parse(CLI::App& app, std::vector<std::string> arguments);

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

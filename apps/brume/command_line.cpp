#include "command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace {

// Levenshtein's distance.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (const char c : a) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (c == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

// The option of `app` that `given` may have been meant to be, or "".
std::string nearest_option(const CLI::App& app, const std::string& given) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& long_name : option->get_lnames()) names.push_back("--" + long_name);
  return nearest_name(given.substr(0, given.find('=')), names);
}

// Whether a word that CLI11 took for a value is an option of `app`.
bool is_option(const CLI::App& app, const std::string& word) {
  return word.size() > 1 && word[0] == '-' && app.get_option_no_throw(word) != nullptr;
}

// What CLI11 says is for programmers; it begins with the option's name, or has it after the first colon.
std::string plain(const CLI::ParseError& e) {
  const std::string message = e.what();
  const std::size_t colon = message.find(':');
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&e))
    return message.substr(0, colon) +
           (message.find("received") == std::string::npos ? " needs a value" : " is given twice");
  if (dynamic_cast<const CLI::ConversionError*>(&e) && colon != std::string::npos)
    return message.substr(colon + 2, message.find(" = ") - colon - 2) + " takes no value";
  return message;
}

std::string unexpected(const CLI::App& app, const std::string& argument) {
  if (!argument.starts_with('-')) return "unexpected argument \"" + argument + "\"";
  const std::string nearest = nearest_option(app, argument);
  return "unknown option " + argument + (nearest.empty() ? "" : ", did you mean " + nearest + "?");
}

}  // namespace

std::string nearest_name(const std::string& given, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, given.size() / 3) + 1;
  for (const std::string& name : names)
    if (const std::size_t distance = edit_distance(given, name); distance < least) {
      least = distance;
      nearest = name;
    }
  return nearest;
}

CommandLine::CommandLine() : app_(std::make_unique<CLI::App>()) {
  app_->set_help_flag();  // help is ours
  // What is left over is looked at here and not by CLI11, whose message could not name the nearest option.
  app_->allow_extras();
}
CommandLine::~CommandLine() = default;

void CommandLine::flag(const std::string& names, bool& value) { app_->add_flag(names, value); }
void CommandLine::option(const std::string& names, std::string& value) { app_->add_option(names, value); }
void CommandLine::option(const std::string& names, std::optional<std::string>& value) {
  app_->add_option(names, value);
}
void CommandLine::options(const std::string& names, std::vector<std::string>& values) {
  CLI::Option* const option = app_->add_option(names, values);
  if (names.starts_with('-')) option->allow_extra_args(false);  // one value each time
}

void CommandLine::parse(std::vector<std::string> arguments) {
  for (const std::string& argument : arguments)
    if (argument.starts_with("--") && argument.size() > 3 && argument.ends_with('='))
      throw UsageError(argument.substr(0, argument.size() - 1) + " needs a value");
  std::reverse(arguments.begin(), arguments.end());  // the order in which CLI11 takes them
  try {
    app_->parse(arguments);
  } catch (const CLI::ParseError& e) {
    throw UsageError(plain(e));
  }
  for (const CLI::Option* option : app_->get_options())
    for (const std::string& value : option->results())
      if (value.empty() || is_option(*app_, value)) throw UsageError(option->get_name() + " needs a value");
  std::vector<std::string> extras = app_->remaining();
  std::erase(extras, "--");
  if (!extras.empty()) throw UsageError(unexpected(*app_, extras.front()));
}

std::int64_t parse_number(const std::string& option, const std::string& text, std::int64_t lo, std::int64_t hi) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < lo || value > hi)
    throw UsageError(option + ": \"" + text + "\" is not a whole number from " + std::to_string(lo) + " to " +
                     std::to_string(hi));
  return value;
}

double parse_real(const std::string& option, const std::string& text, double lo, double hi) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= lo && value <= hi)) {
    char range[64];
    std::snprintf(range, sizeof range, "%g to %g", lo, hi);
    throw UsageError(option + ": \"" + text + "\" is not a number from " + range);
  }
  return value;
}

std::pair<std::string, double> parse_setting(const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('=');
  double value = 0;
  const char* const end = text.data() + text.size();
  if (equals == std::string::npos || equals == 0)
    throw UsageError(option + "\"" + text + "\" is not NAME=VALUE, as in g=0.5");
  const auto [at, error] = std::from_chars(text.data() + equals + 1, end, value);
  if (error != std::errc() || at != end || !std::isfinite(value))
    throw UsageError(option + "\"" + text + "\": what follows = is not a number");
  return {text.substr(0, equals), value};
}

void show_parameters(const std::vector<brume::ParameterInfo>& parameters, const char* indent) {
  for (const brume::ParameterInfo& p : parameters) {
    char range[64];
    std::snprintf(range, sizeof range, p.ends_included ? "%g to %g%s%s" : "above %g, below %g%s%s", p.lo, p.hi,
                  p.unit == "1" ? "" : " ", p.unit == "1" ? "" : p.unit.c_str());
    std::printf("%s%-11s %-17s default %-5g %s\n", indent, p.name.c_str(), range, p.fallback, p.meaning.c_str());
  }
}

double parse_seconds(const std::string& option, const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value > 0 && value <= 1e9))
    throw UsageError(option + ": \"" + text + "\" is not a number of seconds above 0");
  return value;
}

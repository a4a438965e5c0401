#include "base/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace brume {

namespace {

std::string join(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics) {
    if (!text.empty()) text += '\n';
    text += to_string(d);
  }
  return text;
}

std::vector<Diagnostic> one_error(const std::string& file, const std::string& message) {
  std::vector<Diagnostic> diagnostics(1);
  diagnostics[0].location.file = file;
  diagnostics[0].message = message;
  return diagnostics;
}

// Levenshtein's distance, by one row of his table at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (const char letter : a) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (letter == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string to_string(const Diagnostic& d) {
  std::string place = d.location.file;
  if (d.location.line > 0) place += fmt::format(":{}:{}", d.location.line, d.location.column);
  std::string text = fmt::format("{}: {}: {}", place, d.severity == Severity::error ? "error" : "warning", d.message);
  if (!d.source_line.empty()) {
    // Tabs before the caret are kept as tabs, so that it stands under its column.
    std::string indent;
    for (int i = 0; i + 1 < d.location.column; ++i) {
      const auto at = static_cast<std::size_t>(i);
      indent += at < d.source_line.size() && d.source_line[at] == '\t' ? '\t' : ' ';
    }
    text += fmt::format("\n  {}\n  {}^", d.source_line, indent);
  }
  return text;
}

InputError::InputError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(join(diagnostics)), diagnostics_(std::move(diagnostics)) {}

InputError::InputError(const std::string& file, const std::string& message) : InputError(one_error(file, message)) {}

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> valid) {
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const std::string_view v : valid) {
    const std::size_t distance = edit_distance(name, v);
    if (distance < best_distance) {
      best = v;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace brume

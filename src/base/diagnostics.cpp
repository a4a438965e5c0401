#include "base/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

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

// The length of the UTF-8 sequence that begins at `at`, or 0 where there is none.
std::size_t sequence_length(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t length = lead < 0x80                   ? 1
                             : lead >= 0xc2 && lead < 0xe0 ? 2
                             : lead >= 0xe0 && lead < 0xf0 ? 3
                             : lead >= 0xf0 && lead < 0xf5 ? 4
                                                           : 0;
  if (at + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[at + i]) & 0xc0) != 0x80) return 0;
  return length;
}

}  // namespace

std::string without_controls(std::string_view text) {
  std::string clean;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence_length(text, i);
    const auto first = static_cast<unsigned char>(text[i]);
    const bool control = length == 1 ? (first < 0x20 && text[i] != '\t' && text[i] != '\n') || first == 0x7f
                                     : length == 2 && first == 0xc2 && static_cast<unsigned char>(text[i + 1]) < 0xa0;
    if (length == 0 || control) {
      // Continuation bytes do not count as columns, so they leave nothing behind.
      if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) clean += '?';
      ++i;
    } else {
      clean += text.substr(i, length);
      i += length;
    }
  }
  return clean;
}

std::string to_string(const Diagnostic& d) {
  std::string place = d.location.file;
  if (d.location.line > 0) place += fmt::format(":{}:{}", d.location.line, d.location.column);
  constexpr std::string_view names[] = {"note", "warning", "error"};
  std::string text = fmt::format("{}: {}: {}", place, names[static_cast<std::size_t>(d.severity)], d.message);
  if (!d.source_line.empty()) {
    // Tabs before the caret are kept as tabs, so that it stands under its column.
    std::string indent;
    for (int i = 0; i + 1 < d.location.column; ++i) {
      const auto at = static_cast<std::size_t>(i);
      indent += at < d.source_line.size() && d.source_line[at] == '\t' ? '\t' : ' ';
    }
    text += fmt::format("\n  {}\n  {}^", d.source_line, indent);
  }
  return without_controls(text);
}

void sort_by_place(std::vector<Diagnostic>& diagnostics) {
  std::map<std::string, std::size_t> order;
  for (const Diagnostic& d : diagnostics) order.try_emplace(d.location.file, order.size());
  const auto key = [&](const Diagnostic& d) {
    return std::tuple(order.at(d.location.file), d.location.line, d.location.column);
  };
  std::stable_sort(diagnostics.begin(), diagnostics.end(),
                   [&](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
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

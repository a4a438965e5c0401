#include "scene/messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "base/gzip.h"
#include "scene/read_scene.h"

namespace brume {

namespace {

constexpr std::size_t max_shown_name = 60;
constexpr std::size_t max_shown_line = 160;
constexpr std::size_t excerpt_before = 60, excerpt_after = 60;

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

// The line around a place, whole where it is short. Of a longer one an excerpt; where the place's column lies beyond
// what is shown, the excerpt has its own caret and goes into the message, since a diagnostic's caret stands under its
// column.
void add_source_line(Diagnostic& diagnostic, const Place& place) {
  const std::string_view text = place.source->text;
  const std::size_t offset = std::min(place.offset, text.size());
  std::size_t begin = offset, end = offset;
  while (begin > 0 && text[begin - 1] != '\n' && offset - begin < max_shown_line) --begin;
  while (end < text.size() && text[end] != '\n' && text[end] != '\r' && end - begin < 2 * max_shown_line) ++end;
  const bool from_start = begin == 0 || text[begin - 1] == '\n';
  if (from_start && end - begin <= max_shown_line) {
    diagnostic.source_line = without_controls(text.substr(begin, end - begin));
    return;
  }
  end = std::min(end, offset + excerpt_after);
  while (end < text.size() && is_continuation(text[end])) ++end;
  const bool to_end = end == text.size() || text[end] == '\n' || text[end] == '\r';
  const std::string_view tail = to_end ? "" : "...";
  if (from_start && offset - begin <= excerpt_before) {
    diagnostic.source_line = without_controls(text.substr(begin, end - begin)) + std::string(tail);
    return;
  }
  begin = std::max(begin, offset - std::min(offset, excerpt_before));
  while (begin < offset && is_continuation(text[begin])) ++begin;
  std::string before = without_controls(text.substr(begin, offset - begin));
  std::string after = without_controls(text.substr(offset, end - offset));
  std::replace(before.begin(), before.end(), '\t', ' ');
  const auto columns =
      static_cast<std::size_t>(std::count_if(before.begin(), before.end(), [](char c) { return !is_continuation(c); }));
  diagnostic.message += fmt::format("\n  ...{}{}{}\n  {}^", before, after, tail, std::string(columns + 3, ' '));
}

// The offset of a line and a column, or npos where the text has no such place.
std::size_t offset_of(std::string_view text, const Location& at) {
  std::size_t offset = 0;
  for (int line = 1; line < at.line; ++line) {
    offset = text.find('\n', offset);
    if (offset == std::string_view::npos) return offset;
    ++offset;
  }
  int column = 1;
  while (offset < text.size() && column < at.column)
    if (++offset < text.size() && !is_continuation(text[offset])) ++column;
  return offset < text.size() ? offset : std::string_view::npos;
}

// "" where it cannot be read.
std::string text_of(const std::string& file) {
  try {
    return read_file_unpacked(file);
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

void add_source_lines(std::vector<Diagnostic>& diagnostics) {
  std::map<std::string, std::string> texts;
  for (Diagnostic& d : diagnostics) {
    const Location at = d.location;
    if (at.line == 0) continue;
    const auto [entry, is_new] = texts.try_emplace(at.file);
    if (is_new) entry->second = text_of(at.file);
    const Source source{at.file, entry->second};
    const std::size_t offset = offset_of(source.text, at);
    if (offset != std::string_view::npos) add_source_line(d, {&source, offset, at.line, at.column});
  }
}

Location location(const Place& place) {
  return {place.source ? place.source->name : std::string(), place.line, place.column};
}

std::string printable(std::string_view text) {
  std::size_t end = std::min(text.size(), max_shown_name);
  while (end > 0 && end < text.size() && is_continuation(text[end])) --end;
  std::string shown = without_controls(text.substr(0, end));
  std::replace(shown.begin(), shown.end(), '\n', '?');
  return end < text.size() ? shown + "..." : shown;
}

std::string suggestion(std::string_view name, const std::vector<std::string_view>& valid,
                       const std::string& otherwise) {
  // The distance takes time proportional to the product of the lengths; nobody mistypes a name of this length.
  const std::string_view nearest = name.size() > 1 && name.size() <= max_shown_name ? nearest_name(name, valid) : "";
  if (!nearest.empty()) return fmt::format("; did you mean \"{}\"?", printable(nearest));
  return otherwise.empty() ? std::string() : "; " + otherwise;
}

std::string enumerate(const std::vector<std::string>& words, std::string_view conjunction) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 < words.size() ? ", " : fmt::format(" {} ", conjunction);
    text += words[i];
  }
  return text;
}

void Messages::error(const Place& place, const std::string& message) {
  const auto is_same = [&](const Entry& e) {
    return e.place.source == place.source && e.place.offset == place.offset && e.place.line == place.line &&
           e.message == message;
  };
  if (std::any_of(errors_.begin(), errors_.end(), is_same)) return;
  Entry entry{{Severity::error, location(place), message, {}}, place, message};
  if (place.source && place.line > 0) add_source_line(entry.diagnostic, place);
  errors_.push_back(std::move(entry));
  if (errors_.size() >= max_errors) throw TooManyErrors{};
}

void Messages::fail(const Place& place, const std::string& message) {
  error(place, message);
  throw Abandon{};
}

void Messages::warning(const Place& place, const std::string& message) {
  if (warnings_.size() >= max_warnings || !warned_.insert(message).second) return;
  Entry entry{{Severity::warning, location(place), message, {}}, place, message};
  if (place.source && place.line > 0) add_source_line(entry.diagnostic, place);
  warnings_.push_back(std::move(entry));
}

void Messages::old_spelling(const Place& place, const std::string& message) {
  if (!strict_)
    warning(place, message);
  else if (warned_.insert(message).second)
    error(place, message);
}

std::vector<Diagnostic> Messages::sorted(std::vector<Entry>& entries) {
  const auto key = [](const Entry& e) {
    return std::tuple(e.place.source ? e.place.source->order : 0, e.place.line, e.place.column);
  };
  std::stable_sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) { return key(a) < key(b); });
  std::vector<Diagnostic> diagnostics;
  for (Entry& e : entries) diagnostics.push_back(std::move(e.diagnostic));
  return diagnostics;
}

std::vector<Diagnostic> Messages::finish(std::vector<Diagnostic>& warnings) {
  for (Diagnostic& d : sorted(warnings_)) warnings.push_back(std::move(d));
  return sorted(errors_);
}

}  // namespace brume

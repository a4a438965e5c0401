#include "brume/statistics.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/file.h"
#include "session/errors.h"

namespace brume {

namespace {

// "12,345,678"
std::string grouped(std::int64_t number) {
  std::string digits = std::to_string(number);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), 1, ',');
  return digits;
}

std::string line(const std::string& name, const std::string& value, const std::string& note = {}) {
  return fmt::format("  {:<26} {:>18}{}{}\n", name, value, note.empty() ? "" : "   ", note);
}

std::string seconds(double s) { return fmt::format("{:.3f} s", s); }
std::string megabytes(std::int64_t bytes) { return fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(bytes)); }

}  // namespace

std::string Statistics::table() const {
  const auto number_of_samples = static_cast<double>(std::max<std::int64_t>(samples, 1));
  std::string text =
      fmt::format("{}, {}, {}, {} thread{}\n", software, integrator, instruction_set, threads, threads == 1 ? "" : "s");
  text += line("reading the scene", seconds(reading_seconds));
  text += line("preparing it", seconds(preparing_seconds));
  text += line("rendering", seconds(rendering_seconds));
  text += line("samples", grouped(samples),
               fmt::format("{} a second", grouped(static_cast<std::int64_t>(static_cast<double>(samples) /
                                                                            std::max(rendering_seconds, 1e-9)))));
  const auto count = [&](const char* name, std::int64_t value, const std::string& note = {}) {
    if (value == 0) return;
    const std::string share = fmt::format("{:.3g} a sample", static_cast<double>(value) / number_of_samples);
    text += line(name, grouped(value), note.empty() ? share : share + note);
  };
  count("rays", rays);
  count("shadow rays", shadow_rays);
  count("collisions with media", collisions);
  count("hits of surfaces", surface_hits);
  count("cells of majorants", majorant_cells);
  count("look-ups of density", look_ups, integrator == "classic" ? ", those of shadow rays not counted" : "");
  count("violations of majorants", majorant_violations);
  count("samples left out", invalid_samples);
  if (volume_bytes > 0) text += line("memory of volumes", megabytes(volume_bytes));
  text += line("memory in all, at most", megabytes(peak_bytes));
  return text;
}

void Statistics::write(const std::string& path) const {
  // The strings have no characters that JSON would want escaped.
  std::string json = fmt::format(
      "{{\n  \"software\": \"{}\",\n  \"instruction_set\": \"{}\",\n  \"integrator\": \"{}\",\n  \"threads\": {}",
      software, instruction_set, integrator, threads);
  const auto member = [&](const char* name, auto value) { json += fmt::format(",\n  \"{}\": {}", name, value); };
  member("reading_seconds", reading_seconds);
  member("preparing_seconds", preparing_seconds);
  member("rendering_seconds", rendering_seconds);
  member("samples", samples);
  member("rays", rays);
  member("shadow_rays", shadow_rays);
  member("collisions", collisions);
  member("surface_hits", surface_hits);
  member("majorant_cells", majorant_cells);
  member("look_ups", look_ups);
  member("majorant_violations", majorant_violations);
  member("invalid_samples", invalid_samples);
  member("volume_bytes", volume_bytes);
  member("peak_bytes", peak_bytes);
  with_public_errors([&] { write_file_atomically(path, json + "\n}\n"); });
}

void Statistics::check_output(const std::string& path) {
  with_public_errors([&] { check_writable(path); });
}

}  // namespace brume

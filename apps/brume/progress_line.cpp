#include "progress_line.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>

std::string clock_text(double seconds) {
  const auto s = static_cast<long long>(std::lround(std::min(seconds, 1e9)));
  char text[32];
  if (s < 3600)
    std::snprintf(text, sizeof text, "%lld:%02lld", s / 60, s % 60);
  else
    std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", s / 3600, s / 60 % 60, s % 60);
  return text;
}

namespace {

// ", 1.25 million samples a second"; "" where it is not known.
std::string speed_text(double samples_per_second) {
  char text[64] = "";
  if (samples_per_second >= 1e5)
    std::snprintf(text, sizeof text, ", %.3g million samples a second", 1e-6 * samples_per_second);
  else if (samples_per_second > 0)
    std::snprintf(text, sizeof text, ", %.0f samples a second", samples_per_second);
  return text;
}

}  // namespace

ProgressLine::ProgressLine(bool quiet) : visible_(!quiet && isatty(STDERR_FILENO)) {}

void ProgressLine::show(const brume::Progress& progress) {
  if (!visible_) return;
  const auto now = std::chrono::steady_clock::now();
  if (on_screen_ && now - shown_ < std::chrono::milliseconds(100)) return;
  shown_ = now;
  on_screen_ = true;
  const std::string remaining =
      progress.remaining_seconds < 0 ? "" : ", " + clock_text(progress.remaining_seconds) + " remaining";
  // ESC [K clears what a longer line may have left behind this one.
  std::fprintf(stderr, "\rRendering: %3.0f %%, %s elapsed%s%s\033[K", std::floor(100 * progress.fraction),
               clock_text(progress.elapsed_seconds).c_str(), remaining.c_str(),
               speed_text(progress.samples_per_second).c_str());
  std::fflush(stderr);
}

void ProgressLine::clear() {
  if (!on_screen_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  on_screen_ = false;
}

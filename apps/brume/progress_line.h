// The progress of a render as one line that is rewritten in place.
#pragma once

#include <chrono>
#include <string>

#include "brume/render.h"

class ProgressLine {
 public:
  // Shows nothing where stderr is no terminal or `quiet` is set.
  explicit ProgressLine(bool quiet);
  // Takes the line away, so that other messages can be printed.
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const brume::Progress& progress);
  void clear();

 private:
  bool visible_;
  bool on_screen_ = false;
  std::chrono::steady_clock::time_point shown_{};
};

// "0:07", "12:34", "1:02:03".
std::string clock_text(double seconds);

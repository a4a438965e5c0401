#include "base/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

namespace brume {

namespace {

// That of the machine, or what the process is allowed of it.
std::int64_t memory() {
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);  // where there is none, it is a number larger than any memory
  const auto machine = static_cast<rlim_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<rlim_t>(sysconf(_SC_PAGE_SIZE));
  return static_cast<std::int64_t>(std::min(limit.rlim_cur, machine));
}

}  // namespace

std::int64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;  // Linux counts in kilobytes
}

bool can_hold(std::int64_t bytes) { return bytes <= memory() / 2; }

std::size_t largest_text() { return static_cast<std::size_t>(memory() / 8); }

}  // namespace brume

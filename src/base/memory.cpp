#include "base/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

namespace brume {

std::int64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;  // Linux counts in kilobytes
}

std::size_t largest_text() {
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);  // where there is none, it is a number larger than any memory
  const auto machine = static_cast<rlim_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<rlim_t>(sysconf(_SC_PAGE_SIZE));
  return static_cast<std::size_t>(std::min(limit.rlim_cur, machine) / 8);
}

}  // namespace brume

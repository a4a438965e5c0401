#include "base/memory.h"

#include <sys/resource.h>
#include <unistd.h>

namespace brume {

std::int64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;  // Linux counts in kilobytes
}

bool can_hold(std::int64_t bytes) { return bytes / sysconf(_SC_PAGESIZE) <= sysconf(_SC_PHYS_PAGES) / 2; }

}  // namespace brume

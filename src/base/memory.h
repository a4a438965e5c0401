// How much memory this process takes.
#pragma once

#include <cstdint>

namespace brume {

// The most that was resident at any time, in bytes.
std::int64_t peak_memory();

}  // namespace brume

// How much memory this process takes, and may take.
#pragma once

#include <cstdint>

namespace brume {

// The most that was resident at any time, in bytes.
std::int64_t peak_memory();

// Whether this many bytes are at most half of the machine's memory.
bool can_hold(std::int64_t bytes);

}  // namespace brume

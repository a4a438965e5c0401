// How much memory this process takes, and what of the machine's one text may.
#pragma once

#include <cstddef>
#include <cstdint>

namespace brume {

// The most that was resident at any time, in bytes.
std::int64_t peak_memory();

// The most bytes of a text whose size does not show before it is there: packed, or from a pipe. An eighth of the
// memory, that of the machine or what the process is allowed of it; what is made of a text is larger than the text.
std::size_t largest_text();

}  // namespace brume

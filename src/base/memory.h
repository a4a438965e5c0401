// How much memory this process takes, and may take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <string>

#include "base/diagnostics.h"

namespace brume {

// The most that was resident at any time, in bytes.
std::int64_t peak_memory();

// Whether this many bytes are at most half of the memory: that of the machine, or what the process is allowed of it.
bool can_hold(std::int64_t bytes);

// The most bytes of a text whose size does not show before it is there: packed, or from a pipe. An eighth of the
// memory; what is made of a text is larger than the text.
std::size_t largest_text();

// What `read` makes of the file `name`. Where memory ends meanwhile, the InputError says by which file.
template <class Read>
auto read_within_memory(const std::string& name, Read&& read) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
    throw InputError(name, "cannot be read: not enough memory");
  }
}

}  // namespace brume

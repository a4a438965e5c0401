// Files that may be compressed by gzip.
#pragma once

#include <cstddef>
#include <string>

#include "base/memory.h"

namespace brume {

// The bytes of a file; where it is compressed by gzip, what begins with its mark says so and not its name, they come
// unpacked. Throws InputError where it cannot be read, is damaged, or unpacks to more than largest_text().
std::string read_file_unpacked(const std::string& path);

// The same for bytes at hand; `name` is for messages.
std::string unpacked(const std::string& name, std::string bytes, std::size_t largest = largest_text());

}  // namespace brume

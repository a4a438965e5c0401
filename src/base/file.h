// Files, whole or not at all.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace brume {

// The bytes of a file. Throws InputError where it cannot be read (missing, not a regular file, no permission).
std::string read_file(const std::string& path);

// All that comes from the standard input. Throws InputError, also where that is more than largest_text().
std::string read_standard_input();

// Has `write` make the file under a temporary name beside `path` (ending in ".part"), flushes it to disk and renames it
// to `path`, so that `path` holds the whole new file or whatever it held before. Where `path` is a symbolic link, the
// file that it points to is replaced. Where write throws, or anything fails, the temporary file is removed; a failure
// of the file system is an InputError that names `path`.
void write_file_atomically(const std::string& path, const std::function<void(const std::string& temporary)>& write);

// The same for bytes at hand.
void write_file_atomically(const std::string& path, std::string_view bytes);

// Throws InputError unless a file can be made or replaced at `path`: not a folder, in a folder that exists and may be
// written to.
void check_writable(const std::string& path);

// The lower-case suffix of a path with its dot (".png"), or "".
std::string suffix(const std::string& path);

}  // namespace brume

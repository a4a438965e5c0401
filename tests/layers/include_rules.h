// Which folder may include which: the table of docs/architecture.md, read from the page, and the check of a file by it.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace brume {

// A row of the table.
struct Room {
  bool everything = false;           // may include every other room
  std::set<std::string> rooms;       // those that it may include, by folder ("src/kernel") besides itself
  std::vector<std::string> outside;  // headers of other libraries: "png.h", "openvdb/" (a folder), "Imath*", "POSIX"
};

// Rooms by folder ("src/volume", "include/brume", "tests").
using Rooms = std::map<std::string, Room>;

// Reads the table that begins with "| folder |". Throws std::runtime_error where there is none or a row is malformed.
Rooms read_rooms(std::string_view page);

// What in a file's includes the table does not allow, each as "path:line: what is wrong". `path` is relative to the
// root.
std::vector<std::string> include_faults(const Rooms& rooms, const std::string& path, std::string_view text);

}  // namespace brume

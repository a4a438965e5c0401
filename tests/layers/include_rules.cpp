#include "layers/include_rules.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace brume {

namespace {

struct Include {
  int line = 0;
  bool quoted = false;
  std::string name;  // "" where the line is no include of a plain name
};

std::string trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t`");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t`") - first + 1));
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(trim(part));
  return parts;
}

std::vector<Include> includes_of(std::string_view text) {
  static const std::regex directive(R"(^\s*#\s*include\b)"), plain(R"(^\s*#\s*include\s*(["<])([^">]+)[">].*$)");
  std::vector<Include> found;
  std::istringstream stream{std::string(text)};
  int line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++line_number;
    if (!std::regex_search(line, directive)) continue;
    std::smatch match;
    if (std::regex_match(line, match, plain))
      found.push_back({line_number, match[1] == "\"", match[2]});
    else
      found.push_back({line_number, false, {}});
  }
  return found;
}

// The innermost room that a file lies in, or "".
std::string room_of(const Rooms& rooms, const std::string& path) {
  std::string innermost;
  for (const auto& [folder, room] : rooms)
    if (path.starts_with(folder + '/') && folder.size() > innermost.size()) innermost = folder;
  return innermost;
}

bool is_posix(const std::string& name) {
  static const std::set<std::string> posix{"fcntl.h",    "signal.h",    "stdlib.h",   "sys/mman.h", "sys/resource.h",
                                           "sys/stat.h", "sys/types.h", "sys/wait.h", "unistd.h"};
  return posix.contains(name);
}

// Whether `name` is one of `headers`, lies in one of the folders among them, or begins as one that ends in *.
bool listed(const std::vector<std::string>& headers, const std::string& name) {
  return std::any_of(headers.begin(), headers.end(), [&](const std::string& header) {
    if (header.ends_with('/')) return name.starts_with(header);
    if (header.ends_with('*')) return name.starts_with(header.substr(0, header.size() - 1));
    return name == header || (header == "POSIX" && is_posix(name));
  });
}

// The room that an include in quotes leads to: src and include are on the search path, so is a file's own folder, and
// the root for bench.
// "" where it leads to no room but to another library.
std::string target_room(const Rooms& rooms, const std::string& own, const std::string& name) {
  for (const char* parent : {"src/", "include/"})
    if (std::string room = room_of(rooms, parent + name); !room.empty()) return room;
  if (name.find('/') == std::string::npos || name.starts_with(own + '/')) return own;
  const bool outside =
      std::any_of(rooms.begin(), rooms.end(), [&](const auto& r) { return listed(r.second.outside, name); });
  return own.starts_with("tests") && !outside ? own : "";  // tests is on the search path of the tests
}

bool may_include_outside(const Room& room, const std::string& name, bool dispatched) {
  const bool standard = name.find_first_of("./") == std::string::npos;
  return standard || listed(room.outside, name) || (dispatched && name.starts_with("hwy/"));
}

}  // namespace

Rooms read_rooms(std::string_view page) {
  Rooms rooms;
  std::istringstream stream{std::string(page)};
  std::string line;
  while (std::getline(stream, line) && !line.starts_with("| folder |")) {
  }
  std::getline(stream, line);  // |---|
  while (std::getline(stream, line) && line.starts_with('|')) {
    const std::vector<std::string> cells = split(line, '|');
    if (cells.size() != 5) throw std::runtime_error("a row of the table has not four cells: " + line);
    Room room;
    for (const std::string& name : split(cells[3], ',')) {
      if (name == "all")
        room.everything = true;
      else if (!name.empty())
        room.rooms.insert(name.find('/') == std::string::npos ? "src/" + name : name);
    }
    for (const std::string& header : split(cells[4], ','))
      if (!header.empty()) room.outside.push_back(trim(header));
    rooms[cells[1]] = room;
  }
  if (rooms.empty()) throw std::runtime_error("no table that begins with \"| folder |\"");
  return rooms;
}

std::vector<std::string> include_faults(const Rooms& rooms, const std::string& path, std::string_view text) {
  const std::string own = room_of(rooms, path);
  if (own.empty()) return {path + ": its folder is not in the table"};
  const Room& room = rooms.at(own);
  const std::vector<Include> includes = includes_of(text);
  // Files that Highway compiles once per instruction set may use it; their room's row says so by naming this header.
  const bool dispatched =
      listed(room.outside, "hwy/foreach_target.h") &&
      std::any_of(includes.begin(), includes.end(), [](const Include& i) { return i.name == "hwy/foreach_target.h"; });

  std::vector<std::string> faults;
  for (const Include& include : includes) {
    const auto fault = [&](const std::string& what) {
      faults.push_back(path + ":" + std::to_string(include.line) + ": " + what);
    };
    if (include.name.empty()) {
      fault("an include that names no file");
    } else if (own == "src/kernel" && path.ends_with(".inl")) {
      fault("kernel files include nothing: " + include.name);
    } else if (include.name.find("..") != std::string::npos) {
      fault("includes are relative to src, not to the file: " + include.name);
    } else {
      const std::string target = include.quoted ? target_room(rooms, own, include.name) : "";
      if (target.empty() ? !may_include_outside(room, include.name, dispatched)
                         : target != own && !room.everything && !room.rooms.contains(target))
        fault(own + " may not include " + include.name);
    }
  }
  return faults;
}

}  // namespace brume

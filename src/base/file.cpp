#include "base/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <random>
#include <span>
#include <system_error>
#include <utility>

#include "base/diagnostics.h"
#include "base/memory.h"
#include "base/pieces.h"

namespace brume {

namespace {

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void throw_unwritable(const std::string& path, const std::string& why) {
  throw InputError(path, "cannot be written: " + why);
}

// A file descriptor that is closed at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  bool is_open() const { return number_ >= 0; }
  int number() const { return number_; }
  // Some file systems report a failed write only when the file is closed.
  bool close_checked() { return close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

// Removes the file at its end unless it was renamed away.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string path) : path_(std::move(path)) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!path_.empty()) unlink(path_.c_str());
  }
  const std::string& path() const { return path_; }
  bool rename_to(const std::string& target) {
    if (std::rename(path_.c_str(), target.c_str()) != 0) return false;
    path_.clear();
    return true;
  }

 private:
  std::string path_;
};

// The file that a chain of symbolic links ends in, which need not exist; `path` itself where it is no link.
std::string resolve_links(const std::string& path) {
  std::error_code error;
  std::filesystem::path at = path;
  for (int links = 0; links < 40 && std::filesystem::is_symlink(at, error); ++links) {
    const std::filesystem::path target = std::filesystem::read_symlink(at, error);
    if (error) break;
    at = at.parent_path() / target;  // an absolute target replaces the folder
  }
  return at.string();
}

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

// An empty file beside `target` under a name that nothing had. open() applies the caller's umask, which mkstemp would
// not.
std::string make_temporary(const std::string& path, const std::string& target) {
  static std::atomic<unsigned> counter = std::random_device{}();
  // The longest name that a file system takes is 255 bytes.
  const std::string name = std::filesystem::path(target).filename().string().substr(0, 200);
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::string temporary =
        fmt::format("{}/{}.{:x}-{:08x}.part", folder_of(target), name, getpid(), counter.fetch_add(1));
    const Descriptor file(open(temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666));
    if (file.is_open()) return temporary;
    if (errno != EEXIST) throw_unwritable(path, reason(errno));
  }
  throw_unwritable(path, "no unused temporary name beside it");
}

void flush_to_disk(const std::string& path, const std::string& temporary) {
  const Descriptor file(open(temporary.c_str(), O_RDONLY | O_CLOEXEC));
  // EINVAL: a file system that has nothing to flush to.
  if (!file.is_open() || (fsync(file.number()) != 0 && errno != EINVAL)) throw_unwritable(path, reason(errno));
}

void write_bytes(const std::string& path, const std::string& temporary, std::string_view bytes) {
  Descriptor file(open(temporary.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
  if (!file.is_open()) throw_unwritable(path, reason(errno));
  while (!bytes.empty()) {
    const ssize_t written = write(file.number(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw_unwritable(path, reason(errno));
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (!file.close_checked()) throw_unwritable(path, reason(errno));
}

// As many bytes as there are, up to the size of `to`; 0 at the end.
std::size_t read_some(const std::string& name, int descriptor, std::span<char> to) {
  for (;;) {
    const ssize_t got = read(descriptor, to.data(), to.size());
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) throw InputError(name, "cannot be read: " + reason(errno));
  }
}

}  // namespace

std::string read_file(const std::string& path) {
  const auto fail = [&](const std::string& why) { throw InputError(path, "cannot be read: " + why); };
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) fail(reason(errno));
  if (S_ISDIR(status.st_mode)) fail("it is a folder");
  if (!S_ISREG(status.st_mode)) fail("it is not a regular file");  // a device or a pipe might never end
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open()) fail(reason(errno));

  // One byte more than the size, so that the end shows without growing once more.
  const std::size_t expected = static_cast<std::size_t>(status.st_size) + 1;
  std::string bytes = read_within_memory(path, [&] { return std::string(expected, '\0'); });
  std::size_t size = 0;
  while (const std::size_t got = read_some(path, file.number(), std::span(bytes).subspan(size))) {
    size += got;
    if (size == bytes.size()) bytes.resize(2 * size);
  }
  bytes.resize(size);
  return bytes;
}

std::string read_standard_input() {
  const std::string name = "standard input";
  Pieces text(name, largest_text());
  while (const std::size_t got = read_some(name, STDIN_FILENO, text.room())) text.filled(got);
  return text.joined();
}

void check_writable(const std::string& path) {
  const std::string target = resolve_links(path), folder = folder_of(target);
  std::error_code error;
  if (path.empty()) throw_unwritable(path, "the file name is empty");
  if (std::filesystem::is_directory(target, error) || target.back() == '/') throw_unwritable(path, "it is a folder");
  const std::filesystem::file_status status = std::filesystem::status(target, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw_unwritable(path, "it is not a regular file");
  if (!std::filesystem::exists(folder, error)) throw_unwritable(path, fmt::format("there is no folder {}", folder));
  if (!std::filesystem::is_directory(folder, error)) throw_unwritable(path, fmt::format("{} is not a folder", folder));
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw_unwritable(path, fmt::format("folder {}: {}", folder, reason(errno)));
}

void write_file_atomically(const std::string& path, const std::function<void(const std::string& temporary)>& write) {
  check_writable(path);
  const std::string target = resolve_links(path);
  TemporaryFile temporary(make_temporary(path, target));
  write(temporary.path());
  flush_to_disk(path, temporary.path());
  if (!temporary.rename_to(target)) throw_unwritable(path, reason(errno));
}

void write_file_atomically(const std::string& path, std::string_view bytes) {
  write_file_atomically(path, [&](const std::string& temporary) { write_bytes(path, temporary, bytes); });
}

std::string suffix(const std::string& path) {
  std::string s = std::filesystem::path(path).extension().string();
  std::transform(s.begin(), s.end(), s.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return s;
}

}  // namespace brume

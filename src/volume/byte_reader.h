// Reads little-endian values from a file's bytes; a read beyond the end is an InputError and nothing else.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include "base/diagnostics.h"

namespace brume {

static_assert(std::endian::native == std::endian::little, "the volume formats are little-endian and read as they are");

class ByteReader {
 public:
  ByteReader(const std::string& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size() - at_) {
      fail(fmt::format("the file ends at byte {}, where {} more are expected", bytes_.size(),
                       size - (bytes_.size() - at_)));
    }
    const std::string_view taken = bytes_.substr(at_, size);
    at_ += size;
    return taken;
  }

  template <class T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }

  template <class T>
  void get_all(T& values) {
    const std::string_view taken = take(sizeof values);
    std::memcpy(&values, taken.data(), taken.size());
  }

  // A 32-bit length and as many characters.
  std::string_view string() { return take(get<std::uint32_t>()); }

  void seek(std::uint64_t position) {
    if (position > bytes_.size())
      fail(fmt::format("byte {} is referred to, but the file has {}", position, bytes_.size()));
    at_ = position;
  }
  std::uint64_t position() const { return at_; }
  std::size_t size() const { return bytes_.size(); }
  const std::string& file() const { return file_; }
  bool at_end() const { return at_ == bytes_.size(); }

  [[noreturn]] void fail(const std::string& message) const { throw InputError(file_, message); }

 private:
  const std::string& file_;
  std::string_view bytes_;
  std::uint64_t at_ = 0;
};

}  // namespace brume

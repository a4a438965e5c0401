#include "base/pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/diagnostics.h"

namespace brume {

Pieces::Pieces(std::string name, std::size_t largest) : name_(std::move(name)), largest_(largest) {}

std::span<char> Pieces::room() {
  if (free_ == 0) {
    free_ = std::clamp<std::size_t>(size_, std::size_t{1} << 16, std::size_t{1} << 26);
    pieces_.emplace_back(free_, '\0');
  }
  return std::span<char>(pieces_.back()).last(free_);
}

void Pieces::filled(std::size_t size) {
  size_ += size;
  free_ -= size;
  if (size_ > largest_)
    throw InputError(name_, fmt::format("has more than {} bytes of text, an eighth of the memory", largest_));
}

std::string Pieces::joined() {
  if (pieces_.empty()) return {};
  pieces_.back().resize(pieces_.back().size() - std::exchange(free_, 0));
  if (pieces_.size() == 1) return std::move(pieces_.front());
  std::string text;
  text.reserve(std::exchange(size_, 0));  // takes memory only as it is filled, while the pieces go
  for (; !pieces_.empty(); pieces_.pop_front()) text += pieces_.front();
  return text;
}

}  // namespace brume

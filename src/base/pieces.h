// A text that grows to a size that does not show before.
#pragma once

#include <cstddef>
#include <list>
#include <span>
#include <string>

namespace brume {

// Held in pieces, for a string that grows is twice in memory whenever it moves.
class Pieces {
 public:
  // `name` is for the message where there is more than `largest`.
  Pieces(std::string name, std::size_t largest);

  // Where the next bytes go, at least one; filled() says how many came. Throws InputError where there are too many.
  std::span<char> room();
  void filled(std::size_t size);

  // The whole text. Nothing is left here.
  std::string joined();

 private:
  std::string name_;
  std::size_t largest_, size_ = 0, free_ = 0;  // free_: of the last piece
  std::list<std::string> pieces_;
};

}  // namespace brume

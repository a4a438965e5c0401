// A file in memory, as OpenEXR reads it.
#pragma once

#include <OpenEXR/ImfIO.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace brume {

class ExrMemoryStream : public Imf::IStream {
 public:
  explicit ExrMemoryStream(std::string_view bytes) : Imf::IStream(""), bytes_(bytes) {}
  bool read(char to[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (count < 0 || position_ > bytes_.size() || size > bytes_.size() - position_)
      throw std::runtime_error("the file ends too early");
    std::copy_n(bytes_.data() + position_, size, to);
    position_ += size;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::string_view bytes_;
  std::size_t position_ = 0;
};

}  // namespace brume

// The entry of libFuzzer, for the target that the build names.
#include <cstddef>
#include <cstdint>

#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto run = [] {
    for (const brume::FuzzTarget& target : brume::fuzz_targets())
      if (target.name == FUZZ_TARGET) return target.run;
    return static_cast<void (*)(std::string_view)>(nullptr);
  }();
  run({reinterpret_cast<const char*>(data), size});
  return 0;
}

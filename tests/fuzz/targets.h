// What is fed with bytes of any kind: each target reads them as one of the formats of which we have a reader of our
// own, and returns where they are good or refused by InputError. Whatever else happens is a fault.
#pragma once

#include <string_view>
#include <vector>

namespace brume {

struct FuzzTarget {
  std::string_view name;  // also of its folder of tests/fuzz/corpus
  void (*run)(std::string_view bytes);
};

const std::vector<FuzzTarget>& fuzz_targets();

}  // namespace brume

#include "lanes/instruction_set.h"

#include <hwy/targets.h>

#include <cstdint>

namespace brume {

namespace {

struct Target {
  std::int64_t bit;
  InstructionSet set;
};

constexpr Target targets[] = {
    {HWY_AVX3, {"avx512", "AVX-512", 16}},
    {HWY_AVX2, {"avx2", "AVX2", 8}},
    {HWY_SSE4, {"sse4", "SSE4", 4}},
    {HWY_SCALAR, {"scalar", "one lane", 1}},
};

// What the machine has, whatever was asked for.
std::int64_t machine_targets() {
  static const std::int64_t supported = hwy::SupportedTargets() | HWY_SCALAR;
  return supported & HWY_TARGETS;
}

}  // namespace

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> sets;
  for (const Target& t : targets)
    if (machine_targets() & t.bit) sets.push_back(t.set);
  return sets;
}

InstructionSet current_instruction_set() {
  const std::int64_t usable = machine_targets() & hwy::SupportedTargets();
  for (const Target& t : targets)
    if (usable & t.bit) return t.set;
  return targets[3].set;
}

bool use_instruction_set(std::string_view name) {
  const std::int64_t has = machine_targets();
  if (name.empty()) {
    hwy::SetSupportedTargetsForTest(0);
    return true;
  }
  for (const Target& t : targets)
    if (t.set.name == name && (has & t.bit)) {
      hwy::SetSupportedTargetsForTest(t.bit);
      return true;
    }
  return false;
}

}  // namespace brume

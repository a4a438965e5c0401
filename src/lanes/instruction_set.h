// Which instruction set the lanes run on: the best that the machine has, unless a lower one is asked for.
#pragma once

#include <string_view>
#include <vector>

namespace brume {

struct InstructionSet {
  std::string_view name;   // as one asks for it: "avx512", "avx2", "sse4", "scalar"
  std::string_view title;  // as one reads it: "AVX-512", "AVX2", "SSE4", "one lane"
  int lanes = 1;           // floats that one operation takes
};

// The sets that the kernels were compiled for and that this machine has, best first.
std::vector<InstructionSet> available_instruction_sets();

// The set that dispatched kernels run on.
InstructionSet current_instruction_set();

// Makes dispatched kernels run on the set called `name`, in this whole process; "" goes back to the best. False, and
// nothing changes, where the name is unknown or the machine does not have the set. Not to be called while kernels run.
bool use_instruction_set(std::string_view name);

}  // namespace brume

#include "session/instruction_set_choice.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "base/diagnostics.h"
#include "lanes/instruction_set.h"

namespace brume {

void apply_instruction_set_choice() {
  const char* name = std::getenv("BRUME_ISA");
  if (!name || !*name || use_instruction_set(name)) return;
  std::string valid;
  for (const InstructionSet& set : available_instruction_sets())
    valid += fmt::format("{}{}", valid.empty() ? "" : ", ", set.name);
  throw InputError("BRUME_ISA",
                   fmt::format("\"{}\" is not an instruction set of this machine; it has {}", name, valid));
}

}  // namespace brume

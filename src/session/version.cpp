#include "session/version.h"

#include <fmt/format.h>

#include "brume/scene.h"
#include "lanes/instruction_set.h"
#include "session/errors.h"
#include "session/instruction_set_choice.h"

namespace brume {

std::string software_name() { return "Brume " BRUME_VERSION; }

std::string version_text() {
  return with_public_errors([] {
    apply_instruction_set_choice();
    std::string offered;
    for (const InstructionSet& set : available_instruction_sets())
      offered += fmt::format("{}{}", offered.empty() ? "" : ", ", set.title);
    const InstructionSet used = current_instruction_set();
    return fmt::format("{}\nInstruction sets of this machine: {}\nIn use: {}, {} lane{} at a time", software_name(),
                       offered, used.title, used.lanes, used.lanes == 1 ? "" : "s");
  });
}

}  // namespace brume

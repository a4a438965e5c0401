// The environment variable BRUME_ISA.
#pragma once

namespace brume {

// Makes the kernels use the instruction set that BRUME_ISA names; where it is not set, changes nothing. Throws
// InputError for a name that is unknown or that this machine does not have.
void apply_instruction_set_choice();

}  // namespace brume

// Which of the compiled instruction sets this run uses.
#pragma once

namespace magfsi::structure {

enum class InstructionSet { sse2, avx2, avx512 };

const char* name(InstructionSet set);

// The widest one that the machine has; the environment variable MAGFSI_ISA lowers it.
// Throws std::invalid_argument on another value of it.
InstructionSet choose_instruction_set();

}  // namespace magfsi::structure

// SPDX-License-Identifier: GPL-2.0-or-later
// Which of the compiled instruction sets a run uses (cmake/IsaVariants.cmake).
#pragma once

#include <vector>

namespace magfsi {

enum class InstructionSet { sse2, avx2, avx512 };

const char* name(InstructionSet set);

// What this machine can run, slowest first; sse2 is always there.
std::vector<InstructionSet> available_instruction_sets();

// The fastest, or the one that the environment variable MAGFSI_ISA names. Throws
// std::invalid_argument if that is unknown or this machine cannot run it.
InstructionSet choose_instruction_set();

}  // namespace magfsi

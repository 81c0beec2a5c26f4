// SPDX-License-Identifier: GPL-2.0-or-later
// Choice among the compiled instruction sets (cmake/IsaVariants.cmake) at run time.
#pragma once

#include <vector>

namespace magfsi {

// Instruction sets that kernels are compiled for, slowest first. avx2 includes FMA;
// avx512 stands for its parts F, DQ, VL and BW.
enum class InstructionSet { sse2, avx2, avx512 };

// Name of a set as in MAGFSI_ISA: "sse2", "avx2" or "avx512".
const char* name(InstructionSet set);

// The instruction sets that this machine can run, slowest first; sse2 is always among
// them.
std::vector<InstructionSet> available_instruction_sets();

// The fastest set of this machine, or the one that the environment variable MAGFSI_ISA
// names. Throws std::invalid_argument if that name is unknown or this machine cannot run
// the set.
InstructionSet choose_instruction_set();

}  // namespace magfsi

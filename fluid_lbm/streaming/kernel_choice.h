// Which instruction set the row kernels use on this machine.
#pragma once

#include <string>
#include <vector>

#include "fluid_lbm/fluid.h"
#include "fluid_lbm/streaming/kernels.h"

namespace magfsi::fluid {

struct NamedKernels {
    std::string name;  // "sse2", "avx2" or "avx512"
    KernelSet kernels;
};

// What this machine can run, slowest first; sse2 is always there.
std::vector<NamedKernels> available_kernels();

// The fastest, or the one that the environment variable MAGFSI_ISA names. Throws
// std::invalid_argument if that is unknown or this machine cannot run it.
NamedKernels choose_kernels();

// automatic becomes recursive_regularized. Robots of millimetres in water need a
// relaxation time of 0.501 to 0.51; there two-relaxation-time collision with its usual
// magic numbers diverges within milliseconds (its odd rate falls to 0.01), BGK runs but
// carries ghost modes, and the recursive-regularised one runs and costs 5 % more than
// BGK.
Collision choose_collision(Collision wanted);

RowKernels row_kernels(const KernelSet& kernels, Collision collision);

}  // namespace magfsi::fluid

// Which row kernels a run uses: instruction set, precision, collision.
#pragma once

#include <string>
#include <variant>
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

// The kernels of one run; Real is what its populations are stored as.
template <class Real>
struct ChosenKernels {
    RowKernels<Real> rows;
    MomentsKernel<Real> moments = nullptr;
};
using AnyKernels = std::variant<ChosenKernels<double>, ChosenKernels<float>>;

// collision: not automatic.
AnyKernels run_kernels(const KernelSet& kernels, Precision precision, Collision collision,
                       bool eddy_viscosity);

}  // namespace magfsi::fluid

// The row kernels as the rest of the solver sees them: function pointers, chosen once.
// Included by code for every instruction set: plain types only.
#pragma once

#include <cstddef>

namespace magfsi::fluid {

// See collide_row in row_kernel.h.
using RowKernel = void (*)(double* const* at, const double* const* force,
                           std::ptrdiff_t length, double omega);

// Density - 1 and sum of c f of the cells behind the 19 pointers, without collision.
// moments: four arrays of that length.
using MomentsKernel = void (*)(const double* const* at, std::ptrdiff_t length,
                               double* const* moments);

// The pair that a run uses: rows that carry a force, and all others.
struct RowKernels {
    RowKernel plain = nullptr;
    RowKernel forced = nullptr;
};

struct KernelSet {
    RowKernels bgk, recursive_regularized;
    MomentsKernel moments = nullptr;
};

}  // namespace magfsi::fluid

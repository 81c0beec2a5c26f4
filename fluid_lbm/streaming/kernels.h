// The row kernels as the rest of the solver sees them: function pointers, chosen once.
// Included by code for every instruction set: plain types only.
#pragma once

#include <cstddef>

#include "fluid_lbm/collision/rates.h"
#include "fluid_lbm/collision/registered.h"

namespace magfsi::fluid {

// See collide_row in row_kernel.h. Real: what populations are stored as. False if a cell
// is no longer sound (collision/watch.h).
template <class Real>
using RowKernel = bool (*)(Real* const* at, const Real* const* force,
                           std::ptrdiff_t length, const CollisionParameters& parameters);

// Density - 1 and sum of c f of the cells behind the 19 pointers, without collision, in
// double. moments: four arrays of that length.
template <class Real>
using MomentsKernel = void (*)(const Real* const* at, std::ptrdiff_t length,
                               double* const* moments);

// The kernels that a run uses: rows that carry a force, and all others.
template <class Real>
struct RowKernels {
    RowKernel<Real> plain = nullptr;
    RowKernel<Real> forced = nullptr;
};

template <class Real>
struct CollisionKernels {
    Collision kind = Collision::automatic;
    RowKernels<Real> laminar, with_eddy_viscosity;
};

// One precision.
template <class Real>
struct KernelTable {
    CollisionKernels<Real> collisions[RegisteredCollisions::count];
    MomentsKernel<Real> moments = nullptr;
};

// One instruction set.
struct KernelSet {
    const KernelTable<double>* on_double = nullptr;
    const KernelTable<float>* on_float = nullptr;
    const KernelTable<float>* on_float_in_double =
        nullptr;  // float stored, double computed
};

}  // namespace magfsi::fluid

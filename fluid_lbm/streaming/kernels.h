// SPDX-License-Identifier: GPL-2.0-or-later
// The row kernels as the rest of the solver sees them: function pointers, chosen once per
// run. This header is included by code of every instruction set, so it has plain types
// only.
#pragma once

#include <cstddef>

#include "fluid_lbm/collision/cells.h"
#include "fluid_lbm/options.h"

namespace magfsi::fluid {

// Collision and streaming of a row (collide_row in row_kernel.h). Real: the type that
// populations are stored as. Returns false if a cell fails CellCheck.
template <class Real>
using RowKernel = bool (*)(Real* const* at, const Real* const* force,
                           std::ptrdiff_t length, const CollisionParameters& parameters);

// Density - 1 and momentum (sum of c f) of the cells behind the 19 pointers, without a
// collision and in double. moments: four arrays of that length.
template <class Real>
using MomentsKernel = void (*)(const Real* const* at, std::ptrdiff_t length,
                               double* const* moments);

// Conversion between populations and the ten numbers of a cell's flow that levels of a
// refined grid exchange (refinement/flow_kernel.h): ten arrays of `length` values. ahead:
// distance to the row that is read next, in elements. FlowKernel leaves the stress out if
// the pointer to its first array is null.
constexpr int flow_numbers = 10;
// Index of the first component of the stress, which comes last.
constexpr std::size_t first_stress = 4;
template <class Real>
using FlowKernel = void (*)(const Real* const* at, std::ptrdiff_t length,
                            double* const* flow, std::ptrdiff_t ahead);
template <class Real>
using RebuildKernel = void (*)(const double* const* flow, std::ptrdiff_t length,
                               Real* const* at);

// The kernels that a run uses.
template <class Real>
struct RowKernels {
    RowKernel<Real> plain = nullptr;
    RowKernel<Real> forced = nullptr;  // for rows that carry a force
    MomentsKernel<Real> moments = nullptr;
    FlowKernel<Real> flow = nullptr;
    RebuildKernel<Real> rebuild = nullptr;
};

// Source of a viscosity that varies from cell to cell.
enum class LocalViscosity { none, eddies, rheology };

// The kernels of one collision.
template <class Real>
struct CollisionKernels {
    Collision kind = Collision::automatic;
    RowKernels<Real> by_viscosity[3];  // in the order of LocalViscosity
    // The same with a rate of its own for the trace of the stress; empty if the collision
    // has none.
    RowKernels<Real> with_bulk[3];
};

// The kernels of all collisions for one precision.
template <class Real>
struct KernelTable {
    CollisionKernels<Real> collisions[8];  // unused ones at the end are of kind automatic
};

// All kernels of one instruction set.
struct KernelSet {
    KernelTable<double> on_double;
    KernelTable<float> on_float;
};

}  // namespace magfsi::fluid

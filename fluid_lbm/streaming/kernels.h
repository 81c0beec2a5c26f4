// SPDX-License-Identifier: GPL-2.0-or-later
// The row kernels as the rest of the solver sees them: function pointers, chosen once.
// Included by code for every instruction set: plain types only.
#pragma once

#include <cstddef>

#include "fluid_lbm/collision/cells.h"
#include "fluid_lbm/options.h"

namespace magfsi::fluid {

// See collide_row in row_kernel.h. Real: what populations are stored as. False if a cell
// fails CellCheck.
template <class Real>
using RowKernel = bool (*)(Real* const* at, const Real* const* force,
                           std::ptrdiff_t length, const CollisionParameters& parameters);

// Density - 1 and sum of c f of the cells behind the 19 pointers, without collision, in
// double. moments: four arrays of that length.
template <class Real>
using MomentsKernel = void (*)(const Real* const* at, std::ptrdiff_t length,
                               double* const* moments);

// Between populations and what levels of a refined grid tell each other, ten arrays of
// that length: see refinement/flow_kernel.h. ahead: elements to what is read next.
// flow: the stress is not read where its first array is null.
constexpr int flow_numbers = 10;
constexpr std::size_t first_stress = 4;  // it comes last
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

// What a cell adds to the viscosity by its own stress.
enum class LocalViscosity { none, eddies, rheology };

template <class Real>
struct CollisionKernels {
    Collision kind = Collision::automatic;
    RowKernels<Real> by_viscosity[3];  // in the order of LocalViscosity
};

template <class Real>
struct KernelTable {
    CollisionKernels<Real> collisions[8];  // those at the end that are unused: automatic
};

// One instruction set.
struct KernelSet {
    KernelTable<double> on_double;
    KernelTable<float> on_float;
    KernelTable<float> on_float_in_double;  // float stored, double computed
};

}  // namespace magfsi::fluid

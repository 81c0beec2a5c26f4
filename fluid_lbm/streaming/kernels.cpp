// SPDX-License-Identifier: GPL-2.0-or-later
// The row kernels of all collisions and precisions. This file is compiled once for each
// instruction set (cmake/IsaVariants.cmake).
#include "fluid_lbm/collision/bgk.h"
#include "fluid_lbm/collision/recursive_regularized.h"
#include "fluid_lbm/collision/shear_dependent.h"
#include "fluid_lbm/collision/smagorinsky.h"
#include "fluid_lbm/collision/trt.h"
#include "fluid_lbm/refinement/flow_kernel.h"
#include "fluid_lbm/streaming/row_kernel.h"

namespace magfsi::fluid::MAGFSI_ISA {
namespace {

// Collision of a row. Real: the type of the populations; C: the collision.
template <class Real, class C, bool Forced>
bool collide(Real* const* at, const Real* const* force, std::ptrdiff_t length,
             const CollisionParameters& parameters) {
    using V = typename Simd<Real, vector_bytes / sizeof(Real)>::Vector;
    return collide_row<C, Forced, V>(at, force, length, parameters);
}

template <class Real>
void sample(const Real* const* at, std::ptrdiff_t length, double* const* moments) {
    sample_row<vector_bytes / sizeof(double)>(at, length, moments);
}

// Reading of a row's flow, with the stress if the caller gives an array for it.
template <class Real>
void flow(const Real* const* at, std::ptrdiff_t length, double* const* flow,
          std::ptrdiff_t ahead) {
    constexpr int width = vector_bytes / sizeof(double);
    if (flow[first_stress])
        flow_row<width, true>(at, length, flow, ahead);
    else
        flow_row<width, false>(at, length, flow, ahead);
}

template <class Real, TraceRate Trace>
void rebuild(const double* const* flow, std::ptrdiff_t length, Real* const* at) {
    rebuild_row<vector_bytes / sizeof(double), Trace>(flow, length, at);
}

template <class Real, class C, TraceRate Trace>
constexpr RowKernels<Real> row_kernels_of() {
    return {collide<Real, C, false>, collide<Real, C, true>, sample<Real>, flow<Real>,
            rebuild<Real, Trace>};
}

// A collision with one rate for all of the stress.
template <class Real, class C>
constexpr CollisionKernels<Real> kernels_of() {
    constexpr TraceRate trace = C::trace;
    return {
        C::kind,
        {row_kernels_of<Real, C, trace>(), row_kernels_of<Real, Smagorinsky<C>, trace>(),
         row_kernels_of<Real, ShearDependent<C>, trace>()},
        {}};
}
// A collision whose trace may have a rate of its own.
template <class Real, template <TraceRate> class C>
constexpr CollisionKernels<Real> kernels_with_bulk() {
    CollisionKernels<Real> kernels = kernels_of<Real, C<TraceRate::viscous>>();
    const CollisionKernels<Real> own = kernels_of<Real, C<TraceRate::own>>();
    for (int i = 0; i < 3; ++i) kernels.with_bulk[i] = own.by_viscosity[i];
    return kernels;
}

// Table of all collisions. A new collision takes a header like bgk.h, an enumerator with
// its word in options.h, and its name in this list.
template <class Real>
constexpr KernelTable<Real> table() {
    return {{kernels_of<Real, Bgk>(), kernels_with_bulk<Real, TwoRelaxationTimes>(),
             kernels_with_bulk<Real, RecursiveRegularized>(),
             kernels_with_bulk<Real, RecursiveMrt>()}};
}

}  // namespace

extern const KernelSet kernels;
constinit const KernelSet kernels = {table<double>(), table<float>()};

}  // namespace magfsi::fluid::MAGFSI_ISA

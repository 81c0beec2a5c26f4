// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/streaming/kernel_choice.h"

#include <stdexcept>

namespace magfsi::fluid {

// Kernels of each instruction set, from the variants of kernels.cpp.
namespace sse2 {
extern const KernelSet kernels;
}
namespace avx2 {
extern const KernelSet kernels;
}
namespace avx512 {
extern const KernelSet kernels;
}

namespace {

template <class Real>
RowKernels<Real> choose(const KernelTable<Real>& table, Collision collision,
                        LocalViscosity viscosity, TraceRate trace) {
    for (const CollisionKernels<Real>& kernels : table.collisions) {
        if (kernels.kind != collision) continue;
        const int which = static_cast<int>(viscosity);
        if (trace == TraceRate::viscous) return kernels.by_viscosity[which];
        if (kernels.with_bulk[which].plain) return kernels.with_bulk[which];
    }
    throw std::invalid_argument(
        "no kernel is registered for collision " + std::string(name_of(collision)) +
        (trace == TraceRate::own ? " with a bulk viscosity of its own" : ""));
}

}  // namespace

AnyKernels choose_kernels(InstructionSet set, Precision precision, Collision collision,
                          LocalViscosity viscosity, TraceRate trace) {
    const KernelSet& kernels = set == InstructionSet::sse2   ? sse2::kernels
                               : set == InstructionSet::avx2 ? avx2::kernels
                                                             : avx512::kernels;
    if (precision == Precision::float_)
        return choose(kernels.on_float, collision, viscosity, trace);
    return choose(kernels.on_double, collision, viscosity, trace);
}

}  // namespace magfsi::fluid

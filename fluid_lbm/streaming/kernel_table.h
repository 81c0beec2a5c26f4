// The table of row kernels of one precision, for files that cmake/IsaVariants.cmake
// compiles once for each instruction set.
#pragma once

#include "fluid_lbm/collision/smagorinsky.h"
#include "fluid_lbm/sampling/moments_kernel.h"
#include "fluid_lbm/streaming/kernels.h"
#include "fluid_lbm/streaming/row_kernel.h"

namespace magfsi::fluid::MAGFSI_ISA {

#if defined(MAGFSI_ISA_avx512)
constexpr int vector_bytes = 64;
#elif defined(MAGFSI_ISA_avx2)
constexpr int vector_bytes = 32;
#else
constexpr int vector_bytes = 16;
#endif

// Real is stored, T computed with.
template <class Real, class T, class C, bool Forced>
static bool collide(Real* const* at, const Real* const* force, std::ptrdiff_t length,
                    const CollisionParameters& parameters) {
    using V = typename Simd<T, vector_bytes / sizeof(T)>::Vector;
    return collide_row<C, Forced, V>(at, force, length, parameters,
                                     collide<Real, T, C, Forced>);
}

template <class Real>
static void sample(const Real* const* at, std::ptrdiff_t length, double* const* moments) {
    sample_row<vector_bytes / sizeof(double)>(at, length, moments);
}

template <class Real, class T, class C>
constexpr RowKernels<Real> row_kernels() {
    return {collide<Real, T, C, false>, collide<Real, T, C, true>};
}

template <class Real, class T, class... Kinds>
constexpr KernelTable<Real> kernel_table(CollisionList<Kinds...>) {
    return {{{Kinds::kind, row_kernels<Real, T, Kinds>(),
              row_kernels<Real, T, Smagorinsky<Kinds>>()}...},
            sample<Real>};
}

}  // namespace magfsi::fluid::MAGFSI_ISA

// Compiled once for each instruction set (cmake/IsaVariants.cmake).
#include "fluid_lbm/streaming/kernels.h"

#include "fluid_lbm/collision/bgk.h"
#include "fluid_lbm/collision/recursive_regularized.h"
#include "fluid_lbm/sampling/moments_kernel.h"
#include "fluid_lbm/streaming/row_kernel.h"

namespace magfsi::fluid::MAGFSI_ISA {

#if defined(MAGFSI_ISA_avx512)
constexpr int width = 8;
#elif defined(MAGFSI_ISA_avx2)
constexpr int width = 4;
#else
constexpr int width = 2;
#endif

static void bgk(double* const* at, const double* const* force, std::ptrdiff_t length,
                double omega) {
    collide_row<Bgk, false, width>(at, force, length, omega);
}

static void bgk_forced(double* const* at, const double* const* force,
                       std::ptrdiff_t length, double omega) {
    collide_row<Bgk, true, width>(at, force, length, omega);
}

static void recursive(double* const* at, const double* const* force,
                      std::ptrdiff_t length, double omega) {
    collide_row<RecursiveRegularized, false, width>(at, force, length, omega);
}

static void recursive_forced(double* const* at, const double* const* force,
                             std::ptrdiff_t length, double omega) {
    collide_row<RecursiveRegularized, true, width>(at, force, length, omega);
}

static void sample(const double* const* at, std::ptrdiff_t length,
                   double* const* moments) {
    sample_row<width>(at, length, moments);
}

extern const KernelSet kernels;
const KernelSet kernels = {{bgk, bgk_forced}, {recursive, recursive_forced}, sample};

}  // namespace magfsi::fluid::MAGFSI_ISA

// What the viscous kernel reads. Plain pointers only, because this header is compiled for
// several instruction sets (cmake/IsaVariants).
#pragma once

#include "structure/lattice/element_batches.h"

namespace magfsi::structure {

// Entries an element of ViscousBatches::data: V0, then for bricks the three mean
// gradients B_x, B_y, B_z [1/m] and the inverse squares of the half edges; in general the
// 21 gradients, 9 metrics and 12 offsets of ElementModes.
constexpr int viscous_entries(bool bricks) {
    return bricks ? 7 : 43;
}

// Layout as ElementBatches.
struct ViscousBatches {
    bool bricks = true;
    int element_count = 0;
    const int* node = nullptr;
    const double* data = nullptr;
    double viscosity_pa_s = 0;
    double plate_lambda_pa_s = 0;
};

// Adds the forces and returns the dissipation [W].
using ViscousKernelFunction = double (*)(const ViscousBatches& batches, const double* x,
                                         const double* v, double* f);

namespace sse2 {
double run_viscous(const ViscousBatches&, const double* x, const double* v, double* f);
}
namespace avx2 {
double run_viscous(const ViscousBatches&, const double* x, const double* v, double* f);
}
namespace avx512 {
double run_viscous(const ViscousBatches&, const double* x, const double* v, double* f);
}

}  // namespace magfsi::structure

// SPDX-License-Identifier: GPL-2.0-or-later
// What the kernels read: elements in batches of eight, lane by lane. Plain pointers only,
// because this header is compiled for several instruction sets (cmake/IsaVariants.cmake).
#pragma once

namespace magfsi::structure {

inline constexpr int batch_lanes = 8;

enum class KernelKind {
    brick_full,
    brick_mean_f,
    brick_assumed_strain,
    general_full,
    general_mean_f,
    general_assumed_strain
};

constexpr bool is_brick(KernelKind kind) {
    return kind == KernelKind::brick_full || kind == KernelKind::brick_mean_f ||
           kind == KernelKind::brick_assumed_strain;
}

// Entries per element of ElementBatches::gradient and ::hourglass.
constexpr int gradient_entries(KernelKind kind) {
    return is_brick(kind) || kind == KernelKind::general_full ? 0 : 21;
}
constexpr int hourglass_entries(KernelKind kind) {
    return kind == KernelKind::brick_assumed_strain     ? 3
           : kind == KernelKind::general_assumed_strain ? 18
                                                        : 0;
}

// All arrays are 64-byte aligned, [batch][entry][lane]. Lanes past the last element
// repeat it.
struct ElementBatches {
    KernelKind kind = KernelKind::brick_full;
    int element_count = 0;
    const int* node = nullptr;         // 8 entries: index of node a in x and f
    const double* spring = nullptr;    // 7 entries for bricks, 28 in general [N/m]
    const double* gradient = nullptr;  // mean F of a general element [1/m]
    // brick: inverse squares of the half edges [1/m2]; general: ElementModes' metric and
    // offset.
    const double* hourglass = nullptr;
    const double* volume = nullptr;  // 1 entry: V0 [m3]
    double shear_modulus_pa = 0;
    double lame_lambda_pa = 0;
};

struct KernelResult {
    double energy_j = 0;    // zero where it was not asked for
    double smallest_j = 1;  // minus infinity where J is NaN
    int element = -1;       // of smallest J: its position among the batches' elements
};

// Adds the forces [N] on the nodes to f, three values per node as in x [m]. With
// want_energy also sums the elements' energies. Element order is fixed, and so is every
// rounding.
using ElementKernelFunction = KernelResult (*)(const ElementBatches& batches,
                                               const double* x, double* f,
                                               bool want_energy);

// Entries per element of ViscousBatches::data: V0, then for bricks the three mean
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

#define MAGFSI_KERNELS_OF(isa)                                                          \
    namespace isa {                                                                     \
    KernelResult run_elements(const ElementBatches&, const double* x, double* f, bool); \
    double run_viscous(const ViscousBatches&, const double* x, const double* v,         \
                       double* f);                                                      \
    }
MAGFSI_KERNELS_OF(sse2)
MAGFSI_KERNELS_OF(avx2)
MAGFSI_KERNELS_OF(avx512)
#undef MAGFSI_KERNELS_OF

}  // namespace magfsi::structure

// SPDX-License-Identifier: GPL-2.0-or-later
// Data layout of the kernels: elements in batches of eight, lane by lane. Plain pointers
// only, because this header is compiled for several instruction sets
// (cmake/IsaVariants.cmake).
#pragma once

namespace magfsi::structure {

// Elements in a batch, whatever the instruction set.
inline constexpr int batch_lanes = 8;

// Variant of the element, with a faster form for bricks.
enum class KernelKind {
    brick_full,
    brick_assumed_strain,
    general_full,
    general_assumed_strain
};

constexpr bool is_brick(KernelKind kind) {
    return kind == KernelKind::brick_full || kind == KernelKind::brick_assumed_strain;
}

// Entries per element of ElementBatches::gradient and ::hourglass.
constexpr int gradient_entries(KernelKind kind) {
    return kind == KernelKind::general_assumed_strain ? 21 : 0;
}
constexpr int hourglass_entries(KernelKind kind) {
    return kind == KernelKind::brick_assumed_strain     ? 3
           : kind == KernelKind::general_assumed_strain ? 18
                                                        : 0;
}

// Coefficients of a law of strain stiffening.
inline constexpr int stiffening_coefficients = 10;

// Factor of the springs and the hourglass energy of a material that stiffens
// (stiffening.h), with s = I1 - 3:
//   f(s) = pole / (limit - s) + sum_k coefficient[k] s^k,
// and its tangent beyond s = straight_from. The initial values are the factor 1.
struct StiffeningLaw {
    double pole = 0;
    double limit = 1e300, straight_from = 1e300;  // none
    double coefficient[stiffening_coefficients] = {1};
};

// Elements of one material and kind. All arrays are 64-byte aligned in the order
// [batch][entry][lane]. Lanes past the last element repeat it.
struct ElementBatches {
    KernelKind kind = KernelKind::brick_full;
    int element_count = 0;
    const int* node = nullptr;         // 8 entries: index of node a in x and f
    const double* spring = nullptr;    // 7 entries for bricks, 28 in general [N/m]
    const double* gradient = nullptr;  // 21 entries for general_assumed_strain [1/m]
    // Data of the hourglass energy. Bricks: inverse squares of the half edges [1/m2];
    // general elements: metric and offset of ElementModes.
    const double* hourglass = nullptr;
    const double* volume = nullptr;  // 1 entry: V0 [m3]
    double shear_modulus_pa = 0;
    double lame_lambda_pa = 0;
    const StiffeningLaw* stiffening = nullptr;  // null: neo-Hookean
};

// Result over all elements of a call.
struct KernelResult {
    double energy_j = 0;    // zero if it was not requested
    double smallest_j = 1;  // minus infinity where J is NaN
    // Position of the element of smallest J among the batches' elements; -1 without
    // elements
    int element = -1;
    // Of elements that stiffen, the largest (I1 - 3) over its limit and its element, as
    // above; 0 and -1 without any
    double largest_share = 0;
    int tight_element = -1;
};

// A kernel. Adds the forces [N] on the nodes to f, three values per node as in the
// positions x [m]. With want_energy it also sums the elements' energies. The order of the
// elements is fixed, so that results are the same in every bit on every run.
using ElementKernelFunction = KernelResult (*)(const ElementBatches& batches,
                                               const double* x, double* f,
                                               bool want_energy);

// Entries per element of ViscousBatches::data. Bricks: V0, the three mean gradients B_x,
// B_y, B_z [1/m] and the inverse squares of the half edges. General elements: V0 and the
// 21 gradients, 9 metrics and 12 offsets of ElementModes.
constexpr int viscous_entries(bool bricks) {
    return bricks ? 7 : 43;
}

// Viscous elements of one material, in the layout of ElementBatches.
struct ViscousBatches {
    bool bricks = true;
    int element_count = 0;
    const int* node = nullptr;
    const double* data = nullptr;
    double viscosity_pa_s = 0;
    double plate_lambda_pa_s = 0;
};

// A viscous kernel. Adds the forces [N] at positions x [m] and velocities v [m/s] to f;
// returns the dissipation [W].
using ViscousKernelFunction = double (*)(const ViscousBatches& batches, const double* x,
                                         const double* v, double* f);

// Numbers that an element's strains and each of its Maxwell branches have
// (maxwell_kernel.h): six of the mean F, nine of the hourglass vectors xy, xz, yz, three
// of xyz.
inline constexpr int maxwell_numbers = 18;

// Factors of one branch for a step: the part of its strain that is left after it, the
// part of the step's strain that it takes up, its modulus [Pa] and its rate 1 / time
// [1/s].
struct MaxwellFactors {
    double decay = 1, gain = 0, modulus_pa = 0, rate_1_s = 0;
};

// Elements of one material with branches, in the layout of ElementBatches.
struct MaxwellBatches {
    bool bricks = true;
    int element_count = 0;
    const int* node = nullptr;
    const double* data = nullptr;  // as ViscousBatches::data
    // maxwell_numbers entries of the strains at the last positions, then as many of each
    // branch
    double* state = nullptr;
    int branch_count = 0;
    const MaxwellFactors* branches = nullptr;
    double plate_lambda = 0;  // of a plate, over the modulus
};

// Result over all elements of a call.
struct MaxwellResult {
    double dissipation_w = 0;
    double energy_j = 0;  // stored in the branches; zero if it was not requested
};

// A kernel. Takes the branches from the last positions to x and adds their forces [N].
using MaxwellKernelFunction = MaxwellResult (*)(const MaxwellBatches& batches,
                                                const double* x, double* f,
                                                bool want_energy);

// Each instruction set has the kernels in a namespace of its own.
#define MAGFSI_KERNELS_OF(isa)                                                          \
    namespace isa {                                                                     \
    KernelResult run_elements(const ElementBatches&, const double* x, double* f, bool); \
    double run_viscous(const ViscousBatches&, const double* x, const double* v,         \
                       double* f);                                                      \
    MaxwellResult run_maxwell(const MaxwellBatches&, const double* x, double* f, bool); \
    }
MAGFSI_KERNELS_OF(sse2)
MAGFSI_KERNELS_OF(avx2)
MAGFSI_KERNELS_OF(avx512)
#undef MAGFSI_KERNELS_OF

}  // namespace magfsi::structure

// The mean deformation gradient F = sum_m u_m B_m^T of general elements in mode space,
// `width` elements at a time. For the files of magfsi_isa_variants only.
#pragma once

#include "structure/lattice/element_batches.h"
#include "structure/lattice/simd_lanes.h"

namespace magfsi::structure::MAGFSI_ISA {
namespace {

// Columns of F = sum_m u_m B_m^T.
MAGFSI_INLINE void mean_gradient(const double* gradient, const Vec (&u)[8], Vec (&f)[3]) {
    for (Vec& column : f) column = {Real{}, Real{}, Real{}};
    for (int m = 1; m < 8; ++m) {
        for (int d = 0; d < 3; ++d) {
            f[d] = f[d] + load(gradient + (3 * (m - 1) + d) * batch_lanes) * u[m];
        }
    }
}

// Stress on F (an eighth of V0 P, one column a reference direction) to the modes.
MAGFSI_INLINE void add_stress(const double* gradient, const Vec (&stress)[3],
                              Vec (&g)[8]) {
    for (int m = 1; m < 8; ++m) {
        for (int d = 0; d < 3; ++d) {
            g[m] = g[m] + load(gradient + (3 * (m - 1) + d) * batch_lanes) * stress[d];
        }
    }
}

// v_j less what a homogeneous deformation makes of it, F X_j; and back for the forces w_j
// on v_j.
template <int count>
MAGFSI_INLINE void take_off_linear(const double* offset, const Vec (&f)[3],
                                   Vec (&v)[count]) {
    for (int j = 0; j < count; ++j) {
        for (int d = 0; d < 3; ++d) {
            v[j] = v[j] - load(offset + (3 * j + d) * batch_lanes) * f[d];
        }
    }
}
template <int count>
MAGFSI_INLINE void return_linear(const double* offset, const Vec (&w)[count],
                                 Vec (&stress)[3]) {
    for (int j = 0; j < count; ++j) {
        for (int d = 0; d < 3; ++d) {
            stress[d] = stress[d] - load(offset + (3 * j + d) * batch_lanes) * w[j];
        }
    }
}

}  // namespace
}  // namespace magfsi::structure::MAGFSI_ISA

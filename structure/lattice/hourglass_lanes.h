// The hourglass energy of hourglass.h, `width` elements at a time. Included by
// element_kernel_isa.cpp only.
#pragma once

#include "structure/lattice/element_batches.h"
#include "structure/lattice/simd_lanes.h"

namespace magfsi::structure::MAGFSI_ISA {
namespace {

// Strain (E_11, E_22, 2 E_12) of one group, or the stress that belongs to it.
struct Plane {
    Real first, second, shear;
};

// Factors of the stress, dE / d(8 t) so that it adds to minus the forces on the modes.
struct HourglassModuli {
    Real g, lambda;
};

MAGFSI_INLINE HourglassModuli hourglass_moduli(const ElementBatches& b, const Real& v0) {
    const double g = b.shear_modulus_pa;
    const double lambda = 2 * g * b.lame_lambda_pa / (b.lame_lambda_pa + 2 * g);
    return {v0 * (g / 12), v0 * (lambda / 24)};
}

// Orthogonal edges: p and q are the inverse squares of the half edges.
MAGFSI_INLINE Plane plane_stress(const HourglassModuli& c, const Real& p, const Real& q,
                                 const Plane& strain) {
    const Real first = p * strain.first;
    const Real second = q * strain.second;
    const Real trace = c.lambda * (first + second);
    return {p * (c.g * first + trace), q * (c.g * second + trace),
            0.5 * c.g * p * q * strain.shear};
}

// Any edges: the inverse metric is [[p, r], [r, q]].
MAGFSI_INLINE Plane plane_stress(const HourglassModuli& c, const double* metric,
                                 const Plane& strain) {
    const Real p = load(metric);
    const Real q = load(metric + batch_lanes);
    const Real r = load(metric + 2 * batch_lanes);
    const Real half = 0.5 * strain.shear;
    const Real m11 = p * strain.first + r * half;
    const Real m12 = p * half + r * strain.second;
    const Real m21 = r * strain.first + q * half;
    const Real m22 = r * half + q * strain.second;
    const Real trace = c.lambda * (m11 + m22);
    return {c.g * (m11 * p + m12 * r) + trace * p, c.g * (m21 * r + m22 * q) + trace * q,
            c.g * (m11 * r + m12 * q) + trace * r};
}

// Adds to the edge modes of g what the hourglass vectors xy, xz, yz of u do, puts minus
// the forces on these vectors into w, and returns the energy / 4.
template <bool brick>
MAGFSI_INLINE Real hourglass(const ElementBatches& b, const double* data, const Real& v0,
                             const Vec& xy, const Vec& xz, const Vec& yz,
                             const Vec (&u)[8], Vec (&g)[8], Vec (&w)[3]) {
    const Vec &u1 = u[1], &u2 = u[2], &u3 = u[4];
    const Plane along_x{dot(u2, xy), dot(u3, xz), dot(u2, xz) + dot(u3, xy)};
    const Plane along_y{dot(u1, xy), dot(u3, yz), dot(u1, yz) + dot(u3, xy)};
    const Plane along_z{dot(u1, xz), dot(u2, yz), dot(u1, yz) + dot(u2, xz)};
    const HourglassModuli c = hourglass_moduli(b, v0);
    Plane sx, sy, sz;
    if constexpr (brick) {
        const Real ix = load(data);
        const Real iy = load(data + batch_lanes);
        const Real iz = load(data + 2 * batch_lanes);
        sx = plane_stress(c, iy, iz, along_x);
        sy = plane_stress(c, ix, iz, along_y);
        sz = plane_stress(c, ix, iy, along_z);
    } else {
        sx = plane_stress(c, data, along_x);
        sy = plane_stress(c, data + 3 * batch_lanes, along_y);
        sz = plane_stress(c, data + 6 * batch_lanes, along_z);
    }
    const Real u1_yz = sy.shear + sz.shear;
    const Real u2_xz = sx.shear + sz.shear;
    const Real u3_xy = sx.shear + sy.shear;
    g[1] = g[1] + sy.first * xy + sz.first * xz + u1_yz * yz;
    g[2] = g[2] + sx.first * xy + u2_xz * xz + sz.second * yz;
    g[4] = g[4] + u3_xy * xy + sx.second * xz + sy.second * yz;
    w[0] = sy.first * u1 + sx.first * u2 + u3_xy * u3;
    w[1] = sz.first * u1 + u2_xz * u2 + sx.second * u3;
    w[2] = u1_yz * u1 + sz.second * u2 + sy.second * u3;
    return dot(w[0], xy) + dot(w[1], xz) + dot(w[2], yz);
}

}  // namespace
}  // namespace magfsi::structure::MAGFSI_ISA

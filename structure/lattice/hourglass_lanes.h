// Strains and stresses of hourglass.h, `width` elements at a time. For the files of
// magfsi_isa_variants only.
#pragma once

#include "structure/lattice/element_batches.h"
#include "structure/lattice/simd_lanes.h"

namespace magfsi::structure::MAGFSI_ISA {
namespace {

// Strain (E_11, E_22, 2 E_12) of one group, or the stress that belongs to it.
struct Plane {
    Real first, second, shear;
};

// The groups of hourglass.h: strains that vary along x, y and z.
struct Planes {
    Plane x, y, z;
};

MAGFSI_INLINE Plane operator+(const Plane& a, const Plane& b) {
    return {a.first + b.first, a.second + b.second, a.shear + b.shear};
}
MAGFSI_INLINE Planes operator+(const Planes& a, const Planes& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
MAGFSI_INLINE Real dot(const Plane& a, const Plane& b) {
    return a.first * b.first + a.second * b.second + a.shear * b.shear;
}
MAGFSI_INLINE Real dot(const Planes& a, const Planes& b) {
    return dot(a.x, b.x) + dot(a.y, b.y) + dot(a.z, b.z);
}

// An eighth of V0 (2 G / 3, lambda' / 3): the stress then adds to minus the forces on the
// modes.
struct HourglassModuli {
    Real g, lambda;
};

MAGFSI_INLINE HourglassModuli hourglass_moduli(double g, double lambda, const Real& v0) {
    return {v0 * (g / 12), v0 * (lambda / 24)};
}

// Products of the edge modes of u and the hourglass vectors v = xy, xz, yz.
MAGFSI_INLINE Planes hourglass_strain(const Vec (&u)[8], const Vec (&v)[3]) {
    const Vec &u1 = u[1], &u2 = u[2], &u3 = u[4];
    return {{dot(u2, v[0]), dot(u3, v[1]), dot(u2, v[1]) + dot(u3, v[0])},
            {dot(u1, v[0]), dot(u3, v[2]), dot(u1, v[2]) + dot(u3, v[0])},
            {dot(u1, v[1]), dot(u2, v[2]), dot(u1, v[2]) + dot(u2, v[1])}};
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

// metric: three entries for bricks (inverse squares of the half edges), nine in general.
template <bool brick>
MAGFSI_INLINE Planes hourglass_stress(const HourglassModuli& c, const double* metric,
                                      const Planes& strain) {
    if constexpr (brick) {
        const Real ix = load(metric);
        const Real iy = load(metric + batch_lanes);
        const Real iz = load(metric + 2 * batch_lanes);
        return {plane_stress(c, iy, iz, strain.x), plane_stress(c, ix, iz, strain.y),
                plane_stress(c, ix, iy, strain.z)};
    } else {
        return {plane_stress(c, metric, strain.x),
                plane_stress(c, metric + 3 * batch_lanes, strain.y),
                plane_stress(c, metric + 6 * batch_lanes, strain.z)};
    }
}

// Minus the forces: added to the edge modes of g, and put into w for the vectors v.
MAGFSI_INLINE void hourglass_forces(const Planes& s, const Vec (&u)[8], const Vec (&v)[3],
                                    Vec (&g)[8], Vec (&w)[3]) {
    const Vec &u1 = u[1], &u2 = u[2], &u3 = u[4];
    const Real u1_yz = s.y.shear + s.z.shear;
    const Real u2_xz = s.x.shear + s.z.shear;
    const Real u3_xy = s.x.shear + s.y.shear;
    g[1] = g[1] + s.y.first * v[0] + s.z.first * v[1] + u1_yz * v[2];
    g[2] = g[2] + s.x.first * v[0] + u2_xz * v[1] + s.z.second * v[2];
    g[4] = g[4] + u3_xy * v[0] + s.x.second * v[1] + s.y.second * v[2];
    w[0] = s.y.first * u1 + s.x.first * u2 + u3_xy * u3;
    w[1] = s.z.first * u1 + u2_xz * u2 + s.x.second * u3;
    w[2] = u1_yz * u1 + s.z.second * u2 + s.y.second * u3;
}

}  // namespace
}  // namespace magfsi::structure::MAGFSI_ISA

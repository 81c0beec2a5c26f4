// The non-equilibrium part of the second-order moment.
#pragma once

#include "fluid_lbm/collision/simd.h"

namespace magfsi::fluid {

// Symmetric tensor; off-diagonal entries in the order xy, xz, yz.
template <class V>
struct Symmetric {
    V xx, yy, zz, xy, xz, yz;
};

template <class V>
MAGFSI_INLINE Symmetric<V> outer(const V (&a)[3], const V (&b)[3]) {
    return {a[0] * b[0], a[1] * b[1], a[2] * b[2], a[0] * b[1], a[0] * b[2], a[1] * b[2]};
}

// Half of u F + F u.
template <class V>
MAGFSI_INLINE Symmetric<V> half_force_stress(const V (&u)[3], const V (&force)[3]) {
    return {u[0] * force[0],
            u[1] * force[1],
            u[2] * force[2],
            0.5 * (u[0] * force[1] + u[1] * force[0]),
            0.5 * (u[0] * force[2] + u[2] * force[0]),
            0.5 * (u[1] * force[2] + u[2] * force[1])};
}

template <class V>
MAGFSI_INLINE Symmetric<V> add(const Symmetric<V>& a, const Symmetric<V>& b) {
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}

template <class V>
MAGFSI_INLINE Symmetric<V> scaled(const V& s, const Symmetric<V>& a) {
    return {s * a.xx, s * a.yy, s * a.zz, s * a.xy, s * a.xz, s * a.yz};
}

// Sum over all nine entries squared.
template <class V>
MAGFSI_INLINE V squared_norm(const Symmetric<V>& a) {
    return (a.xx * a.xx + a.yy * a.yy + a.zz * a.zz) +
           2.0 * (a.xy * a.xy + a.xz * a.xz + a.yz * a.yz);
}

// Sum of c c f minus its equilibrium, rho u u + excess / 3.
template <class V>
MAGFSI_INLINE Symmetric<V> nonequilibrium(const V (&f)[d3q19::directions],
                                          const V& excess, const Symmetric<V>& ruu) {
    const V s7 = f[7] + f[8], s9 = f[9] + f[10], s11 = f[11] + f[12];
    const V s13 = f[13] + f[14], s15 = f[15] + f[16], s17 = f[17] + f[18];
    const V xy = s7 + s9, xz = s11 + s13, yz = s15 + s17;
    const V pressure = excess * constant<V>(d3q19::cs2);
    return {(f[1] + f[2]) + (xy + xz) - pressure - ruu.xx,
            (f[3] + f[4]) + (xy + yz) - pressure - ruu.yy,
            (f[5] + f[6]) + (xz + yz) - pressure - ruu.zz,
            s7 - s9 - ruu.xy,
            s11 - s13 - ruu.xz,
            s15 - s17 - ruu.yz};
}

}  // namespace magfsi::fluid

// The non-equilibrium part of the second-order moment.
#pragma once

#include "fluid_lbm/collision/moments.h"

namespace magfsi::fluid {

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

// Of the second moment: minus its equilibrium, rho u u + excess / 3.
template <class V>
MAGFSI_INLINE Symmetric<V> nonequilibrium(const MomentsToSecond<V>& m,
                                          const Symmetric<V>& ruu) {
    const V pressure = m.low.excess * constant<V>(d3q19::cs2);
    const Symmetric<V>& s = m.second;
    return {s.xx - pressure - ruu.xx,
            s.yy - pressure - ruu.yy,
            s.zz - pressure - ruu.zz,
            s.xy - ruu.xy,
            s.xz - ruu.xz,
            s.yz - ruu.yz};
}

}  // namespace magfsi::fluid

// SPDX-License-Identifier: GPL-2.0-or-later
// Moments of a cell's populations, the non-equilibrium stress, and Guo's body force, for
// a vector of cells at a time.
#pragma once

#include "base/isa/simd.h"
#include "fluid_lbm/lattice/d3q19.h"

namespace magfsi::fluid {

// c_q . a for Q, the first direction of a pair, without multiplications.
template <int Q, class V>
MAGFSI_INLINE V along(const V (&a)[3]) {
    static_assert(Q % 2 == 1, "the first direction of a pair");
    constexpr const int(&c)[3] = d3q19::c[Q];
    constexpr int first = c[0] != 0 ? 0 : c[1] != 0 ? 1 : 2;
    constexpr int second = c[0] != 0 && c[1] != 0 ? 1 : first != 2 && c[2] != 0 ? 2 : -1;
    if constexpr (second < 0) {
        return a[first];
    } else if constexpr (c[second] > 0) {
        return a[first] + a[second];
    } else {
        return a[first] - a[second];
    }
}

// Symmetric tensor; off-diagonal entries in the order xy, xz, yz.
template <class V>
struct Symmetric {
    V xx, yy, zz, xy, xz, yz;
};

// Moments of order zero and one: density - 1 and the momentum j = sum of c f.
template <class V>
struct Moments {
    V excess;
    V j[3];
};

// Sum and difference of the two populations of a pair of opposites.
template <class V>
struct SumDifference {
    V sum, difference;
};

// Sum and difference of f[Q] and f[Q + 1]. f: LaneCells, or any type with a vector at
// each of the 19 indices.
template <int Q, class Populations>
MAGFSI_INLINE auto pair_of(const Populations& f) {
    const auto first = f[Q], second = f[Q + 1];
    return SumDifference<VectorOf<Populations>>{first + second, first - second};
}

// Moments of order zero to two; second is the sum of c c f.
template <class V>
struct MomentsToSecond {
    Moments<V> low;
    Symmetric<V> second;
};

// The moments from the sums and differences of the nine pairs.
template <class Populations>
MAGFSI_INLINE MomentsToSecond<VectorOf<Populations>> moments_to_second(
    const Populations& f) {
    using V = VectorOf<Populations>;
    const SumDifference<V> x = pair_of<1>(f), y = pair_of<3>(f), z = pair_of<5>(f);
    const SumDifference<V> a = pair_of<7>(f), b = pair_of<9>(f);
    const V xy = a.sum + b.sum, dxy = a.sum - b.sum;
    V jx = x.difference + (a.difference + b.difference);
    V jy = y.difference + (a.difference - b.difference);
    const SumDifference<V> c = pair_of<11>(f), d = pair_of<13>(f);
    const V xz = c.sum + d.sum, dxz = c.sum - d.sum;
    jx += c.difference + d.difference;
    V jz = z.difference + (c.difference - d.difference);
    const SumDifference<V> e = pair_of<15>(f), g = pair_of<17>(f);
    const V yz = e.sum + g.sum, dyz = e.sum - g.sum;
    jy += e.difference + g.difference;
    jz += e.difference - g.difference;
    const V excess = ((x.sum + y.sum + z.sum) + (xy + xz + yz)) + f[0];
    return {{excess, {jx, jy, jz}},
            {x.sum + (xy + xz), y.sum + (xy + yz), z.sum + (xz + yz), dxy, dxz, dyz}};
}

// Moments of order zero and one. The second moment, which nothing reads, is left out by
// the compiler.
template <class Populations>
MAGFSI_INLINE Moments<VectorOf<Populations>> moments(const Populations& f) {
    return moments_to_second(f).low;
}

// The tensor a b, for vectors whose product is symmetric, as j and u.
template <class V>
MAGFSI_INLINE Symmetric<V> outer(const V (&a)[3], const V (&b)[3]) {
    return {a[0] * b[0], a[1] * b[1], a[2] * b[2], a[0] * b[1], a[0] * b[2], a[1] * b[2]};
}

// Half of the tensor u F + F u.
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

// The tensor a times s.
template <class V>
MAGFSI_INLINE Symmetric<V> scaled(const V& s, const Symmetric<V>& a) {
    return {s * a.xx, s * a.yy, s * a.zz, s * a.xy, s * a.xz, s * a.yz};
}

// A third of the trace.
template <class V>
MAGFSI_INLINE V mean_of_trace(const Symmetric<V>& a) {
    return constant<V>(1.0 / 3) * (a.xx + a.yy + a.zz);
}

// Adds s times the unit tensor.
template <class V>
MAGFSI_INLINE void add_isotropic(Symmetric<V>& a, const V& s) {
    a.xx += s;
    a.yy += s;
    a.zz += s;
}

// Sum of the squares of all nine entries.
template <class V>
MAGFSI_INLINE V squared_norm(const Symmetric<V>& a) {
    return (a.xx * a.xx + a.yy * a.yy + a.zz * a.zz) +
           2.0 * (a.xy * a.xy + a.xz * a.xz + a.yz * a.yz);
}

// Non-equilibrium stress: the second moment minus its equilibrium, rho u u + excess / 3.
// ruu: the tensor rho u u.
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

// Body force (Guo, Zheng, Shi 2002): the velocity of the collision is u = (sum c f + F /
// 2) / rho, and the source, before its factor (1 - omega / 2), is
//   S_q = w_q [3 (c - u) . F + 9 (c . u)(c . F)],
// with moments 0, F and u F + F u. Lattice units.

// A quantity of a pair of opposite directions: even part, the same for both, and odd
// part, with the sign of the first.
template <class V>
struct EvenOdd {
    V even, odd;
};

// Adds half of the force to the momentum.
template <class V>
MAGFSI_INLINE void shift_momentum(Moments<V>& m, const V (&force)[3]) {
    for (int a = 0; a < 3; ++a) m.j[a] += 0.5 * force[a];
}

// The source S of a pair; uf = u . F.
template <int Q, class V>
MAGFSI_INLINE EvenOdd<V> guo_source(const V (&u)[3], const V (&force)[3], const V& uf) {
    constexpr Lane<V> w3 = constant<V>(3 * d3q19::weight(Q));
    const V cf = along<Q>(force);
    return {w3 * (3.0 * along<Q>(u) * cf - uf), w3 * cf};
}

}  // namespace magfsi::fluid

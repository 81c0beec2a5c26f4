// SPDX-License-Identifier: GPL-2.0-or-later
// Collisions on Hermite moments with recursive third-order moments (Malaspinas 2015;
// Jacob, Malaspinas, Sagaut 2018). These follow from density, momentum and the second
// moment as
//   a_xxy = rho ux ux uy + (1 - omega) (2 ux n_xy + uy n_xx),
// n the non-equilibrium stress. All further moments of the lattice are ghost modes.
//
//   recursive_regularized  drops them: the most robust close to tau = 1/2. A rate of 1
//                          for third-order modes, however, is a magic number of
//                          (tau - 1/2) / 2, which falls with the time step, and so does
//                          the layer of fluid that walls and immersed bodies carry
//                          along.
//   recursive_mrt          keeps them: the deviation of odd third-order moments from the
//                          recursion relaxes with the magic number's rate, the even
//                          modes of fourth order with fourth_rate(). Walls and bodies
//                          then do not depend on the time step.
//
// Where the trace of n has a rate of its own (bulk_viscosity.h), the recursion takes n
// without it: after a collision a slow trace is far larger than what compression leaves
// in the third moments, and with it uniform flow becomes unstable from 0.15 cells a step
// on.
//
// D3Q19 supports six sums and differences of the third-order Hermite polynomials,
//   H_xxy +- H_yzz, H_xzz +- H_xyy, H_yyz +- H_xxz,
// and three of the fourth-order ones, xxyy, xxzz and yyzz.
#pragma once

#include "fluid_lbm/collision/cells.h"
#include "fluid_lbm/collision/moments.h"
#include "fluid_lbm/options.h"

namespace magfsi::fluid {

// The collision of either kind, recursive_regularized or recursive_mrt.
template <Collision Kind, TraceRate Trace>
struct Recursive {
    static constexpr Collision kind = Kind;
    static constexpr TraceRate trace = Trace;

    // Collides the cells of f in place and checks their state. force: force density, read
    // only if Forced.
    template <bool Forced, class V, class Real>
    MAGFSI_INLINE static void collide(const LaneCells<V, Real>& f, const V (&force)[3],
                                      const Rates<V>& rates, CellCheck<V>& check);
};
template <TraceRate Trace>
using RecursiveRegularized = Recursive<Collision::recursive_regularized, Trace>;
template <TraceRate Trace>
using RecursiveMrt = Recursive<Collision::recursive_mrt, Trace>;

// Third-order moments as sums and differences: [0] a_xzz, a_xyy; [1] a_xxy, a_yzz; [2]
// a_yyz, a_xxz.
template <class V>
struct ThirdOrder {
    V sum[3], difference[3];
};

// The third-order moments by recursion. ruu: rho u u; n: the non-equilibrium stress,
// times 1 - omega for the moments after the collision.
template <class V>
MAGFSI_INLINE ThirdOrder<V> third_order(const V (&u)[3], const Symmetric<V>& ruu,
                                        const Symmetric<V>& n) {
    const V xzz = ruu.zz * u[0] + 2.0 * u[2] * n.xz + u[0] * n.zz;
    const V xyy = ruu.yy * u[0] + 2.0 * u[1] * n.xy + u[0] * n.yy;
    const V xxy = ruu.xx * u[1] + 2.0 * u[0] * n.xy + u[1] * n.xx;
    const V yzz = ruu.zz * u[1] + 2.0 * u[2] * n.yz + u[1] * n.zz;
    const V yyz = ruu.yy * u[2] + 2.0 * u[1] * n.yz + u[2] * n.yy;
    const V xxz = ruu.xx * u[2] + 2.0 * u[0] * n.xz + u[2] * n.xx;
    return {{xzz + xyy, xxy + yzz, yyz + xxz}, {xzz - xyy, xxy - yzz, yyz - xxz}};
}

// Writes the pair Q, Q + 1 from its even and odd parts over the weight.
template <int Q, class V, class Real>
MAGFSI_INLINE void rebuild_pair(const LaneCells<V, Real>& f, const V& even,
                                const V& odd) {
    constexpr Lane<V> w = constant<V>(d3q19::weight(Q));
    f.write(Q, w * (even + odd));
    f.write(Q + 1, w * (even - odd));
}

// Ghost modes that a collision keeps, each multiplied by the fraction that is kept: of
// third order the deviation from the recursion, of fourth order one per pair of axes.
template <class V>
struct Ghosts {
    ThirdOrder<V> third;
    V xy, xz, yz;
};

// Third-order ghost modes of the populations before the collision. j: their momentum; n:
// the viscous stress before relaxation.
template <class V, class Real>
MAGFSI_INLINE ThirdOrder<V> third_ghosts(const LaneCells<V, Real>& f, const V (&j)[3],
                                         const V (&u)[3], const Symmetric<V>& ruu,
                                         const Symmetric<V>& n) {
    const SumDifference<V> a = pair_of<7>(f), b = pair_of<9>(f), c = pair_of<11>(f),
                           d = pair_of<13>(f), e = pair_of<15>(f), g = pair_of<17>(f);
    const V third = V{} + constant<V>(d3q19::cs2);
    const V jx = third * j[0], jy = third * j[1], jz = third * j[2];
    const V xyy = a.difference + b.difference - jx,
            xxy = a.difference - b.difference - jy;
    const V xzz = c.difference + d.difference - jx,
            xxz = c.difference - d.difference - jz;
    const V yzz = e.difference + g.difference - jy,
            yyz = e.difference - g.difference - jz;
    const ThirdOrder<V> r = third_order(u, ruu, n);
    return {{xzz + xyy - r.sum[0], xxy + yzz - r.sum[1], yyz + xxz - r.sum[2]},
            {xzz - xyy - r.difference[0], xxy - yzz - r.difference[1],
             yyz - xxz - r.difference[2]}};
}

// All ghost modes of the populations before the collision, times 1 - rate.
template <class V, class Real>
MAGFSI_INLINE Ghosts<V> ghosts(const LaneCells<V, Real>& f, const MomentsToSecond<V>& all,
                               const V (&u)[3], const Symmetric<V>& ruu,
                               const Symmetric<V>& n, const Rates<V>& rates) {
    const V odd = 1.0 - rates.odd;
    Ghosts<V> kept;
    kept.third = third_ghosts(f, all.low.j, u, ruu, n);
    for (int i = 0; i < 3; ++i) {
        kept.third.sum[i] *= odd;
        kept.third.difference[i] *= odd;
    }
    const V ab = pair_of<7>(f).sum + pair_of<9>(f).sum,
            cd = pair_of<11>(f).sum + pair_of<13>(f).sum,
            eg = pair_of<15>(f).sum + pair_of<17>(f).sum;
    // A fourth-order mode is the sum of the four populations of a diagonal plane, minus
    // the part that the second-order moments give it.
    const Symmetric<V>& p = all.second;
    const V trace = p.xx + p.yy + p.zz, excess = all.low.excess;
    const V keep = 1.0 - rates.fourth, ninth = V{} + constant<V>(1.0 / 9);
    const V base = -0.5 * excess - 1.5 * trace;
    kept.xy = keep * (ab - ninth * (base + 4.5 * (p.xx + p.yy)));
    kept.xz = keep * (cd - ninth * (base + 4.5 * (p.xx + p.zz)));
    kept.yz = keep * (eg - ninth * (base + 4.5 * (p.yy + p.zz)));
    return kept;
}

// Adds `more` to t.
template <class V>
MAGFSI_INLINE void add(ThirdOrder<V>& t, const ThirdOrder<V>& more) {
    for (int i = 0; i < 3; ++i) {
        t.sum[i] += more.sum[i];
        t.difference[i] += more.difference[i];
    }
}

// Contribution of the fourth-order modes: a mode g adds g / 4 to each edge of its plane,
// -g / 2 to each of its faces and g to the population at rest, which leaves all lower
// moments as they are. face and edge are values over the weight.
template <class V>
struct FourthOrder {
    V rest, face[3], edge[3];
};
template <class V>
MAGFSI_INLINE FourthOrder<V> fourth_order(const Ghosts<V>& g) {
    return {g.xy + g.xz + g.yz,
            {-9.0 * (g.xy + g.xz), -9.0 * (g.xy + g.yz), -9.0 * (g.xz + g.yz)},
            {9.0 * g.xy, 9.0 * g.xz, 9.0 * g.yz}};
}
// Stands for the absence of fourth-order modes: nothing is added, not even zeros.
struct NoFourthOrder {};

// A population with the contribution of the fourth-order modes: that at rest, those
// towards the faces across Axis, and those towards the edges in Plane (0 xy, 1 xz, 2 yz).
template <class V>
MAGFSI_INLINE V with_rest(const V& f, const NoFourthOrder&) {
    return f;
}
template <class V>
MAGFSI_INLINE V with_rest(const V& f, const FourthOrder<V>& g) {
    return f + g.rest;
}
template <int Axis, class V>
MAGFSI_INLINE V with_face(const V& f, const NoFourthOrder&) {
    return f;
}
template <int Axis, class V>
MAGFSI_INLINE V with_face(const V& f, const FourthOrder<V>& g) {
    return f + g.face[Axis];
}
template <int Plane, class V>
MAGFSI_INLINE V with_edge(const V& f, const NoFourthOrder&) {
    return f;
}
template <int Plane, class V>
MAGFSI_INLINE V with_edge(const V& f, const FourthOrder<V>& g) {
    return f + g.edge[Plane];
}

// Writes all populations from their moments,
//   f = w {excess + 3 c.j + 4.5 (c c - I/3) : a + 4.5 [3 (H + H')(a + a')
//          + (H - H')(a - a') + ...]},
// with the Hermite polynomials evaluated for each direction. a: second moment; t: third
// order; fourth: FourthOrder or NoFourthOrder.
template <class V, class Real, class Fourth>
MAGFSI_INLINE void rebuild(const LaneCells<V, Real>& f, const V& excess, const V (&j)[3],
                           const Symmetric<V>& a, const ThirdOrder<V>& t,
                           const Fourth& fourth) {
    const V base = excess - 1.5 * (a.xx + a.yy + a.zz);
    const V x = 3.0 * j[0], y = 3.0 * j[1], z = 3.0 * j[2];
    f.write(0, with_rest(constant<V>(d3q19::weight_rest) * base, fourth));
    rebuild_pair<1>(f, with_face<0>(base + 4.5 * a.xx, fourth), x - 9.0 * t.sum[0]);
    rebuild_pair<3>(f, with_face<1>(base + 4.5 * a.yy, fourth), y - 9.0 * t.sum[1]);
    rebuild_pair<5>(f, with_face<2>(base + 4.5 * a.zz, fourth), z - 9.0 * t.sum[2]);
    V plus[3], minus[3];
    for (int i = 0; i < 3; ++i) {
        plus[i] = 4.5 * (t.sum[i] + t.difference[i]);
        minus[i] = 4.5 * (t.sum[i] - t.difference[i]);
    }
    const V xy = with_edge<0>(base + 4.5 * (a.xx + a.yy), fourth), x_y = minus[0],
            y_x = plus[1];
    rebuild_pair<7>(f, xy + 9.0 * a.xy, (x + y) + (x_y + y_x));
    rebuild_pair<9>(f, xy - 9.0 * a.xy, (x - y) + (x_y - y_x));
    const V xz = with_edge<1>(base + 4.5 * (a.xx + a.zz), fourth), x_z = plus[0],
            z_x = minus[2];
    rebuild_pair<11>(f, xz + 9.0 * a.xz, (x + z) + (x_z + z_x));
    rebuild_pair<13>(f, xz - 9.0 * a.xz, (x - z) + (x_z - z_x));
    const V yz = with_edge<2>(base + 4.5 * (a.yy + a.zz), fourth), y_z = minus[1],
            z_y = plus[2];
    rebuild_pair<15>(f, yz + 9.0 * a.yz, (y + z) + (y_z + z_y));
    rebuild_pair<17>(f, yz - 9.0 * a.yz, (y - z) + (y_z - z_y));
}

template <Collision Kind, TraceRate Trace>
template <bool Forced, class V, class Real>
MAGFSI_INLINE void Recursive<Kind, Trace>::collide(const LaneCells<V, Real>& f,
                                                   const V (&force)[3],
                                                   const Rates<V>& rates,
                                                   CellCheck<V>& check) {
    const MomentsToSecond<V> all = moments_to_second(f);
    Moments<V> m = all.low;
    if constexpr (Forced) shift_momentum(m, force);
    const V per_density = 1.0 / (1.0 + m.excess);
    const V u[3] = {m.j[0] * per_density, m.j[1] * per_density, m.j[2] * per_density};
    const V keep = 1.0 - rates.even;
    const Symmetric<V> ruu = outer(m.j, u);
    check.add(ruu.xx + ruu.yy + ruu.zz, per_density);
    Symmetric<V> n = nonequilibrium(all, ruu), second = ruu;
    if constexpr (Forced) {
        // Guo's scheme makes the second moment eq + (1 - omega) n + (1 - omega/2)(uF +
        // Fu) with the raw n. Adding half of uF + Fu to n first makes n the viscous
        // stress itself, which the recursion needs, and leaves another half to add.
        const Symmetric<V> g = half_force_stress(u, force);
        n = add(n, g);
        second = add(ruu, g);
    }
    if constexpr (Trace == TraceRate::own) {
        const V mean = mean_of_trace(n);
        add_isotropic(n, -mean);
        add_isotropic(second, (1.0 - rates.bulk) * mean);
    }
    const Symmetric<V> left = scaled(keep, n);
    ThirdOrder<V> t = third_order(u, ruu, left);
    if constexpr (Forced) shift_momentum(m, force);  // sum c f + F
    if constexpr (Kind == Collision::recursive_mrt) {
        const Ghosts<V> kept = ghosts(f, all, u, ruu, n, rates);
        add(t, kept.third);
        rebuild(f, m.excess, m.j, add(second, left), t, fourth_order(kept));
    } else {
        rebuild(f, m.excess, m.j, add(second, left), t, NoFourthOrder{});
    }
}

}  // namespace magfsi::fluid

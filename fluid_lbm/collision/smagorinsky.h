// SPDX-License-Identifier: GPL-2.0-or-later
// Smagorinsky's eddy viscosity on top of any collision (Hou, Sterling, Chen, Doolen
// 1996). The rate of strain follows from the non-equilibrium stress Pi of the cell
// itself,
// |S| = 3 |Pi| / (sqrt(2) rho tau), and with nu_t = C^2 |S| the relaxation time becomes
//   tau = (tau_0 + sqrt(tau_0^2 + 18 sqrt(2) C^2 |Pi| / rho)) / 2,
// |Pi| the square root of the sum over all entries squared, filter width one cell.
#pragma once

#include "fluid_lbm/collision/cells.h"
#include "fluid_lbm/collision/moments.h"

namespace magfsi::fluid {

// Square root of each lane.
template <class V>
MAGFSI_INLINE V square_root(const V& a) {
    V root;
    for (int i = 0; i < lanes<V>; ++i) {
        if constexpr (sizeof(Lane<V>) == sizeof(float)) {
            root[i] = __builtin_sqrtf(a[i]);
        } else {
            root[i] = __builtin_sqrt(a[i]);
        }
    }
    return root;
}

// Viscous stress: the non-equilibrium stress plus, in forced rows, half of u F + F u
// (Guo). Where the trace has a rate of its own it is left out: it tells the rate of
// compression, not of strain. per_density receives 1 / density.
template <bool Forced, TraceRate Trace, class V, class Real>
MAGFSI_INLINE Symmetric<V> viscous_stress(const LaneCells<V, Real>& f,
                                          const V (&force)[3], V& per_density) {
    MomentsToSecond<V> all = moments_to_second(f);
    Moments<V>& m = all.low;
    if constexpr (Forced) shift_momentum(m, force);
    per_density = 1.0 / (1.0 + m.excess);
    const V u[3] = {m.j[0] * per_density, m.j[1] * per_density, m.j[2] * per_density};
    Symmetric<V> n = nonequilibrium(all, outer(m.j, u));
    if constexpr (Forced) n = add(n, half_force_stress(u, force));
    if constexpr (Trace == TraceRate::own) add_isotropic(n, -mean_of_trace(n));
    return n;
}

// The collision Base with the relaxation rates of the raised viscosity.
template <class Base>
struct Smagorinsky {
    // Collides the cells of f in place and checks their state. force: force density, read
    // only if Forced.
    template <bool Forced, class V, class Real>
    MAGFSI_INLINE static void collide(const LaneCells<V, Real>& f, const V (&force)[3],
                                      const Rates<V>& rates, CellCheck<V>& check) {
        constexpr double sqrt_2 = 1.4142135623730951;
        V per_density;
        const Symmetric<V> stress =
            viscous_stress<Forced, Base::trace>(f, force, per_density);
        const V c2 = rates.eddy_constant * rates.eddy_constant;
        // The equation for tau, multiplied by even^2, so that one division gives the new
        // rate.
        const V root =
            square_root<V>(1.0 + constant<V>(18 * sqrt_2) * c2 * rates.even * rates.even *
                                     per_density * square_root(squared_norm(stress)));
        const V even = 2.0 * rates.even / (1.0 + root);
        const Rates<V> raised{even,        odd_rate(even, rates.magic), fourth_rate(even),
                              rates.magic, rates.eddy_constant,         nullptr,
                              rates.bulk};
        Base::template collide<Forced>(f, force, raised, check);
    }
};

}  // namespace magfsi::fluid

// SPDX-License-Identifier: GPL-2.0-or-later
// Viscosity that depends on the rate of shear, on top of any collision (Aharonov, Rothman
// 1993; here without their lag of a step). The non-equilibrium stress Pi of the cell
// itself gives
//   rate = 3 |Pi| / (sqrt(2) rho tau),  tau = 1/2 + 3 nu(rate),
// so that 1 / tau is a function of q = |Pi|^2 / rho^2 alone. A table that is made once
// replaces the solution of this equation and the powers in each cell. It has 32 steps in
// each doubling of q and is linear between them, with an error of at most 3e-5 of the
// rate.
#pragma once

#include "fluid_lbm/collision/smagorinsky.h"

namespace magfsi::fluid {

// Shape of the table: 2^5 steps in each of 92 doublings of q, and the last entry. The
// lowest q is rounding noise of a fluid at rest.
constexpr int rate_steps_log2 = 5;
constexpr int rate_doublings = 92;
constexpr int rate_table_size = (rate_doublings << rate_steps_log2) + 1;
constexpr double lowest_stress_squared = 0x1p-90;
constexpr double highest_stress_squared = 0x1p2;

// Value of q of an entry of the table. The entries are spaced so that the upper bits of q
// as a double number them.
constexpr double stress_squared_of(int entry) {
    const int doubling = entry >> rate_steps_log2;
    const int part = entry & ((1 << rate_steps_log2) - 1);
    double q = lowest_stress_squared * (1 + part * (1.0 / (1 << rate_steps_log2)));
    for (int i = 0; i < doubling; ++i) q *= 2;
    return q;
}

// 1 / tau at q: linear interpolation in the table, constant beyond both of its ends. NaN
// gives the first entry.
MAGFSI_INLINE double rate_at(const double* table, double q) {
    constexpr int shift = 52 - rate_steps_log2;
    if (!(q > lowest_stress_squared)) return table[0];
    if (q >= highest_stress_squared) return table[rate_table_size - 1];
    long long bits, first;
    __builtin_memcpy(&bits, &q, sizeof bits);
    __builtin_memcpy(&first, &lowest_stress_squared, sizeof first);
    const long long entry = (bits - first) >> shift;
    const double part = static_cast<double>((bits - first) & ((1LL << shift) - 1)) *
                        (1.0 / (1LL << shift));
    return table[entry] + part * (table[entry + 1] - table[entry]);
}

// The collision Base with the relaxation rates of the cell's own rate of shear.
template <class Base>
struct ShearDependent {
    // Collides the cells of f in place and checks their state. force: force density, read
    // only if Forced.
    template <bool Forced, class V, class Real>
    MAGFSI_INLINE static void collide(const LaneCells<V, Real>& f, const V (&force)[3],
                                      const Rates<V>& rates, CellCheck<V>& check) {
        V per_density;
        const Symmetric<V> stress =
            viscous_stress<Forced, Base::trace>(f, force, per_density);
        const V q = squared_norm(stress) * per_density * per_density;
        V even;
        for (int i = 0; i < lanes<V>; ++i)
            even[i] = static_cast<Lane<V>>(rate_at(rates.by_stress, q[i]));
        const Rates<V> here{even,        odd_rate(even, rates.magic), fourth_rate(even),
                            rates.magic, rates.eddy_constant,         nullptr,
                            rates.bulk};
        Base::template collide<Forced>(f, force, here, check);
    }
};

}  // namespace magfsi::fluid

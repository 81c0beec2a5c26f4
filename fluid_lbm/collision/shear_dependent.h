// SPDX-License-Identifier: GPL-2.0-or-later
// Viscosity by the rate of shear on top of any collision (Aharonov, Rothman 1993; here
// without their lag of a step). The non-equilibrium stress Pi of the cell itself gives
//   rate = 3 |Pi| / (sqrt(2) rho tau),  tau = 1/2 + 3 nu(rate),
// so that 1 / tau follows from q = |Pi|^2 / rho^2 alone: a table, made once, takes the
// place of the solution and of powers in each cell. 32 steps in each doubling of q;
// between them it is linear, which errs by at most 3e-5 of the rate.
#pragma once

#include "fluid_lbm/collision/smagorinsky.h"

namespace magfsi::fluid {

constexpr int rate_steps_log2 = 5;
constexpr int rate_doublings = 92;
constexpr int rate_table_size = (rate_doublings << rate_steps_log2) + 1;
constexpr double lowest_stress_squared = 0x1p-90;  // rounding of a fluid at rest
constexpr double highest_stress_squared = 0x1p2;

// q of an entry of the table; its place is that of the upper bits of q.
constexpr double stress_squared_of(int entry) {
    const int doubling = entry >> rate_steps_log2;
    const int part = entry & ((1 << rate_steps_log2) - 1);
    double q = lowest_stress_squared * (1 + part * (1.0 / (1 << rate_steps_log2)));
    for (int i = 0; i < doubling; ++i) q *= 2;
    return q;
}

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

template <class Base>
struct ShearDependent {
    // force: read only if Forced.
    template <bool Forced, class V, class Real>
    MAGFSI_INLINE static void collide(const LaneCells<V, Real>& f, const V (&force)[3],
                                      const Rates<V>& rates, CellCheck<V>& check) {
        V per_density;
        const Symmetric<V> stress = viscous_stress<Forced>(f, force, per_density);
        const V q = squared_norm(stress) * per_density * per_density;
        V even;
        for (int i = 0; i < lanes<V>; ++i)
            even[i] = static_cast<Lane<V>>(rate_at(rates.by_stress, q[i]));
        const Rates<V> here{even,        odd_rate(even, rates.magic), fourth_rate(even),
                            rates.magic, rates.eddy_constant,         nullptr};
        Base::template collide<Forced>(f, force, here, check);
    }
};

}  // namespace magfsi::fluid

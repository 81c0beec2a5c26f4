// SPDX-License-Identifier: GPL-2.0-or-later
// Collision with a single relaxation time (Bhatnagar, Gross, Krook; Qian, d'Humieres,
// Lallemand 1992) towards the second-order equilibrium
//   f_eq = w [rho + 3 c.j + 4.5 (c.j)(c.u) - 1.5 j.u],
// written as f + omega (f_eq - f), which keeps conserved moments to rounding.
#pragma once

#include "fluid_lbm/collision/pairs.h"
#include "fluid_lbm/options.h"

namespace magfsi::fluid {

struct Bgk {
    static constexpr Collision kind = Collision::bgk;
    static constexpr TraceRate trace = TraceRate::viscous;

    // Collides the cells of f in place and checks their state. force: force density, read
    // only if Forced.
    template <bool Forced, class V, class Real>
    MAGFSI_INLINE static void collide(const LaneCells<V, Real>& f, const V (&force)[3],
                                      const Rates<V>& rates, CellCheck<V>& check) {
        const CellState<V> s = cell_state<Forced>(f, force);
        check.add(s.ju, s.per_density);
        const V source_factor = 1.0 - 0.5 * rates.even;
        V rest = f[0];
        rest += rates.even * (rest_equilibrium(s) - rest);
        if constexpr (Forced) rest += source_factor * rest_source(s);
        f.write(0, rest);
        for_each_pair([&]<int Q>(Pair<Q>) MAGFSI_INLINE_LAMBDA {
            const EvenOdd<V> eq = equilibrium<Q>(s);
            V first = f[Q], second = f[Q + 1];
            first += rates.even * ((eq.even + eq.odd) - first);
            second += rates.even * ((eq.even - eq.odd) - second);
            if constexpr (Forced) {
                const EvenOdd<V> source = guo_source<Q>(s);
                first += source_factor * (source.even + source.odd);
                second += source_factor * (source.even - source.odd);
            }
            f.write(Q, first);
            f.write(Q + 1, second);
        });
    }
};

}  // namespace magfsi::fluid

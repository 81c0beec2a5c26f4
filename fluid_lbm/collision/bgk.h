// Single relaxation time (Bhatnagar, Gross, Krook) towards the second-order equilibrium
//   f_eq = w [rho + 3 c.j + 4.5 (c.j)(c.u) - 1.5 j.u],
// written as f + omega (f_eq - f), which keeps conserved moments to rounding.
#pragma once

#include "fluid_lbm/collision/collision.h"
#include "fluid_lbm/collision/pairs.h"

namespace magfsi::fluid {

struct Bgk {
    static constexpr Collision kind = Collision::bgk;
    static constexpr const char* name = "bgk";

    // f: populations minus weights, in place; force: read only if Forced.
    template <bool Forced, class V>
    MAGFSI_INLINE static void collide(V (&f)[d3q19::directions], const V (&force)[3],
                                      const Rates<V>& rates, Watch<V>& watch) {
        const CellState<V> s = cell_state<Forced>(f, force);
        watch.see(s.u, s.per_density);
        const V source_factor = 1.0 - 0.5 * rates.even;
        f[0] += rates.even * (rest_equilibrium(s) - f[0]);
        if constexpr (Forced) f[0] += source_factor * rest_source(s);
        for_each_pair([&]<int Q>(Pair<Q>) MAGFSI_INLINE_LAMBDA {
            const EvenOdd<V> eq = equilibrium<Q>(s);
            const V first = f[Q], second = f[Q + 1];
            f[Q] = first + rates.even * ((eq.even + eq.odd) - first);
            f[Q + 1] = second + rates.even * ((eq.even - eq.odd) - second);
            if constexpr (Forced) {
                const EvenOdd<V> source = guo_source<Q>(s);
                f[Q] += source_factor * (source.even + source.odd);
                f[Q + 1] += source_factor * (source.even - source.odd);
            }
        });
    }
};

}  // namespace magfsi::fluid

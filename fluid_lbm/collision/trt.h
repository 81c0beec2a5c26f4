// Two relaxation times (Ginzburg, Verhaeghe, d'Humieres 2008): the even part of each pair
// of opposite populations relaxes with the rate of the viscosity, the odd part with the
// one that the magic number gives. Lambda = 3/16 puts the wall of half-way bounce-back
// exactly half way; the force's even part carries 1 - even / 2, the odd one 1 - odd / 2.
#pragma once

#include "fluid_lbm/collision/collision.h"
#include "fluid_lbm/collision/pairs.h"

namespace magfsi::fluid {

struct TwoRelaxationTimes {
    static constexpr Collision kind = Collision::trt;
    static constexpr const char* name = "trt";

    // f: populations minus weights, in place; force: read only if Forced.
    template <bool Forced, class V>
    MAGFSI_INLINE static void collide(V (&f)[d3q19::directions], const V (&force)[3],
                                      const Rates<V>& rates, Watch<V>& watch) {
        const CellState<V> s = cell_state<Forced>(f, force);
        watch.see(s.u, s.per_density);
        const V half_even = 0.5 * rates.even, half_odd = 0.5 * rates.odd;
        f[0] += rates.even * (rest_equilibrium(s) - f[0]);
        if constexpr (Forced) f[0] += (1.0 - half_even) * rest_source(s);
        for_each_pair([&]<int Q>(Pair<Q>) MAGFSI_INLINE_LAMBDA {
            const EvenOdd<V> eq = equilibrium<Q>(s);
            const V sum = f[Q] + f[Q + 1], difference = f[Q] - f[Q + 1];
            V even = half_even * (2.0 * eq.even - sum);
            V odd = half_odd * (2.0 * eq.odd - difference);
            if constexpr (Forced) {
                const EvenOdd<V> source = guo_source<Q>(s);
                even += (1.0 - half_even) * source.even;
                odd += (1.0 - half_odd) * source.odd;
            }
            f[Q] += even + odd;
            f[Q + 1] += even - odd;
        });
    }
};

}  // namespace magfsi::fluid

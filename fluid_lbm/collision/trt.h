// SPDX-License-Identifier: GPL-2.0-or-later
// Collision with two relaxation times (Ginzburg, Verhaeghe, d'Humieres 2008): the even
// part of each pair of opposite populations relaxes with the rate of the viscosity, the
// odd part with the rate that the magic number gives. Lambda = 3/16 puts the wall of
// half-way bounce-back exactly half way. The even part of the force's source has the
// factor 1 - even / 2, the odd part 1 - odd / 2.
//
// With a rate of its own for the trace of the stress, w 3/2 (c^2 - 1) (even - bulk) tr n
// is added, n the viscous stress: the Hermite polynomial of the trace, which changes no
// other moment up to the third order.
#pragma once

#include "fluid_lbm/collision/pairs.h"
#include "fluid_lbm/options.h"

namespace magfsi::fluid {

template <TraceRate Trace>
struct TwoRelaxationTimes {
    static constexpr Collision kind = Collision::trt;
    static constexpr TraceRate trace = Trace;

    // Collides the cells of f in place and checks their state. force: force density, read
    // only if Forced.
    template <bool Forced, class V, class Real>
    MAGFSI_INLINE static void collide(const LaneCells<V, Real>& f, const V (&force)[3],
                                      const Rates<V>& rates, CellCheck<V>& check) {
        CellState<V> s = cell_state<Forced>(f, force);
        check.add(s.ju, s.per_density);
        if constexpr (Trace == TraceRate::own)
            s.trace_back =
                1.5 * (rates.even - rates.bulk) * trace_of_stress<Forced>(f, s);
        const V half_even = 0.5 * rates.even, half_odd = 0.5 * rates.odd;
        V rest = f[0];
        rest += rates.even * (rest_equilibrium(s) - rest);
        if constexpr (Forced) rest += (1.0 - half_even) * rest_source(s);
        if constexpr (Trace == TraceRate::own)
            rest -= constant<V>(d3q19::weight_rest) * s.trace_back;
        f.write(0, rest);
        for_each_pair([&]<int Q>(Pair<Q>) MAGFSI_INLINE_LAMBDA {
            const EvenOdd<V> eq = equilibrium<Q>(s);
            const V first = f[Q], second = f[Q + 1];
            const V sum = first + second, difference = first - second;
            V even = half_even * (2.0 * eq.even - sum);
            V odd = half_odd * (2.0 * eq.odd - difference);
            if constexpr (Forced) {
                const EvenOdd<V> source = guo_source<Q>(s);
                even += (1.0 - half_even) * source.even;
                odd += (1.0 - half_odd) * source.odd;
            }
            if constexpr (Trace == TraceRate::own &&
                          d3q19::weight(Q) < d3q19::weight_face)
                even += constant<V>(d3q19::weight_edge) * s.trace_back;  // c^2 is 2
            f.write(Q, first + (even + odd));
            f.write(Q + 1, second + (even - odd));
        });
    }
};

}  // namespace magfsi::fluid

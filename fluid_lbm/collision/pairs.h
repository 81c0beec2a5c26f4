// SPDX-License-Identifier: GPL-2.0-or-later
// Common part of the collisions that relax populations pair by pair (bgk.h, trt.h): the
// second-order equilibrium and Guo's source, as even and odd parts of each pair of
// opposite directions.
#pragma once

#include "fluid_lbm/collision/cells.h"
#include "fluid_lbm/collision/moments.h"

namespace magfsi::fluid {

// State that the equilibrium and the source of all pairs need. j and u include half of
// the force in forced rows; uf = u . force is set in those only.
template <class V>
struct CellState {
    V base;         // density excess - 1.5 j.u
    V ju;           // j . u
    V per_density;  // 1 / density
    V j[3], u[3], force[3], uf;
    V trace_back;  // w trace_back (c^2 - 1) is added where the trace has its own rate
};

// The state of cells from the populations that have arrived; force: read only if Forced.
template <bool Forced, class Populations, class V>
MAGFSI_INLINE CellState<V> cell_state(const Populations& f, const V (&force)[3]) {
    Moments<V> m = moments(f);
    if constexpr (Forced) shift_momentum(m, force);
    CellState<V> s;
    s.per_density = 1.0 / (1.0 + m.excess);
    for (int a = 0; a < 3; ++a) {
        s.j[a] = m.j[a];
        s.u[a] = m.j[a] * s.per_density;
        s.force[a] = force[a];
    }
    s.ju = s.j[0] * s.u[0] + s.j[1] * s.u[1] + s.j[2] * s.u[2];
    s.base = m.excess - 1.5 * s.ju;
    if constexpr (Forced) {
        s.uf = s.u[0] * force[0] + s.u[1] * force[1] + s.u[2] * force[2];
    }
    return s;
}

// Equilibrium and source of the population at rest, minus its weight.
template <class V>
MAGFSI_INLINE V rest_equilibrium(const CellState<V>& s) {
    return constant<V>(d3q19::weight_rest) * s.base;
}
template <class V>
MAGFSI_INLINE V rest_source(const CellState<V>& s) {
    return constant<V>(-3 * d3q19::weight_rest) * s.uf;
}

// Equilibrium of the pair Q, Q + 1, minus the weights.
template <int Q, class V>
MAGFSI_INLINE EvenOdd<V> equilibrium(const CellState<V>& s) {
    constexpr Lane<V> w = constant<V>(d3q19::weight(Q));
    constexpr Lane<V> w3 = constant<V>(3 * d3q19::weight(Q));
    const V cj = along<Q>(s.j), cu = along<Q>(s.u);
    return {w * (s.base + 4.5 * cj * cu), w3 * cj};
}

template <int Q, class V>
MAGFSI_INLINE EvenOdd<V> guo_source(const CellState<V>& s) {
    return guo_source<Q>(s.u, s.force, s.uf);
}

// Trace of the viscous stress: the second moment beyond rho u u and the pressure, with
// half of the force's part.
template <bool Forced, class Populations, class V>
MAGFSI_INLINE V trace_of_stress(const Populations& f, const CellState<V>& s) {
    const MomentsToSecond<V> m = moments_to_second(f);
    const V trace = (m.second.xx + m.second.yy + m.second.zz) - m.low.excess - s.ju;
    if constexpr (Forced) return trace + s.uf;
    return trace;
}

// Tag that carries the first direction of a pair.
template <int Q>
struct Pair {};

// Calls visit(Pair<1>{}), visit(Pair<3>{}), ... for the nine pairs of opposite
// directions.
template <int Q = 1, class Visit>
MAGFSI_INLINE void for_each_pair(const Visit& visit) {
    visit(Pair<Q>{});
    if constexpr (Q + 2 < d3q19::directions) for_each_pair<Q + 2>(visit);
}

}  // namespace magfsi::fluid

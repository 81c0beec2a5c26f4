// Single relaxation time (Bhatnagar, Gross, Krook) towards the second-order equilibrium
//   f_eq = w [rho + 3 c.j + 4.5 (c.j)(c.u) - 1.5 j.u],
// written as f + omega (f_eq - f), which keeps conserved moments to rounding.
#pragma once

#include "fluid_lbm/collision/simd.h"
#include "fluid_lbm/forcing/guo.h"

namespace magfsi::fluid {

struct Bgk {
    // f: populations minus weights, in place; force: read only if Forced.
    template <bool Forced, class V>
    MAGFSI_INLINE static void collide(V (&f)[d3q19::directions], const V (&force)[3],
                                      double omega);
};

template <class V>
struct BgkState {
    V base;  // density excess - 1.5 j.u
    V j[3], u[3], force[3], uf;
    double omega, source_factor;
};

template <bool Forced, int Q, class V>
MAGFSI_INLINE void relax_pair(V (&f)[d3q19::directions], const BgkState<V>& s) {
    constexpr double w = d3q19::weight(Q);
    const V cj = along<Q>(s.j), cu = along<Q>(s.u);
    const V even = s.base + 4.5 * cj * cu, odd = 3.0 * cj;
    V first = f[Q] + s.omega * (w * (even + odd) - f[Q]);
    V second = f[Q + 1] + s.omega * (w * (even - odd) - f[Q + 1]);
    if constexpr (Forced) {
        const PairSource<V> source = guo_source<Q>(s.u, s.force, s.uf);
        first += (s.source_factor * w) * (source.even + source.odd);
        second += (s.source_factor * w) * (source.even - source.odd);
    }
    f[Q] = first;
    f[Q + 1] = second;
}

template <bool Forced, class V>
MAGFSI_INLINE void Bgk::collide(V (&f)[d3q19::directions], const V (&force)[3],
                                double omega) {
    Moments<V> m = moments(f);
    if constexpr (Forced) shift_momentum(m, force);
    const V per_density = 1.0 / (1.0 + m.excess);
    BgkState<V> s;
    s.omega = omega;
    s.source_factor = 1 - 0.5 * omega;
    for (int a = 0; a < 3; ++a) {
        s.j[a] = m.j[a];
        s.u[a] = m.j[a] * per_density;
        s.force[a] = force[a];
    }
    s.base = m.excess - 1.5 * (s.j[0] * s.u[0] + s.j[1] * s.u[1] + s.j[2] * s.u[2]);
    f[0] += omega * (d3q19::weight_rest * s.base - f[0]);
    if constexpr (Forced) {
        s.uf = s.u[0] * force[0] + s.u[1] * force[1] + s.u[2] * force[2];
        f[0] -= (3 * s.source_factor * d3q19::weight_rest) * s.uf;
    }
    relax_pair<Forced, 1>(f, s);
    relax_pair<Forced, 3>(f, s);
    relax_pair<Forced, 5>(f, s);
    relax_pair<Forced, 7>(f, s);
    relax_pair<Forced, 9>(f, s);
    relax_pair<Forced, 11>(f, s);
    relax_pair<Forced, 13>(f, s);
    relax_pair<Forced, 15>(f, s);
    relax_pair<Forced, 17>(f, s);
}

}  // namespace magfsi::fluid

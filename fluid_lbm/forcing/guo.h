// Guo's body force (Guo, Zheng, Shi 2002): the velocity of the collision is
// u = (sum c f + F / 2) / rho and the source, before its factor (1 - omega / 2), is
//   S_q = w_q [3 (c - u) . F + 9 (c . u)(c . F)],
// with moments 0, F and u F + F u. Lattice units.
#pragma once

#include "fluid_lbm/collision/moments.h"

namespace magfsi::fluid {

// Of a pair of opposite directions: even part, the same for both, and odd part.
template <class V>
struct EvenOdd {
    V even, odd;
};

template <class V>
MAGFSI_INLINE void shift_momentum(Moments<V>& m, const V (&force)[3]) {
    for (int a = 0; a < 3; ++a) m.j[a] += 0.5 * force[a];
}

// S of a pair; uf = u . F.
template <int Q, class V>
MAGFSI_INLINE EvenOdd<V> guo_source(const V (&u)[3], const V (&force)[3], const V& uf) {
    constexpr Lane<V> w3 = constant<V>(3 * d3q19::weight(Q));
    const V cf = along<Q>(force);
    return {w3 * (3.0 * along<Q>(u) * cf - uf), w3 * cf};
}

}  // namespace magfsi::fluid

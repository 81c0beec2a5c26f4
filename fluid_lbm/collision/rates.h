// How fast populations relax.
#pragma once

#include "fluid_lbm/collision/simd.h"

namespace magfsi::fluid {

// What a run gives to its row kernels; lattice units.
struct CollisionParameters {
    double omega = 1;          // 1 / tau, tau the relaxation time of the viscosity
    double magic = 3.0 / 16;   // Lambda of two-relaxation-time collision
    double eddy_constant = 0;  // Smagorinsky's
};

// Rates of each lane. Odd moments relax so that Ginzburg's magic number stays,
//   Lambda = (1 / even - 1/2) (1 / odd - 1/2);
// collisions with one rate ignore the odd one.
template <class V>
struct Rates {
    V even, odd;
    V magic, eddy_constant;
};

template <class V>
MAGFSI_INLINE V odd_rate(const V& even, const V& magic) {
    // 1 / (1/2 + Lambda / (1 / even - 1/2)) without the divisions that vanish at
    // even = 2.
    const V slack = 2.0 - even;
    return 2.0 * slack / (slack + 4.0 * magic * even);
}

template <class V>
MAGFSI_INLINE Rates<V> rates(const CollisionParameters& p) {
    Rates<V> r;
    r.even = V{} + constant<V>(p.omega);
    r.magic = V{} + constant<V>(p.magic);
    r.eddy_constant = V{} + constant<V>(p.eddy_constant);
    // In double: 2 - omega loses digits near tau = 1/2.
    const double slack = 2 - p.omega;
    r.odd = V{} + constant<V>(2 * slack / (slack + 4 * p.magic * p.omega));
    return r;
}

template <class V>
MAGFSI_INLINE Rates<V> with_even_rate(const Rates<V>& r, const V& even) {
    return {even, odd_rate(even, r.magic), r.magic, r.eddy_constant};
}

}  // namespace magfsi::fluid

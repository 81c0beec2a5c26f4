// Moments of the populations of a cell. One pair of opposites after the other, each
// population read once: the dozen running sums stay in registers.
#pragma once

#include "fluid_lbm/collision/simd.h"

namespace magfsi::fluid {

// Symmetric tensor; off-diagonal entries in the order xy, xz, yz.
template <class V>
struct Symmetric {
    V xx, yy, zz, xy, xz, yz;
};

// Density - 1 and the sum of c f.
template <class V>
struct Moments {
    V excess;
    V j[3];
};

template <class V>
struct SumDifference {
    V sum, difference;
};

// f: LaneCells, or whatever else gives a vector for each of the 19 indices.
template <int Q, class Populations>
MAGFSI_INLINE auto pair_of(const Populations& f) {
    const auto first = f[Q], second = f[Q + 1];
    return SumDifference<VectorOf<Populations>>{first + second, first - second};
}

// With the sum of c c f.
template <class V>
struct MomentsToSecond {
    Moments<V> low;
    Symmetric<V> second;
};

template <class Populations>
MAGFSI_INLINE MomentsToSecond<VectorOf<Populations>> moments_to_second(
    const Populations& f) {
    using V = VectorOf<Populations>;
    const SumDifference<V> x = pair_of<1>(f), y = pair_of<3>(f), z = pair_of<5>(f);
    const SumDifference<V> a = pair_of<7>(f), b = pair_of<9>(f);
    const V xy = a.sum + b.sum, dxy = a.sum - b.sum;
    V jx = x.difference + (a.difference + b.difference);
    V jy = y.difference + (a.difference - b.difference);
    const SumDifference<V> c = pair_of<11>(f), d = pair_of<13>(f);
    const V xz = c.sum + d.sum, dxz = c.sum - d.sum;
    jx += c.difference + d.difference;
    V jz = z.difference + (c.difference - d.difference);
    const SumDifference<V> e = pair_of<15>(f), g = pair_of<17>(f);
    const V yz = e.sum + g.sum, dyz = e.sum - g.sum;
    jy += e.difference + g.difference;
    jz += e.difference - g.difference;
    const V excess = ((x.sum + y.sum + z.sum) + (xy + xz + yz)) + f[0];
    return {{excess, {jx, jy, jz}},
            {x.sum + (xy + xz), y.sum + (xy + yz), z.sum + (xz + yz), dxy, dxz, dyz}};
}

// Without it: what nobody reads is not computed.
template <class Populations>
MAGFSI_INLINE Moments<VectorOf<Populations>> moments(const Populations& f) {
    return moments_to_second(f).low;
}

}  // namespace magfsi::fluid

// SPDX-License-Identifier: GPL-2.0-or-later
// Conversion between the populations of a row and the ten numbers that levels of
// different spacing exchange: density - 1, velocity, and the non-equilibrium stress (xx,
// yy, zz, xy, xz, yz), of states before collision. All further moments of the lattice are
// ghost modes, which do not cross from one level to another.
#pragma once

#include "fluid_lbm/collision/recursive_regularized.h"
#include "fluid_lbm/streaming/row_kernel.h"

namespace magfsi::fluid {

// Reads the flow of a vector of cells at x. WithStress: the stress, too.
template <class V, bool WithStress, class Real>
MAGFSI_INLINE void flow_block(const Real* const* at, std::ptrdiff_t x,
                              double* const* flow) {
    V f[d3q19::directions];
#pragma GCC unroll 19
    for (int q = 0; q < d3q19::directions; ++q) f[q] = load<V>(at[q] + x);
    const MomentsToSecond<V> m = moments_to_second(f);
    const V per_density = 1.0 / (1.0 + m.low.excess);
    const V u[3] = {m.low.j[0] * per_density, m.low.j[1] * per_density,
                    m.low.j[2] * per_density};
    store(flow[0] + x, m.low.excess);
    for (int a = 0; a < 3; ++a) store(flow[1 + a] + x, u[a]);
    if (!WithStress) return;
    const Symmetric<V> n = nonequilibrium(m, outer(m.low.j, u));
    const V* const stress[6] = {&n.xx, &n.yy, &n.zz, &n.xy, &n.xz, &n.yz};
    for (int i = 0; i < 6; ++i) store(flow[4 + i] + x, *stress[i]);
}

// Writes the populations of a vector of cells at x from their flow, with the third-order
// moments that follow by recursion, as in the collision.
template <TraceRate Trace, class V, class Real>
MAGFSI_INLINE void rebuild_block(const double* const* flow, std::ptrdiff_t x,
                                 Real* const* at) {
    const V excess = load<V>(flow[0] + x);
    const V u[3] = {load<V>(flow[1] + x), load<V>(flow[2] + x), load<V>(flow[3] + x)};
    const Symmetric<V> n{load<V>(flow[4] + x), load<V>(flow[5] + x),
                         load<V>(flow[6] + x), load<V>(flow[7] + x),
                         load<V>(flow[8] + x), load<V>(flow[9] + x)};
    const V density = 1.0 + excess;
    const V j[3] = {density * u[0], density * u[1], density * u[2]};
    const Symmetric<V> ruu = outer(j, u);
    const auto write = [&](const ThirdOrder<V>& third) MAGFSI_INLINE_LAMBDA {
        rebuild(LaneCells<V, Real>(at, x), excess, j, add(ruu, n), third,
                NoFourthOrder{});
    };
    if constexpr (Trace == TraceRate::own) {
        Symmetric<V> seen = n;
        add_isotropic(seen, -mean_of_trace(n));
        write(third_order(u, ruu, seen));
    } else {
        write(third_order(u, ruu, n));
    }
}

// Calls use(x, V{}) for vectors of Width cells that fit into the rest of a row from x on,
// then for narrower ones: rows may be as short as a ring is wide.
template <int Width, class Use>
MAGFSI_INLINE void in_narrower_vectors(std::ptrdiff_t x, std::ptrdiff_t length,
                                       const Use& use) {
    using Vector = typename Simd<double, Width>::Vector;
    for (; x + Width <= length; x += Width) use(x, Vector{});
    if constexpr (Width > 1) in_narrower_vectors<Width / 2>(x, length, use);
}

// Reads the flow of a row, and prefetches the row that lies `ahead` elements further:
// pieces of rows are too short for the hardware to foresee 19 streams.
template <int Width, bool WithStress, class Real>
MAGFSI_INLINE void flow_row(const Real* const* at, std::ptrdiff_t length,
                            double* const* flow, std::ptrdiff_t ahead) {
    const auto block = [=](std::ptrdiff_t x, auto v) MAGFSI_INLINE_LAMBDA {
        for (int q = 0; x % cells_per_line<Real> == 0 && q < d3q19::directions; ++q)
            __builtin_prefetch(at[q] + x + ahead, 0, 3);
        flow_block<decltype(v), WithStress>(at, x, flow);
    };
    in_narrower_vectors<Width>(0, length, block);
}

// Writes the populations of a row from their flow.
template <int Width, TraceRate Trace, class Real>
MAGFSI_INLINE void rebuild_row(const double* const* flow, std::ptrdiff_t length,
                               Real* const* at) {
    // LaneCells::write stores each population in the slot of its opposite, as a collision
    // does; exchanged pointers keep each in its own slot.
    Real* own[d3q19::directions];
    for (int q = 0; q < d3q19::directions; ++q) own[d3q19::opposite(q)] = at[q];
    const auto block = [&](std::ptrdiff_t x, auto v) MAGFSI_INLINE_LAMBDA {
        rebuild_block<Trace, decltype(v)>(flow, x, own);
    };
    in_narrower_vectors<Width>(0, length, block);
}

}  // namespace magfsi::fluid

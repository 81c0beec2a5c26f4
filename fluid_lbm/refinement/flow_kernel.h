// Between the populations of a row and the ten numbers that levels of different spacing
// tell each other: density - 1, velocity, and the stress beyond equilibrium (xx, yy, zz,
// xy, xz, yz), of states before collision. What the lattice carries beyond these are
// ghost modes, which do not cross from one level to another.
#pragma once

#include "fluid_lbm/collision/recursive_regularized.h"
#include "fluid_lbm/streaming/row_kernel.h"

namespace magfsi::fluid {

template <class V, class Real>
MAGFSI_INLINE void flow_block(const Real* const* at, std::ptrdiff_t x,
                              double* const* flow) {
    V f[d3q19::directions];
#pragma GCC unroll 19
    for (int q = 0; q < d3q19::directions; ++q) f[q] = load<V>(at[q] + x);
    const MomentsToSecond<V> m = moments_to_second(f);
    const V per_density = 1.0 / (1.0 + m.low.excess);
    const V u[3] = {m.low.j[0] * per_density, m.low.j[1] * per_density,
                    m.low.j[2] * per_density};
    const Symmetric<V> n = nonequilibrium(m, outer(m.low.j, u));
    store(flow[0] + x, m.low.excess);
    for (int a = 0; a < 3; ++a) store(flow[1 + a] + x, u[a]);
    const V* const stress[6] = {&n.xx, &n.yy, &n.zz, &n.xy, &n.xz, &n.yz};
    for (int i = 0; i < 6; ++i) store(flow[4 + i] + x, *stress[i]);
}

// With the third-order moments that follow by recursion.
template <class V, class Real>
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
    rebuild(LaneCells<V, Real>(at, x), excess, j, add(ruu, n), third_order(u, ruu, n),
            NoFourthOrder{});
}

// Populations of the last cells of a row, fewer than a vector has lanes: rows may be as
// short as a ring is wide. The buffer's surplus cells are at rest.
template <int Width, class Real>
struct LastCells {
    Real f[d3q19::directions][Width] = {};
    double flow[flow_numbers][Width] = {};
    Real* f_at[d3q19::directions];
    double* flow_at[flow_numbers];

    MAGFSI_INLINE LastCells() {
        for (int q = 0; q < d3q19::directions; ++q) f_at[q] = f[q];
        for (int i = 0; i < flow_numbers; ++i) flow_at[i] = flow[i];
    }
};

template <int Width, class Real>
MAGFSI_INLINE void flow_row(const Real* const* at, std::ptrdiff_t length,
                            double* const* flow) {
    using Vector = typename Simd<double, Width>::Vector;
    std::ptrdiff_t x = 0;
    for (; x + Width <= length; x += Width) {
        if (x % cells_per_line<Real> == 0) prefetch_for_read(at, x);
        flow_block<Vector>(at, x, flow);
    }
    if (x == length) return;
    LastCells<Width, Real> last;
    for (int q = 0; q < d3q19::directions; ++q) {
        for (std::ptrdiff_t k = x; k < length; ++k) last.f[q][k - x] = at[q][k];
    }
    flow_block<Vector>(last.f_at, 0, last.flow_at);
    for (int i = 0; i < flow_numbers; ++i) {
        for (std::ptrdiff_t k = x; k < length; ++k) flow[i][k] = last.flow[i][k - x];
    }
}

template <int Width, class Real>
MAGFSI_INLINE void rebuild_row(const double* const* flow, std::ptrdiff_t length,
                               Real* const* at) {
    // Collisions write each population to the slot of its opposite; here it stays.
    Real* own[d3q19::directions];
    for (int q = 0; q < d3q19::directions; ++q) own[d3q19::opposite(q)] = at[q];
    using Vector = typename Simd<double, Width>::Vector;
    std::ptrdiff_t x = 0;
    for (; x + Width <= length; x += Width) rebuild_block<Vector>(flow, x, own);
    if (x == length) return;
    LastCells<Width, Real> last;
    for (int i = 0; i < flow_numbers; ++i) {
        for (std::ptrdiff_t k = x; k < length; ++k) last.flow[i][k - x] = flow[i][k];
    }
    rebuild_block<Vector>(last.flow_at, 0, last.f_at);
    for (int q = 0; q < d3q19::directions; ++q) {
        for (std::ptrdiff_t k = x; k < length; ++k) own[q][k] = last.f[q][k - x];
    }
}

}  // namespace magfsi::fluid

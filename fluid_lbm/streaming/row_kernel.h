// SPDX-License-Identifier: GPL-2.0-or-later
// Collision and in-place streaming of one row: reads the 19 populations that arrive at
// each cell and writes each outgoing one to the slot of the opposite. With natural and
// swapped pointers in turn (lattice/populations.h) this is a whole AA step without a
// second grid.
#pragma once

#include <cstddef>

#include "fluid_lbm/collision/cells.h"
#include "fluid_lbm/collision/moments.h"
#include "fluid_lbm/streaming/kernels.h"

namespace magfsi::fluid {

// Cache lines between the prefetched and the current cell. Asking for the line with write
// intent was the largest single gain measured (1.3 to 1.5 times a core).
inline constexpr std::ptrdiff_t lines_ahead = 5;
template <class Real>
inline constexpr std::ptrdiff_t cells_per_line = 64 / sizeof(Real);

template <class C, bool Forced, class V, class Real>
MAGFSI_INLINE void collide_block(Real* const* at, const Real* const* force,
                                 std::ptrdiff_t x, const Rates<V>& rates,
                                 CellCheck<V>& check) {
    V local_force[3] = {};
    if constexpr (Forced) {
        for (int a = 0; a < 3; ++a) local_force[a] = load<V>(force[a] + x);
    }
    C::template collide<Forced>(LaneCells<V, Real>(at, x), local_force, rates, check);
}

template <class Real>
MAGFSI_INLINE void prefetch_for_write(Real* const* at, std::ptrdiff_t x) {
#pragma GCC unroll 19
    for (int q = 0; q < d3q19::directions; ++q) {
        __builtin_prefetch(at[q] + x + lines_ahead * cells_per_line<Real>, 1, 3);
    }
}

template <class Real>
MAGFSI_INLINE void prefetch_force(const Real* const* force, std::ptrdiff_t x) {
    for (int a = 0; a < 3; ++a) {
        __builtin_prefetch(force[a] + x + lines_ahead * cells_per_line<Real>, 0, 3);
    }
}

// The last cells of a row whose length is no multiple of the vector width: through a
// buffer, because the elements behind the row belong to other rows. The buffer's surplus
// cells are at rest.
template <bool Forced, int Width, class Real>
MAGFSI_INLINE bool collide_tail(Real* const* at, const Real* const* force,
                                std::ptrdiff_t x, std::ptrdiff_t length,
                                const CollisionParameters& parameters,
                                RowKernel<Real> whole_block) {
    using namespace d3q19;
    const std::ptrdiff_t count = length - x;
    alignas(64) Real f[directions][Width] = {};
    alignas(64) Real local_force[3][Width] = {};
    Real* f_at[directions];
    const Real* force_at[3];
    for (int q = 0; q < directions; ++q) {
        f_at[q] = f[q];
        for (std::ptrdiff_t i = 0; i < count; ++i) f[q][i] = at[q][x + i];
    }
    for (int a = 0; a < 3; ++a) {
        force_at[a] = local_force[a];
        if constexpr (Forced) {
            for (std::ptrdiff_t i = 0; i < count; ++i)
                local_force[a][i] = force[a][x + i];
        }
    }
    const bool valid = whole_block(f_at, force_at, Width, parameters);
    for (int q = 0; q < directions; ++q) {
        for (std::ptrdiff_t i = 0; i < count; ++i) at[q][x + i] = f[q][i];
    }
    return valid;
}

// at: 19 pointers; force: three pointers, force density in lattice units, unused if not
// Forced. V: the vector computed with. itself: the function that this is inlined into.
template <class C, bool Forced, class V, class Real>
MAGFSI_INLINE bool collide_row(Real* const* at, const Real* const* force,
                               std::ptrdiff_t length,
                               const CollisionParameters& parameters,
                               RowKernel<Real> itself) {
    const Rates<V> r = rates<V>(parameters);
    CellCheck<V> check;
    std::ptrdiff_t x = 0;
    for (; x + lanes<V> <= length; x += lanes<V>) {
        if (x % cells_per_line<Real> == 0) {
            prefetch_for_write(at, x);
            if constexpr (Forced) prefetch_force(force, x);
        }
        collide_block<C, Forced, V>(at, force, x, r, check);
    }
    bool valid = check.all_valid();
    if (x < length) {
        valid &= collide_tail<Forced, lanes<V>>(at, force, x, length, parameters, itself);
    }
    return valid;
}

template <class Real>
MAGFSI_INLINE void prefetch_for_read(const Real* const* at, std::ptrdiff_t x) {
    for (int q = 0; q < d3q19::directions; ++q) {
        __builtin_prefetch(at[q] + x + lines_ahead * cells_per_line<Real>, 0, 3);
    }
}

// Moments of a few cells without a collision, in double whatever is stored.
template <class V, class Real>
MAGFSI_INLINE void sample_block(const Real* const* at, std::ptrdiff_t x,
                                double* const* out) {
    V f[d3q19::directions];
#pragma GCC unroll 19
    for (int q = 0; q < d3q19::directions; ++q) f[q] = load<V>(at[q] + x);
    const Moments<V> m = moments(f);
    store(out[0] + x, m.excess);
    for (int a = 0; a < 3; ++a) store(out[1 + a] + x, m.j[a]);
}

// out: density - 1 and the three components of sum c f, four arrays of the same length.
template <int Width, class Real>
MAGFSI_INLINE void sample_row(const Real* const* at, std::ptrdiff_t length,
                              double* const* out) {
    std::ptrdiff_t x = 0;
    for (; x + Width <= length; x += Width) {
        if (x % cells_per_line<Real> == 0) prefetch_for_read(at, x);
        sample_block<typename Simd<double, Width>::Vector>(at, x, out);
    }
    for (; x < length; ++x) {
        sample_block<typename Simd<double, 1>::Vector>(at, x, out);
    }
}

}  // namespace magfsi::fluid

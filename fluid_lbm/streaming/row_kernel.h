// SPDX-License-Identifier: GPL-2.0-or-later
// Collision and in-place streaming of one row: the kernel reads the 19 populations that
// arrive at each cell and writes each outgoing one to the slot of the opposite
// population. With natural and swapped pointers in turn (lattice/populations.h) this is a
// whole step of the AA pattern (Bailey et al. 2009) without a second grid.
#pragma once

#include <cstddef>

#include "fluid_lbm/collision/cells.h"
#include "fluid_lbm/collision/moments.h"
#include "fluid_lbm/streaming/kernels.h"

namespace magfsi::fluid {

// Distance from the current cell to the prefetched one, in cache lines. Prefetching with
// write intent was the largest single gain measured (1.3 to 1.5 times on one core).
inline constexpr std::ptrdiff_t lines_ahead = 5;
template <class Real>
inline constexpr std::ptrdiff_t cells_per_line = 64 / sizeof(Real);

// Collides the vector of cells that begins at x.
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

// Prefetches the cache lines that lie lines_ahead of x: 19 of populations, three of
// forces.
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

// Buffer for the last cells of a row whose length is no multiple of the vector width: the
// elements behind the row belong to other rows. Surplus cells of the buffer are at rest.
template <bool Forced, class Real, int Width>
class RowEnd {
  public:
    // Copies `count` cells from x on into the buffer.
    MAGFSI_INLINE void take(Real* const* at, const Real* const* force, std::ptrdiff_t x,
                            int count) {
        for (int q = 0; q < d3q19::directions; ++q) {
            at_[q] = f_[q];
            store(f_[q], load_some<Stored>(at[q] + x, count));
        }
        if constexpr (Forced) {
            for (int a = 0; a < 3; ++a) {
                force_at_[a] = force_[a];
                store(force_[a], load_some<Stored>(force[a] + x, count));
            }
        }
    }
    // Copies the buffer's first `count` cells back to the row.
    MAGFSI_INLINE void put_back(Real* const* at, std::ptrdiff_t x, int count) const {
        for (int q = 0; q < d3q19::directions; ++q)
            store_some(at[q] + x, load<Stored>(f_[q]), count);
    }
    Real* const* at() const { return at_; }
    const Real* const* force() const { return force_at_; }

  private:
    using Stored = typename Simd<Real, Width>::Vector;
    alignas(64) Real f_[d3q19::directions][Width];
    alignas(64) Real force_[3][Width];
    Real* at_[d3q19::directions];
    const Real* force_at_[3];
};

// Collides and streams a row of `length` cells. at: the row's 19 pointers
// (RowPointers::at); force: three pointers to the force density in lattice units, unused
// unless Forced; V: the vector computed with. Returns false if a cell fails CellCheck.
template <class C, bool Forced, class V, class Real>
MAGFSI_INLINE bool collide_row(Real* const* at, const Real* const* force,
                               std::ptrdiff_t length,
                               const CollisionParameters& parameters) {
    const Rates<V> r = rates<V>(parameters);
    CellCheck<V> check;
    const std::ptrdiff_t end = length / lanes<V> * lanes<V>;
    const int left = length - end;
    RowEnd<Forced, Real, lanes<V>> row_end;
    // The end of the row is treated as a row of one vector by the same instructions;
    // separate code for it took as long as three vectors.
    for (bool whole = true;; whole = false) {
        if (!whole) row_end.take(at, force, end, left);
        Real* const* cells = whole ? at : row_end.at();
        const Real* const* forces = whole ? force : row_end.force();
        const std::ptrdiff_t length_here = whole ? end : lanes<V>;
        for (std::ptrdiff_t x = 0; x < length_here; x += lanes<V>) {
            if (x % cells_per_line<Real> == 0) {
                prefetch_for_write(cells, x);
                if constexpr (Forced) prefetch_force(forces, x);
            }
            collide_block<C, Forced, V>(cells, forces, x, r, check);
        }
        if (!whole || left == 0) break;
    }
    if (left > 0) row_end.put_back(at, end, left);
    return check.all_valid();
}

template <class Real>
MAGFSI_INLINE void prefetch_for_read(const Real* const* at, std::ptrdiff_t x) {
    for (int q = 0; q < d3q19::directions; ++q) {
        __builtin_prefetch(at[q] + x + lines_ahead * cells_per_line<Real>, 0, 3);
    }
}

// Density - 1 and momentum of a vector of cells, without a collision, in double for
// either storage.
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

// Density - 1 and momentum of a row's cells. out: density - 1 and the three components of
// sum c f, four arrays of `length` values.
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

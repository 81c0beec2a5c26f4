// Collision and in-place streaming of one row: reads the 19 populations that arrive at
// each cell and writes each outgoing one to the slot of the opposite. With natural and
// swapped pointers in turn (lattice/populations.h) this is a whole AA step without a
// second grid.
#pragma once

#include <cstddef>

#include "fluid_lbm/collision/simd.h"

namespace magfsi::fluid {

// Doubles between the prefetched and the current cell: five cache lines. Asking for the
// line with write intent was the largest single gain measured (1.3 to 1.5 times a core).
inline constexpr std::ptrdiff_t prefetch_ahead = 5 * 8;

template <class Collision, bool Forced, class V>
MAGFSI_INLINE void collide_block(double* const* at, const double* const* force,
                                 std::ptrdiff_t x, double omega) {
    using namespace d3q19;
    V f[directions], local_force[3] = {};
// Unrolled, or the compiler keeps f in memory.
#pragma GCC unroll 19
    for (int q = 0; q < directions; ++q) f[q] = load<V>(at[q] + x);
    if constexpr (Forced) {
        for (int a = 0; a < 3; ++a) local_force[a] = load<V>(force[a] + x);
    }
    Collision::template collide<Forced>(f, local_force, omega);
#pragma GCC unroll 19
    for (int q = 0; q < directions; ++q) store(at[opposite(q)] + x, f[q]);
}

MAGFSI_INLINE void prefetch_for_write(double* const* at, std::ptrdiff_t x) {
#pragma GCC unroll 19
    for (int q = 0; q < d3q19::directions; ++q) {
        __builtin_prefetch(at[q] + x + prefetch_ahead, 1, 3);
    }
}

// The last cells of a row whose length is no multiple of the vector width: through a
// buffer, because the elements behind the row belong to other rows.
template <class Collision, bool Forced, int Width>
MAGFSI_INLINE void collide_tail(double* const* at, const double* const* force,
                                std::ptrdiff_t x, std::ptrdiff_t length, double omega) {
    using namespace d3q19;
    const std::ptrdiff_t count = length - x;
    alignas(64) double f[directions][Width] = {}, local_force[3][Width] = {};
    double* f_at[directions];
    const double* force_at[3];
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
    using V = typename Simd<Width>::Vector;
    collide_block<Collision, Forced, V>(f_at, force_at, 0, omega);
    for (int q = 0; q < directions; ++q) {
        for (std::ptrdiff_t i = 0; i < count; ++i) at[q][x + i] = f[q][i];
    }
}

// at: 19 pointers; force: three pointers, force density in lattice units, unused if not
// Forced; omega = 1 / tau.
template <class Collision, bool Forced, int Width>
MAGFSI_INLINE void collide_row(double* const* at, const double* const* force,
                               std::ptrdiff_t length, double omega) {
    using V = typename Simd<Width>::Vector;
    std::ptrdiff_t x = 0;
    for (; x + Width <= length; x += Width) {
        if (x % 8 == 0) prefetch_for_write(at, x);  // once a cache line
        collide_block<Collision, Forced, V>(at, force, x, omega);
    }
    if (x < length) collide_tail<Collision, Forced, Width>(at, force, x, length, omega);
}

}  // namespace magfsi::fluid

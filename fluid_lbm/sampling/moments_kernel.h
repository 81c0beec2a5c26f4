// Moments of a row without a collision.
#pragma once

#include <cstddef>

#include "fluid_lbm/collision/simd.h"

namespace magfsi::fluid {

template <class V>
MAGFSI_INLINE void sample_block(const double* const* at, std::ptrdiff_t x,
                                double* const* out) {
    V f[d3q19::directions];
#pragma GCC unroll 19
    for (int q = 0; q < d3q19::directions; ++q) f[q] = load<V>(at[q] + x);
    const Moments<V> m = moments(f);
    store(out[0] + x, m.excess);
    for (int a = 0; a < 3; ++a) store(out[1 + a] + x, m.j[a]);
}

// out: density - 1 and the three components of sum c f, four arrays of the same length.
template <int Width>
MAGFSI_INLINE void sample_row(const double* const* at, std::ptrdiff_t length,
                              double* const* out) {
    std::ptrdiff_t x = 0;
    for (; x + Width <= length; x += Width) {
        if (x % 8 == 0) {
            for (int q = 0; q < d3q19::directions; ++q) {
                __builtin_prefetch(at[q] + x + 5 * 8, 0, 3);  // five cache lines ahead
            }
        }
        sample_block<typename Simd<Width>::Vector>(at, x, out);
    }
    for (; x < length; ++x) sample_block<typename Simd<1>::Vector>(at, x, out);
}

}  // namespace magfsi::fluid

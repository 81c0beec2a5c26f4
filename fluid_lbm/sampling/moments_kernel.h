// Moments of a row without a collision, in double whatever is stored.
#pragma once

#include <cstddef>

#include "fluid_lbm/collision/moments.h"

namespace magfsi::fluid {

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
    constexpr std::ptrdiff_t line = 64 / sizeof(Real);
    std::ptrdiff_t x = 0;
    for (; x + Width <= length; x += Width) {
        if (x % line == 0) {
            for (int q = 0; q < d3q19::directions; ++q) {
                __builtin_prefetch(at[q] + x + 5 * line, 0, 3);  // five lines ahead
            }
        }
        sample_block<typename Simd<double, Width>::Vector>(at, x, out);
    }
    for (; x < length; ++x) {
        sample_block<typename Simd<double, 1>::Vector>(at, x, out);
    }
}

}  // namespace magfsi::fluid

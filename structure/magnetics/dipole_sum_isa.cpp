// SPDX-License-Identifier: GPL-2.0-or-later
// The pair law of dipoles.h for several sources at a time.
#include <immintrin.h>

#include "base/isa/simd.h"
#include "structure/magnetics/dipole_sum.h"

#if !defined(MAGFSI_ISA)
#error "compiled by magfsi_isa_variants"
#endif

namespace magfsi::structure::MAGFSI_ISA {
namespace {

constexpr int width = vector_bytes / static_cast<int>(sizeof(double));
using Real = Simd<double, width>::Vector;

// Square root of positive numbers. The library's function tests for others, one lane at a
// time.
MAGFSI_INLINE Real square_root(const Real& a) {
#if defined(MAGFSI_ISA_avx512)
    return _mm512_maskz_sqrt_pd(0xff, a);  // GCC 12 warns of the plain one
#elif defined(MAGFSI_ISA_avx2)
    return _mm256_sqrt_pd(a);
#else
    return _mm_sqrt_pd(a);
#endif
}

// Coefficients of the pair law: d_i d_j phi = c d_i d_j - a delta_ij, and e = -c' / r.
struct Law {
    Real a, c, e;
};

// square: squared distance; touch: sum of the two radii, below which the spheres overlap.
MAGFSI_INLINE Law law(const Real& square, const Real& touch) {
    const Real r = square_root(square), inverse = 1.0 / r, inverse2 = inverse * inverse;
    Law apart;
    apart.a = inverse * inverse2;
    apart.c = 3.0 * apart.a * inverse2;
    apart.e = 5.0 * apart.c * inverse2;
    // Overlapping spheres of half that distance as radius a; u = r / a runs from 0 to 2.
    const Real radius = 0.5 * touch, one = 1.0 / radius, one2 = one * one;
    const Real u = r * one, v = radius * inverse;
    Law within;
    within.a = one * one2 * (1.0 - 0.5625 * u + 0.03125 * u * u * u);
    within.c = one * one2 * one2 * (0.5625 * v - 0.09375 * u);
    within.e = one * one2 * one2 * one2 * v * (0.5625 * v * v + 0.09375);
    const auto overlap = r < touch;
    return {overlap ? within.a : apart.a, overlap ? within.c : apart.c,
            overlap ? within.e : apart.e};
}

// Field and gradient, summed lane by lane. Lanes at distance 0 add nothing.
struct Sums {
    Real field[3] = {}, gradient[6] = {};

    MAGFSI_INLINE void add(const Real (&d)[3], const Real (&m)[3], const Real& touch) {
        Real square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        const auto elsewhere = square > 0.0;
        square = elsewhere ? square : touch * touch;
        const Law pair = law(square, touch);
        const Real none = {};
        Real n[3];
        for (int i = 0; i < 3; ++i) n[i] = elsewhere ? m[i] : none;
        const Real along = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
        const Real ca = pair.c * along, ea = pair.e * along;
        for (int i = 0; i < 3; ++i) {
            field[i] += ca * d[i] - pair.a * n[i];
            gradient[i] += 2.0 * pair.c * n[i] * d[i] + ca - ea * d[i] * d[i];
        }
        gradient[3] += pair.c * (n[0] * d[1] + n[1] * d[0]) - ea * d[0] * d[1];
        gradient[4] += pair.c * (n[0] * d[2] + n[2] * d[0]) - ea * d[0] * d[2];
        gradient[5] += pair.c * (n[1] * d[2] + n[2] * d[1]) - ea * d[1] * d[2];
    }
};

MAGFSI_INLINE double total(const Real& lanes_of) {
    double sum = 0;
    for (int i = 0; i < width; ++i) sum += lanes_of[i];
    return sum;
}

}  // namespace

void add_dipoles(const DipoleArrays& dipoles, int at, int from, int to, DipoleSum& sum) {
    Real here[3];
    for (int i = 0; i < 3; ++i) here[i] = splat<Real>(dipoles.x[i][at]);
    const Real own = splat<Real>(dipoles.radius[at]);
    Sums sums;
    Real d[3], m[3];
    int j = from;
    for (; j + width <= to; j += width) {
        for (int i = 0; i < 3; ++i) {
            d[i] = here[i] - load<Real>(dipoles.x[i] + j);
            m[i] = load<Real>(dipoles.m[i] + j);
        }
        sums.add(d, m, own + load<Real>(dipoles.radius + j));
    }
    if (j < to) {  // the lanes past the end have no moment
        const int left = to - j;
        for (int i = 0; i < 3; ++i) {
            d[i] = here[i] - load_some<Real>(dipoles.x[i] + j, left);
            m[i] = load_some<Real>(dipoles.m[i] + j, left);
        }
        sums.add(d, m, own + load_some<Real>(dipoles.radius + j, left));
    }
    constexpr double scale = 1e-7;  // mu0 / (4 pi) [T m/A]
    for (int i = 0; i < 3; ++i) sum.field_t[i] += scale * total(sums.field[i]);
    for (int i = 0; i < 6; ++i) sum.gradient_t_m[i] += scale * total(sums.gradient[i]);
}

}  // namespace magfsi::structure::MAGFSI_ISA

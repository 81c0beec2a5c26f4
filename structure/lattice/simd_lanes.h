// Three vectors of lanes, and what the element kernels do with them: node access, the
// logarithm, Hadamard transforms. For the files of magfsi_isa_variants only; everything
// is internal to them.
#pragma once

#include "isa/simd.h"

#if !defined(MAGFSI_ISA)
#error "simd_lanes.h is for the files of magfsi_isa_variants"
#endif

namespace magfsi::structure::MAGFSI_ISA {
namespace {

constexpr int width = vector_bytes / sizeof(double);

using Real = Simd<double, width>::Vector;
using Bits = Simd<long long, width>::Vector;
using Pair = Simd<double, 2>::Vector;
typedef double LoosePair __attribute__((vector_size(16), aligned(8)));

MAGFSI_INLINE Real load(const double* p) {
    return load_aligned<Real>(p);
}
MAGFSI_INLINE Real splat(double value) {
    return magfsi::splat<Real>(value);
}

struct Vec {
    Real x, y, z;
};

MAGFSI_INLINE Vec operator+(const Vec& a, const Vec& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
MAGFSI_INLINE Vec operator-(const Vec& a, const Vec& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
MAGFSI_INLINE Vec operator*(const Real& s, const Vec& a) {
    return {s * a.x, s * a.y, s * a.z};
}
MAGFSI_INLINE Real dot(const Vec& a, const Vec& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
MAGFSI_INLINE Vec cross(const Vec& a, const Vec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// ln of a positive, normal number to about 2 ulp: x = 2^e m with m in [0.71, 1.41), then
// ln m = 2 atanh(s), s = (m - 1) / (m + 1), |s| < 0.172; the series' next term is 2e-17
// of it. Anything else gives some number, which the check of J catches.
MAGFSI_INLINE Real log_positive(const Real& x) {
    const Bits bits = reinterpret_cast<Bits>(x);
    const Bits mantissa = (bits & 0x000fffffffffffffLL) | 0x3fe0000000000000LL;
    // The biased exponent as a double without an integer conversion, which SSE2 lacks: it
    // fills the low bits of 2^52.
    const Bits exponent = ((bits >> 52) & 0x7ffLL) | 0x4330000000000000LL;
    Real m = reinterpret_cast<Real>(mantissa);
    Real e = reinterpret_cast<Real>(exponent) - (4503599627370496.0 + 1022.0);
    const auto small = m < 0.70710678118654752440;
    m = small ? m + m : m;
    e = small ? e - 1.0 : e;
    const Real f = m - 1.0;
    const Real s = f / (2.0 + f);
    const Real z = s * s;
    Real p = z * (1.0 / 19) + 1.0 / 17;
    p = p * z + 1.0 / 15;
    p = p * z + 1.0 / 13;
    p = p * z + 1.0 / 11;
    p = p * z + 1.0 / 9;
    p = p * z + 1.0 / 7;
    p = p * z + 1.0 / 5;
    p = p * z + 1.0 / 3;
    return e * 0.693147180559945309417232 + 2.0 * s * (1.0 + z * p);
}

// Positions of one node of `width` elements; (x, y) come as one 16-byte load, so nothing
// past the node is read.
MAGFSI_INLINE Vec gather_node(const double* x, const int* node) {
    Pair xy[width];
    Real z;
    for (int l = 0; l < width; ++l) {
        const double* p = x + 3 * static_cast<long>(node[l]);
        xy[l] = *reinterpret_cast<const LoosePair*>(p);
        z[l] = p[2];
    }
#if defined(MAGFSI_ISA_avx512)
    const auto even02 = __builtin_shufflevector(xy[0], xy[2], 0, 1, 2, 3);
    const auto even46 = __builtin_shufflevector(xy[4], xy[6], 0, 1, 2, 3);
    const auto odd13 = __builtin_shufflevector(xy[1], xy[3], 0, 1, 2, 3);
    const auto odd57 = __builtin_shufflevector(xy[5], xy[7], 0, 1, 2, 3);
    const Real even = __builtin_shufflevector(even02, even46, 0, 1, 2, 3, 4, 5, 6, 7);
    const Real odd = __builtin_shufflevector(odd13, odd57, 0, 1, 2, 3, 4, 5, 6, 7);
    return {__builtin_shufflevector(even, odd, 0, 8, 2, 10, 4, 12, 6, 14),
            __builtin_shufflevector(even, odd, 1, 9, 3, 11, 5, 13, 7, 15), z};
#elif defined(MAGFSI_ISA_avx2)
    const Real even = __builtin_shufflevector(xy[0], xy[2], 0, 1, 2, 3);
    const Real odd = __builtin_shufflevector(xy[1], xy[3], 0, 1, 2, 3);
    return {__builtin_shufflevector(even, odd, 0, 4, 2, 6),
            __builtin_shufflevector(even, odd, 1, 5, 3, 7), z};
#else
    return {__builtin_shufflevector(xy[0], xy[1], 0, 2),
            __builtin_shufflevector(xy[0], xy[1], 1, 3), z};
#endif
}

// Adds v to the node of the first `count` lanes, one after the other: lanes may share a
// node.
MAGFSI_INLINE void scatter_node(double* f, const int* node, const Vec& v, int count) {
    for (int l = 0; l < count; ++l) {
        double* p = f + 3 * static_cast<long>(node[l]);
        const Pair sum = *reinterpret_cast<const LoosePair*>(p) + Pair{v.x[l], v.y[l]};
        *reinterpret_cast<LoosePair*>(p) = sum;
        p[2] += v.z[l];
    }
}

// v[m] = sum_a h_m(a) v[a] in place.
MAGFSI_INLINE void to_modes(Vec (&v)[8]) {
    for (int s = 1; s < 8; s <<= 1) {
        for (int i = 0; i < 8; ++i) {
            if ((i & s) != 0) continue;
            const Vec a = v[i];
            const Vec b = v[i | s];
            v[i] = a + b;
            v[i | s] = b - a;
        }
    }
}

// v[a] = sum_m h_m(a) v[m] in place.
MAGFSI_INLINE void to_nodes(Vec (&v)[8]) {
    for (int s = 1; s < 8; s <<= 1) {
        for (int i = 0; i < 8; ++i) {
            if ((i & s) != 0) continue;
            const Vec a = v[i];
            const Vec b = v[i | s];
            v[i] = a - b;
            v[i | s] = a + b;
        }
    }
}

}  // namespace
}  // namespace magfsi::structure::MAGFSI_ISA

// SPDX-License-Identifier: GPL-2.0-or-later
// Functions that the element kernels share, `width` elements at a time: node access,
// logarithm, Hadamard transforms, mean deformation gradient, hourglass strains and
// stresses. For files of magfsi_isa_variants only; everything has internal linkage, as
// each instruction set has its own copy.
#pragma once

#include "base/isa/simd.h"
#include "structure/lattice/kernel_data.h"

#if !defined(MAGFSI_ISA)
#error "element_lanes.h is for the files of magfsi_isa_variants"
#endif

namespace magfsi::structure::MAGFSI_ISA {
namespace {

// Number of doubles in a vector register.
constexpr int width = vector_bytes / sizeof(double);

using Real = Simd<double, width>::Vector;
using Bits = Simd<long long, width>::Vector;
using Pair = Simd<double, 2>::Vector;
// A pair that need not be aligned to 16 bytes.
typedef double LoosePair __attribute__((vector_size(16), aligned(8)));

MAGFSI_INLINE Real load(const double* p) {
    return load_aligned<Real>(p);
}
MAGFSI_INLINE Real splat(double value) {
    return magfsi::splat<Real>(value);
}

// Vectors of `width` elements, component by component.
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

// Logarithm of a positive normal number to about 2 ulp: x = 2^e m with m in [0.71, 1.41),
// ln m = 2 atanh(s), s = (m - 1) / (m + 1), |s| < 0.172. The next term of the series is
// 2e-17 of the sum. Other arguments give some number; the check of J finds them.
MAGFSI_INLINE Real log_positive(const Real& x) {
    const Bits bits = reinterpret_cast<Bits>(x);
    const Bits mantissa = (bits & 0x000fffffffffffffLL) | 0x3fe0000000000000LL;
    // The biased exponent becomes a double without an integer conversion, which SSE2
    // lacks: it fills the low bits of 2^52.
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

// Positions of one node of each of `width` elements. x and y are one 16-byte load, so
// that nothing past the node is read.
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

// Adds v to the nodes of the first `count` lanes, one after the other, as lanes may share
// a node.
MAGFSI_INLINE void scatter_node(double* f, const int* node, const Vec& v, int count) {
    for (int l = 0; l < count; ++l) {
        double* p = f + 3 * static_cast<long>(node[l]);
        const Pair sum = *reinterpret_cast<const LoosePair*>(p) + Pair{v.x[l], v.y[l]};
        *reinterpret_cast<LoosePair*>(p) = sum;
        p[2] += v.z[l];
    }
}

// Transform to Hadamard modes, v[m] = sum_a h_m(a) v[a], in place.
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

// Transform to nodes, v[a] = sum_m h_m(a) v[m], in place.
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

// Columns of the mean deformation gradient F = sum_m u_m B_m^T.
MAGFSI_INLINE void mean_gradient(const double* gradient, const Vec (&u)[8], Vec (&f)[3]) {
    for (Vec& column : f) column = {Real{}, Real{}, Real{}};
    for (int m = 1; m < 8; ++m) {
        for (int d = 0; d < 3; ++d) {
            f[d] = f[d] + load(gradient + (3 * (m - 1) + d) * batch_lanes) * u[m];
        }
    }
}

// Adds the forces of a stress on F to the modes. stress: an eighth of V0 P, one column
// per reference direction.
MAGFSI_INLINE void add_stress(const double* gradient, const Vec (&stress)[3],
                              Vec (&g)[8]) {
    for (int m = 1; m < 8; ++m) {
        for (int d = 0; d < 3; ++d) {
            g[m] = g[m] + load(gradient + (3 * (m - 1) + d) * batch_lanes) * stress[d];
        }
    }
}

// Subtracts from v_j the part F X_j of a homogeneous deformation. return_linear is the
// adjoint: it takes the forces w_j on v_j to the stress on F.
template <int count>
MAGFSI_INLINE void take_off_linear(const double* offset, const Vec (&f)[3],
                                   Vec (&v)[count]) {
    for (int j = 0; j < count; ++j) {
        for (int d = 0; d < 3; ++d) {
            v[j] = v[j] - load(offset + (3 * j + d) * batch_lanes) * f[d];
        }
    }
}
template <int count>
MAGFSI_INLINE void return_linear(const double* offset, const Vec (&w)[count],
                                 Vec (&stress)[3]) {
    for (int j = 0; j < count; ++j) {
        for (int d = 0; d < 3; ++d) {
            stress[d] = stress[d] - load(offset + (3 * j + d) * batch_lanes) * w[j];
        }
    }
}

// Strain (E_11, E_22, 2 E_12) of one group, or the stress that is conjugate to it.
struct Plane {
    Real first, second, shear;
};

// The three groups of hourglass_energy: strains that vary along x, y and z.
struct Planes {
    Plane x, y, z;
};

MAGFSI_INLINE Plane operator+(const Plane& a, const Plane& b) {
    return {a.first + b.first, a.second + b.second, a.shear + b.shear};
}
MAGFSI_INLINE Planes operator+(const Planes& a, const Planes& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
MAGFSI_INLINE Real dot(const Plane& a, const Plane& b) {
    return a.first * b.first + a.second * b.second + a.shear * b.shear;
}
MAGFSI_INLINE Real dot(const Planes& a, const Planes& b) {
    return dot(a.x, b.x) + dot(a.y, b.y) + dot(a.z, b.z);
}

// An eighth of V0 (2 G / 3, lambda' / 3): with this factor the stress adds directly to g.
struct HourglassModuli {
    Real g, lambda;
};

// v0: volumes [m3].
MAGFSI_INLINE HourglassModuli hourglass_moduli(double g, double lambda, const Real& v0) {
    return {v0 * (g / 12), v0 * (lambda / 24)};
}

// Strains of the groups from the edge modes of u and the hourglass vectors v = xy, xz,
// yz.
MAGFSI_INLINE Planes hourglass_strain(const Vec (&u)[8], const Vec (&v)[3]) {
    const Vec &u1 = u[1], &u2 = u[2], &u3 = u[4];
    return {{dot(u2, v[0]), dot(u3, v[1]), dot(u2, v[1]) + dot(u3, v[0])},
            {dot(u1, v[0]), dot(u3, v[2]), dot(u1, v[2]) + dot(u3, v[0])},
            {dot(u1, v[1]), dot(u2, v[2]), dot(u1, v[2]) + dot(u2, v[1])}};
}

// Stress of a group with orthogonal edges; p and q are the inverse squares of the half
// edges.
MAGFSI_INLINE Plane plane_stress(const HourglassModuli& c, const Real& p, const Real& q,
                                 const Plane& strain) {
    const Real first = p * strain.first;
    const Real second = q * strain.second;
    const Real trace = c.lambda * (first + second);
    return {p * (c.g * first + trace), q * (c.g * second + trace),
            0.5 * c.g * p * q * strain.shear};
}

// Stress of a group with any edges; the inverse metric is [[p, r], [r, q]].
MAGFSI_INLINE Plane plane_stress(const HourglassModuli& c, const double* metric,
                                 const Plane& strain) {
    const Real p = load(metric);
    const Real q = load(metric + batch_lanes);
    const Real r = load(metric + 2 * batch_lanes);
    const Real half = 0.5 * strain.shear;
    const Real m11 = p * strain.first + r * half;
    const Real m12 = p * half + r * strain.second;
    const Real m21 = r * strain.first + q * half;
    const Real m22 = r * half + q * strain.second;
    const Real trace = c.lambda * (m11 + m22);
    return {c.g * (m11 * p + m12 * r) + trace * p, c.g * (m21 * r + m22 * q) + trace * q,
            c.g * (m11 * r + m12 * q) + trace * r};
}

// Stresses of the three groups. metric: three entries for bricks (inverse squares of the
// half edges), nine in general.
template <bool brick>
MAGFSI_INLINE Planes hourglass_stress(const HourglassModuli& c, const double* metric,
                                      const Planes& strain) {
    if constexpr (brick) {
        const Real ix = load(metric);
        const Real iy = load(metric + batch_lanes);
        const Real iz = load(metric + 2 * batch_lanes);
        return {plane_stress(c, iy, iz, strain.x), plane_stress(c, ix, iz, strain.y),
                plane_stress(c, ix, iy, strain.z)};
    } else {
        return {plane_stress(c, metric, strain.x),
                plane_stress(c, metric + 3 * batch_lanes, strain.y),
                plane_stress(c, metric + 6 * batch_lanes, strain.z)};
    }
}

// Minus the forces of the stresses s: added to the edge modes of g, stored in w for the
// hourglass vectors v.
MAGFSI_INLINE void hourglass_forces(const Planes& s, const Vec (&u)[8], const Vec (&v)[3],
                                    Vec (&g)[8], Vec (&w)[3]) {
    const Vec &u1 = u[1], &u2 = u[2], &u3 = u[4];
    const Real u1_yz = s.y.shear + s.z.shear;
    const Real u2_xz = s.x.shear + s.z.shear;
    const Real u3_xy = s.x.shear + s.y.shear;
    g[1] = g[1] + s.y.first * v[0] + s.z.first * v[1] + u1_yz * v[2];
    g[2] = g[2] + s.x.first * v[0] + u2_xz * v[1] + s.z.second * v[2];
    g[4] = g[4] + u3_xy * v[0] + s.x.second * v[1] + s.y.second * v[2];
    w[0] = s.y.first * u1 + s.x.first * u2 + u3_xy * u3;
    w[1] = s.z.first * u1 + u2_xz * u2 + s.x.second * u3;
    w[2] = u1_yz * u1 + s.z.second * u2 + s.y.second * u3;
}

}  // namespace
}  // namespace magfsi::structure::MAGFSI_ISA

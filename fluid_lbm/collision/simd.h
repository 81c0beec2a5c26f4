// What collision kernels are written in: GCC vector extensions, one source for every
// instruction set and both precisions. Everything here is always inlined into the
// functions of a variant's namespace, so that no symbol compiled for AVX-512 can be
// picked by another variant.
//
// Factors such as 4.5 in kernels are doubles that float holds exactly; all others are
// made with constant<V>(...), rounded once from double.
#pragma once

#include "fluid_lbm/lattice/d3q19.h"

#define MAGFSI_INLINE [[gnu::always_inline]] inline
#define MAGFSI_INLINE_LAMBDA __attribute__((always_inline))

namespace magfsi::fluid {

template <class T, int Width>
struct Simd {
    using Vector [[gnu::vector_size(Width * sizeof(T))]] = T;
};

template <class T>
struct ValueOf {
    using Type = T;
};
template <class T>
struct ValueOf<T&> {
    using Type = T;
};
template <class T>
struct ValueOf<const T&> {
    using Type = T;
};
// float or double of a vector V.
template <class V>
using Lane = typename ValueOf<decltype(V{}[0])>::Type;

// The vector that an array, or a class with operator[], has at each index.
template <class Array>
const Array& some();  // never defined
template <class Array>
using VectorOf = typename ValueOf<decltype(some<Array>()[0])>::Type;

template <class V>
constexpr Lane<V> constant(double value) {
    return static_cast<Lane<V>>(value);
}

template <class V>
inline constexpr int lanes = sizeof(V) / sizeof(Lane<V>);

// Real may be narrower or wider than the lanes of V.
template <class V, class Real>
MAGFSI_INLINE V load(const Real* from) {
    typename Simd<Real, lanes<V>>::Vector value;
    __builtin_memcpy(&value, from, sizeof value);
    if constexpr (sizeof(Real) == sizeof(Lane<V>)) {
        return value;
    } else {
        return __builtin_convertvector(value, V);
    }
}

template <class V, class Real>
MAGFSI_INLINE void store(Real* to, const V& value) {
    if constexpr (sizeof(Real) == sizeof(Lane<V>)) {
        __builtin_memcpy(to, &value, sizeof value);
    } else {
        using Stored = typename Simd<Real, lanes<V>>::Vector;
        const Stored stored = __builtin_convertvector(value, Stored);
        __builtin_memcpy(to, &stored, sizeof stored);
    }
}

// c_q . a for the first direction of a pair, without multiplications.
template <int Q, class V>
MAGFSI_INLINE V along(const V (&a)[3]) {
    static_assert(Q % 2 == 1, "the first direction of a pair");
    constexpr const int(&c)[3] = d3q19::c[Q];
    constexpr int first = c[0] != 0 ? 0 : c[1] != 0 ? 1 : 2;
    constexpr int second = c[0] != 0 && c[1] != 0 ? 1 : first != 2 && c[2] != 0 ? 2 : -1;
    if constexpr (second < 0) {
        return a[first];
    } else if constexpr (c[second] > 0) {
        return a[first] + a[second];
    } else {
        return a[first] - a[second];
    }
}

}  // namespace magfsi::fluid

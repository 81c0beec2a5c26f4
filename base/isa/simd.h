// SPDX-License-Identifier: GPL-2.0-or-later
// Vectors for kernels: GCC vector extensions, one source for every instruction set and
// both precisions. All functions here are inlined into the functions of a variant's
// namespace, so that no symbol compiled for AVX-512 can be picked by another variant.
#pragma once

#if defined(MAGFSI_ISA_avx512) || defined(MAGFSI_ISA_avx2)
#include <immintrin.h>
#endif

// Marks of functions and of lambdas that must be inlined.
#define MAGFSI_INLINE [[gnu::always_inline]] inline
#define MAGFSI_INLINE_LAMBDA __attribute__((always_inline))

namespace magfsi {

// Size [bytes] of the vectors of the instruction set that this file is compiled for.
#if defined(MAGFSI_ISA_avx512)
constexpr int vector_bytes = 64;
#elif defined(MAGFSI_ISA_avx2)
constexpr int vector_bytes = 32;
#else
constexpr int vector_bytes = 16;
#endif

// Vector of Width values of type T.
template <class T, int Width>
struct Simd {
    using Vector [[gnu::vector_size(Width * sizeof(T))]] = T;
};

// T without a reference or const; the standard library's remove_cvref must not be
// instantiated in kernels (see cmake/IsaVariants.cmake).
template <class T>
struct ValueOf {
    using Type = T;
};
template <class T>
struct ValueOf<T&> {
    using Type = T;
};
template <class T>
struct ValueOf<T&&> {
    using Type = T;
};
template <class T>
struct ValueOf<const T&> {
    using Type = T;
};
// Type of a vector's lanes, float or double.
template <class V>
using Lane = typename ValueOf<decltype(V{}[0])>::Type;

// Type of the vector at an index of an array, or of a class with operator[].
template <class Array>
const Array& some();  // for decltype only; never defined
template <class Array>
using VectorOf = typename ValueOf<decltype(some<Array>()[0])>::Type;

// A constant of kernels in the precision of a vector's lanes, rounded once from double.
template <class V>
constexpr Lane<V> constant(double value) {
    return static_cast<Lane<V>>(value);
}

// Number of lanes of a vector.
template <class V>
inline constexpr int lanes = sizeof(V) / sizeof(Lane<V>);

// A vector with the value in all lanes.
template <class V>
MAGFSI_INLINE V splat(Lane<V> value) {
    return V{} + value;
}

// Loads a vector from any address. Real may be narrower or wider than the lanes of V:
// values are converted.
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

// Loads a vector from an address that is a multiple of its size.
template <class V>
MAGFSI_INLINE V load_aligned(const Lane<V>* from) {
    return *reinterpret_cast<const V*>(from);
}

// Stores a vector at any address, converted to Real.
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

// Mask with all bits set in the first `count` lanes.
template <class V>
MAGFSI_INLINE auto first_lanes(int count) {
    using Mask = decltype(V{} < V{});
    Mask index{};
    for (int i = 0; i < lanes<V>; ++i) index[i] = i;
    return index < static_cast<Lane<Mask>>(count);
}

// Loads the first `count` values of a vector, fewer than its lanes; the other lanes are
// 0. It serves the end of a row: with the masks of AVX2 and AVX-512 it takes as long as a
// whole vector.
template <class V>
MAGFSI_INLINE V load_some(const Lane<V>* from, int count) {
#if defined(MAGFSI_ISA_avx512)
    const unsigned some = (1u << count) - 1;
    if constexpr (lanes<V> == 16)
        return _mm512_maskz_loadu_ps(static_cast<__mmask16>(some), from);
    else if constexpr (sizeof(V) == 64)
        return _mm512_maskz_loadu_pd(static_cast<__mmask8>(some), from);
    else
        return _mm256_maskz_loadu_ps(static_cast<__mmask8>(some), from);
#elif defined(MAGFSI_ISA_avx2)
    const auto some = first_lanes<V>(count);
    if constexpr (lanes<V> == 8)
        return _mm256_maskload_ps(from, (__m256i)some);
    else if constexpr (sizeof(V) == 32)
        return _mm256_maskload_pd(from, (__m256i)some);
    else
        return _mm_maskload_ps(from, (__m128i)some);
#else
    V value{};
    for (int i = 0; i < count; ++i) value[i] = from[i];
    return value;
#endif
}

// Stores the first `count` lanes and leaves the memory behind them as it is.
template <class V>
MAGFSI_INLINE void store_some(Lane<V>* to, const V& value, int count) {
#if defined(MAGFSI_ISA_avx512)
    const unsigned some = (1u << count) - 1;
    if constexpr (lanes<V> == 16)
        _mm512_mask_storeu_ps(to, static_cast<__mmask16>(some), value);
    else if constexpr (sizeof(V) == 64)
        _mm512_mask_storeu_pd(to, static_cast<__mmask8>(some), value);
    else
        _mm256_mask_storeu_ps(to, static_cast<__mmask8>(some), value);
#elif defined(MAGFSI_ISA_avx2)
    const auto some = first_lanes<V>(count);
    if constexpr (lanes<V> == 8)
        _mm256_maskstore_ps(to, (__m256i)some, value);
    else if constexpr (sizeof(V) == 32)
        _mm256_maskstore_pd(to, (__m256i)some, value);
    else
        _mm_maskstore_ps(to, (__m128i)some, value);
#else
    for (int i = 0; i < count; ++i) to[i] = value[i];
#endif
}

}  // namespace magfsi

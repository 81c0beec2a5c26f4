// SPDX-License-Identifier: GPL-2.0-or-later
// Vectors (x, y, z). All parts of the program include this header.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <type_traits>

namespace magfsi {

// A vector lies in memory as three numbers, so that the data() of the first of many is
// one list of all their components. Operators round as if each component were written
// out, and sums run from x to z.
template <class T>
struct Vector3 : std::array<T, 3> {
    constexpr Vector3& operator+=(const Vector3& b) {
        for (std::size_t d = 0; d < 3; ++d) (*this)[d] = (*this)[d] + b[d];
        return *this;
    }
    constexpr Vector3& operator-=(const Vector3& b) {
        for (std::size_t d = 0; d < 3; ++d) (*this)[d] = (*this)[d] - b[d];
        return *this;
    }
    constexpr Vector3& operator*=(T factor) {
        for (T& x : *this) x = x * factor;
        return *this;
    }
    constexpr Vector3& operator/=(T divisor) {
        for (T& x : *this) x = x / divisor;
        return *this;
    }

    friend constexpr Vector3 operator-(const Vector3& a) { return {-a[0], -a[1], -a[2]}; }
    friend constexpr Vector3 operator+(const Vector3& a, const Vector3& b) {
        return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
    }
    friend constexpr Vector3 operator-(const Vector3& a, const Vector3& b) {
        return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    }
    friend constexpr Vector3 operator*(const Vector3& a, const T& factor) {
        return {a[0] * factor, a[1] * factor, a[2] * factor};
    }
    friend constexpr Vector3 operator*(const T& factor, const Vector3& a) {
        return {factor * a[0], factor * a[1], factor * a[2]};
    }
    friend constexpr Vector3 operator/(const Vector3& a, const T& divisor) {
        return {a[0] / divisor, a[1] / divisor, a[2] / divisor};
    }
    friend constexpr T dot(const Vector3& a, const Vector3& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    friend constexpr Vector3 cross(const Vector3& a, const Vector3& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                a[0] * b[1] - a[1] * b[0]};
    }
    // The length, without overflow or underflow on the way.
    friend T norm(const Vector3& a) { return std::hypot(a[0], a[1], a[2]); }
    // The lower and the higher value of each component.
    friend constexpr Vector3 lower(const Vector3& a, const Vector3& b) {
        return {std::min(a[0], b[0]), std::min(a[1], b[1]), std::min(a[2], b[2])};
    }
    friend constexpr Vector3 higher(const Vector3& a, const Vector3& b) {
        return {std::max(a[0], b[0]), std::max(a[1], b[1]), std::max(a[2], b[2])};
    }
};

using Vec3 = Vector3<double>;
static_assert(sizeof(Vec3) == 3 * sizeof(double) && std::is_trivially_copyable_v<Vec3>);

// The vector of three numbers that follow each other in a list.
inline Vec3 vector_at(const double* x) {
    return {x[0], x[1], x[2]};
}
// Adds a vector to three numbers of a list.
inline void add_to(double* x, const Vec3& v) {
    for (std::size_t d = 0; d < 3; ++d) x[d] += v[d];
}

}  // namespace magfsi

// For `const auto& [x, y, z] = vector`.
template <class T>
struct std::tuple_size<magfsi::Vector3<T>> : std::integral_constant<std::size_t, 3> {};
template <std::size_t I, class T>
struct std::tuple_element<I, magfsi::Vector3<T>> {
    using type = T;
};

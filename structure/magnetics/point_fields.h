// SPDX-License-Identifier: GPL-2.0-or-later
// Flux density [T] of elementary sources at a point of their own frame, outside of them.
// Closed forms in a number type T: with T = Gradient they give exact gradients, too.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "base/vector/vec3.h"

namespace magfsi::structure::point_fields {

inline constexpr double mu0 = 4e-7 * std::numbers::pi;  // [T m/A], to 1e-9

// Number with its derivatives along x, y and z (forward-mode differentiation).
struct Gradient {
    double value = 0;
    Vec3 d{};

    Gradient() = default;
    Gradient(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor)
    Gradient(double v, const Vec3& derivatives) : value(v), d(derivatives) {}
    // The coordinate along an axis, whose derivative along it is 1.
    static Gradient along(int axis, double v) {
        Gradient out(v);
        out.d[axis] = 1;
        return out;
    }
};

// Value f(a) of a function whose derivative at a is df.
inline Gradient chain(const Gradient& a, double f, double df) {
    return {f, df * a.d};
}
// Value f of a function of a and b whose derivatives are da and db.
inline Gradient chain(const Gradient& a, const Gradient& b, double f, double da,
                      double db) {
    return {f, da * a.d + db * b.d};
}
inline Gradient operator+(const Gradient& a, const Gradient& b) {
    return chain(a, b, a.value + b.value, 1, 1);
}
inline Gradient operator-(const Gradient& a, const Gradient& b) {
    return chain(a, b, a.value - b.value, 1, -1);
}
inline Gradient operator-(const Gradient& a) {
    return chain(a, -a.value, -1);
}
inline Gradient operator*(const Gradient& a, const Gradient& b) {
    return chain(a, b, a.value * b.value, b.value, a.value);
}
inline Gradient operator/(const Gradient& a, const Gradient& b) {
    const double f = a.value / b.value;
    return chain(a, b, f, 1 / b.value, -f / b.value);
}
inline Gradient sqrt(const Gradient& a) {
    const double f = std::sqrt(a.value);
    return chain(a, f, 0.5 / f);
}
inline Gradient log(const Gradient& a) {
    return chain(a, std::log(a.value), 1 / a.value);
}
inline Gradient atan2(const Gradient& y, const Gradient& x) {
    const double square = x.value * x.value + y.value * y.value;
    return chain(y, x, std::atan2(y.value, x.value), x.value / square, -y.value / square);
}
inline Gradient abs(const Gradient& a) {
    return a.value < 0 ? -a : a;
}
// The value without derivatives, for comparisons.
inline double number(const Gradient& a) {
    return a.value;
}
inline double number(double a) {
    return a;
}

template <class T>
using Point = Vector3<T>;
template <class T>
using Field = Vector3<T>;

// --- dipole ---------------------------------------------------------------------------

// Field of a point dipole, mu0 / (4 pi) [3 (m . r) r / r^5 - m / r^3].
template <class T>
Field<T> dipole(const Point<T>& x, const Vec3& moment_a_m2) {
    using std::sqrt;
    const T square = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    const T along =
        x[0] * T(moment_a_m2[0]) + x[1] * T(moment_a_m2[1]) + x[2] * T(moment_a_m2[2]);
    const T cube = T(1e-7) / (square * sqrt(square));
    const T part = T(3) * along / square;
    Field<T> out;
    for (std::size_t i = 0; i < 3; ++i) out[i] = cube * (part * x[i] - T(moment_a_m2[i]));
    return out;
}

// --- cuboid ---------------------------------------------------------------------------

// ln[(v1 + r1) / (v0 + r0)] with r^2 = v^2 + s for both, without cancellation for
// negative v.
template <class T>
T log_ratio(const T& v1, const T& r1, const T& v0, const T& r0) {
    using std::log;
    if (number(v1) < 0 && number(v0) < 0) return log((r0 - v0) / (r1 - v1));
    return log((v1 + r1) / (v0 + r0));
}

// Field of a block with these half edges and the polarisation 1 T along its axis z: two
// faces of the charge +-1 T. With u, v, w the distances from a corner and R^2 = u^2 + v^2
// + w^2, each face gives the differences over its corners of
//   -ln(v + R), -ln(u + R), atan(u v / (w R)), over 4 pi (Yang et al. 1990; Furlani
// 2001).
template <class T>
Field<T> cuboid_along_z(const Point<T>& x, const Vec3& half_m) {
    using std::atan2;
    using std::sqrt;
    Field<T> out{T(0), T(0), T(0)};
    for (int face = 0; face < 2; ++face) {
        const double charge = face == 0 ? 1 : -1;
        const T w = x[2] - T(charge * half_m[2]);
        const T u[2] = {x[0] - T(half_m[0]), x[0] + T(half_m[0])};
        const T v[2] = {x[1] - T(half_m[1]), x[1] + T(half_m[1])};
        T r[2][2];
        for (int i = 0; i < 2; ++i) {
            for (int j = 0; j < 2; ++j) r[i][j] = sqrt(u[i] * u[i] + v[j] * v[j] + w * w);
        }
        const T scale(charge / (4 * std::numbers::pi));
        for (int i = 0; i < 2; ++i) {
            const T sign(i == 0 ? 1 : -1);
            out[0] = out[0] + scale * sign * log_ratio(v[1], r[i][1], v[0], r[i][0]);
            out[1] = out[1] + scale * sign * log_ratio(u[1], r[1][i], u[0], r[0][i]);
            for (int j = 0; j < 2; ++j) {
                const T corner(i == j ? 1 : -1);
                out[2] = out[2] + scale * corner * atan2(u[i] * v[j], w * r[i][j]);
            }
        }
    }
    return out;
}

// Field of a block with any polarisation, as the sum over its three components.
template <class T>
Field<T> cuboid(const Point<T>& x, const Vec3& half_m, const Vec3& polarization_t) {
    Field<T> out{T(0), T(0), T(0)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (polarization_t[axis] == 0) continue;
        // The axes are permuted cyclically, so that this one is z.
        const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
        const Field<T> turned = cuboid_along_z<T>({x[i], x[j], x[axis]},
                                                  {half_m[i], half_m[j], half_m[axis]});
        const T strength(polarization_t[axis]);
        out[i] = out[i] + strength * turned[0];
        out[j] = out[j] + strength * turned[1];
        out[axis] = out[axis] + strength * turned[2];
    }
    return out;
}

// --- circular coil --------------------------------------------------------------------

// Bulirsch's complete elliptic integral over an angle from 0 to pi / 2 of
//   (a cos^2 + b sin^2) / (cos^2 + p sin^2) / sqrt(cos^2 + kc^2 sin^2), kc, p > 0
// (Numer. Math. 13 (1969) 305). One round more is done than the value needs, so that its
// derivatives are as exact.
template <class T>
T cel(const T& kc, const T& p, const T& a, const T& b) {
    using std::sqrt;
    T k = kc, em = T(1), root = sqrt(p), aa = a, bb = b / root, g = T(0);
    T e = k, f = aa;
    aa = aa + bb / root;
    g = e / root;
    bb = T(2) * (bb + f * g);
    root = root + g;
    g = em;
    em = em + k;
    for (int round = 0, more = 1; round < 40; ++round) {
        if (std::abs(number(g) - number(k)) <= 1e-8 * number(g) && more-- == 0) break;
        k = T(2) * sqrt(e);
        e = k * em;
        f = aa;
        aa = aa + bb / root;
        g = e / root;
        bb = T(2) * (bb + f * g);
        root = root + g;
        g = em;
        em = em + k;
    }
    return T(std::numbers::pi / 2) * (bb + aa * em) / (em * (em + root));
}

// Field near the axis of a source that is symmetric about z, from its value f(z) on the
// axis: the first terms of
//   B_z = f - rho^2 f''/4, B_rho = -rho f'/2 + rho^3 f'''/16.
template <class T>
Field<T> near_axis(const Point<T>& x, const T& f, const T& df, const T& ddf,
                   const T& dddf) {
    const T square = x[0] * x[0] + x[1] * x[1];
    const T across = square * dddf / T(16) - df / T(2);
    return {x[0] * across, x[1] * across, f - square * ddf / T(4)};
}
// Limit for near_axis, as a share of the radius or the distance: the terms left out are
// then below 1e-9.
inline constexpr double near = 4e-3;

// Field of one turn of this radius about z with the current 1 A (Smythe).
template <class T>
Field<T> loop(const Point<T>& x, double radius_m) {
    using std::sqrt;
    const T a(radius_m), z = x[2];
    const T rho2 = x[0] * x[0] + x[1] * x[1];
    const T s2 = a * a + z * z;
    if (number(rho2) < near * near * number(s2)) {
        const T c(mu0 * radius_m * radius_m / 2);
        const T s3 = s2 * sqrt(s2), s5 = s3 * s2, s7 = s5 * s2, s9 = s7 * s2;
        return near_axis(x, c / s3, T(-3) * c * z / s5,
                         c * (T(15) * z * z / s7 - T(3) / s5),
                         c * z * (T(45) / s7 - T(105) * z * z / s9));
    }
    const T rho = sqrt(rho2);
    const T far2 = (a + rho) * (a + rho) + z * z, near2 = (a - rho) * (a - rho) + z * z;
    const T kc = sqrt(near2 / far2);
    const T k = cel(kc, T(1), T(1), T(1)), e = cel(kc, T(1), T(1), kc * kc);
    const T scale = T(mu0 / (2 * std::numbers::pi)) / sqrt(far2);
    const T across = scale * z / rho2 * ((s2 + rho2) / near2 * e - k);
    return {across * x[0], across * x[1],
            scale * (k + (a * a - rho2 - z * z) / near2 * e)};
}

// --- cylinder -------------------------------------------------------------------------

// Field of a cylinder with the polarisation 1 T along its axis z, which is that of the
// current sheet of a solenoid (with cel: Derby and Olbert, Am. J. Phys. 78 (2010) 229).
template <class T>
Field<T> cylinder_along(const Point<T>& x, double radius_m, double half_m) {
    using std::sqrt;
    const T a(radius_m);
    const T rho2 = x[0] * x[0] + x[1] * x[1];
    const bool on_axis = number(rho2) < near * near * radius_m * radius_m;
    const T rho = on_axis ? T(0) : sqrt(rho2);
    // At the radius of the wall, above and below it, steps of the two ends cancel: the
    // mean of both sides is taken.
    if (constexpr double off = 1e-5; std::abs(number(rho) / radius_m - 1) < off / 2) {
        const T in(1 - off), out(1 + off);
        return (cylinder_along<T>({in * x[0], in * x[1], x[2]}, radius_m, half_m) +
                cylinder_along<T>({out * x[0], out * x[1], x[2]}, radius_m, half_m)) /
               T(2);
    }
    const T gamma = (a - rho) / (a + rho);
    Field<T> out{T(0), T(0), T(0)};
    for (const double end : {1.0, -1.0}) {
        const T z = x[2] + T(end * half_m);
        Field<T> part;
        if (on_axis) {
            const T s2 = z * z + a * a, s = sqrt(s2), s3 = s2 * s, s5 = s3 * s2;
            const T c(radius_m * radius_m / 2);
            part = near_axis(x, z / s / T(2), c / s3, T(-3) * c * z / s5,
                             c * (T(15) * z * z / (s5 * s2) - T(3) / s5));
        } else {
            const T far = sqrt(z * z + (a + rho) * (a + rho));
            const T kc = sqrt(z * z + (a - rho) * (a - rho)) / far;
            const T across =
                a / far * cel(kc, T(1), T(1), T(-1)) / T(std::numbers::pi) / rho;
            part = {across * x[0], across * x[1],
                    a / (a + rho) * z / far * cel(kc, gamma * gamma, T(1), gamma) /
                        T(std::numbers::pi)};
        }
        out += T(end) * part;
    }
    return out;
}

// Field of a cylinder with the polarisation (jx, jy) [T] across its axis. Its wall has
// the charge J cos(angle to J). Each line of it, of unit charge per length and with the
// ends w0, w1 away along z, gives over 4 pi
//   (w1/r1 - w0/r0) d / d^2 across, with d the vector from the line, and 1/r1 - 1/r0
// along -z.
// The lines are summed by the trapezoidal rule, which on a circle gains digits in
// proportion to their number: as many as the distance requires, at most 1024.
template <class T>
Field<T> cylinder_across(const Point<T>& x, double radius_m, double half_m, double jx,
                         double jy) {
    using std::sqrt;
    const double rho = std::hypot(number(x[0]), number(x[1]));
    // The rule's accuracy depends on the distance of the point from the wall.
    const double gap =
        std::max(std::abs(rho - radius_m), std::abs(number(x[2])) - half_m);
    const double ratio = radius_m / (radius_m + std::max(gap, 0.0));
    const double wanted = std::log(1e-12) / std::log(std::max(ratio, 1e-3));
    const int lines = std::min(1024.0, std::max(16.0, wanted));
    Field<T> out{T(0), T(0), T(0)};
    const T w1 = x[2] + T(half_m), w0 = x[2] - T(half_m);
    for (int i = 0; i < lines; ++i) {
        const double angle = 2 * std::numbers::pi * i / lines;
        const double c = std::cos(angle), s = std::sin(angle);
        const T dx = x[0] - T(radius_m * c), dy = x[1] - T(radius_m * s);
        const T d2 = dx * dx + dy * dy;
        const T r1 = sqrt(d2 + w1 * w1), r0 = sqrt(d2 + w0 * w0);
        const T charge((jx * c + jy * s) * radius_m / (2 * lines));
        // w1/r1 - w0/r0 over d2: above an end both are small, so the form without
        // cancellation is used.
        const T across =
            charge * (number(w0) * number(w1) > 0
                          ? (w1 * w1 - w0 * w0) / (r1 * r0 * (w1 * r0 + w0 * r1))
                          : (w1 / r1 - w0 / r0) / d2);
        out[0] = out[0] + across * dx;
        out[1] = out[1] + across * dy;
        out[2] = out[2] + charge * (T(1) / r0 - T(1) / r1);
    }
    return out;
}

// Field of a cylinder with any polarisation in its frame [T].
template <class T>
Field<T> cylinder(const Point<T>& x, double radius_m, double half_m,
                  const Vec3& polarization_t) {
    Field<T> out{T(0), T(0), T(0)};
    const auto& [jx, jy, jz] = polarization_t;
    if (jx != 0 || jy != 0) out = cylinder_across(x, radius_m, half_m, jx, jy);
    if (jz == 0) return out;
    return out + T(jz) * cylinder_along(x, radius_m, half_m);
}

}  // namespace magfsi::structure::point_fields

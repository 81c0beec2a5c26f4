// SPDX-License-Identifier: GPL-2.0-or-later
// Hourglass energy of assumed_strain and the forces of its strains and metric, `width`
// elements at a time. For files of magfsi_isa_variants only, as element_lanes.h.
#pragma once

#include "structure/lattice/element_lanes.h"

namespace magfsi::structure::MAGFSI_ISA {
namespace {

// Derivatives of the hourglass energy of one group: stress on its strain, and minus that
// on its metric.
struct PlaneForces {
    Plane strain, metric;
};

// Moduli of the hourglass energy.
struct PlateModuli {
    Real g, lambda;  // an eighth of V0 / 3 times G and lambda'
    double beta;
};

// Both derivatives for one group. metric: that of the present edges (11, 22, 12); rest:
// inverse metric at rest. Names follow hourglass_energy: m = M, a = A, b = M0 eps, x = M0
// eps M, n = M eps M.
MAGFSI_INLINE PlaneForces plane_forces(const PlateModuli& c, const Plane& rest,
                                       const Plane& metric, const Plane& strain) {
    const Real half = 0.5 * strain.shear;
    const Real rest_det = rest.first * rest.second - rest.shear * rest.shear;
    const Real area =
        splat(1.0) /
        ((metric.first * metric.second - metric.shear * metric.shear) * rest_det);
    const Real inverse = area * rest_det;
    const Real q = splat(1 - c.beta) + c.beta * area;
    const Real m1 = inverse * metric.second, m2 = inverse * metric.first;
    const Real m3 = splat(-1.0) * inverse * metric.shear;
    const Real a11 = m1 * strain.first + m3 * half, a12 = m1 * half + m3 * strain.second;
    const Real a21 = m3 * strain.first + m2 * half, a22 = m3 * half + m2 * strain.second;
    const Real b11 = rest.first * strain.first + rest.shear * half;
    const Real b12 = rest.first * half + rest.shear * strain.second;
    const Real b21 = rest.shear * strain.first + rest.second * half;
    const Real b22 = rest.shear * half + rest.second * strain.second;
    const Real x11 = b11 * m1 + b12 * m3, x12 = b11 * m3 + b12 * m2;
    const Real x21 = b21 * m1 + b22 * m3, x22 = b21 * m3 + b22 * m2;
    const Real n1 = a11 * m1 + a12 * m3, n2 = a21 * m3 + a22 * m2;
    const Real n3 = a11 * m3 + a12 * m2;
    const Real trace = a11 + a22;
    const Real qg = q * c.g, ql = q * c.lambda * trace;
    const Real w = c.beta * area *
                   (0.5 * c.g * (a11 * a11 + 2.0 * a12 * a21 + a22 * a22) +
                    0.5 * c.lambda * trace * trace);
    const Real half_g = 0.5 * c.g;
    return {
        {c.g * x11 + qg * n1 + ql * m1, c.g * x22 + qg * n2 + ql * m2,
         half_g * (x12 + x21) + qg * n3 + ql * m3},
        {half_g * (a11 * x11 + a12 * x21) + qg * (a11 * n1 + a12 * n3) + ql * n1 + w * m1,
         half_g * (a21 * x12 + a22 * x22) + qg * (a21 * n3 + a22 * n2) + ql * n2 + w * m2,
         half_g * (a11 * x12 + a12 * x22) + qg * (a11 * n3 + a12 * n2) + ql * n3 +
             w * m3}};
}

// Inverse metric of group k at rest. A brick's is diagonal.
template <bool brick>
MAGFSI_INLINE Plane rest_metric(const double* metric, int k) {
    if constexpr (brick) {
        const int first = k == 0 ? 1 : 0, second = k == 2 ? 1 : 2;
        return {load(metric + first * batch_lanes), load(metric + second * batch_lanes),
                Real{}};
    } else {
        const double* of_group = metric + 3 * k * batch_lanes;
        return {load(of_group), load(of_group + batch_lanes),
                load(of_group + 2 * batch_lanes)};
    }
}

// Adds the forces of hourglass_forces and those of the metric; returns a quarter of the
// energy.
template <bool brick>
MAGFSI_INLINE Real hourglass(const ElementBatches& b, const double* metric,
                             const Real& v0, const Vec (&u)[8], const Vec (&v)[3],
                             Vec (&g)[8], Vec (&w)[3]) {
    const double shear = b.shear_modulus_pa;
    const double beta = b.lame_lambda_pa / (b.lame_lambda_pa + 2 * shear);
    const PlateModuli c{v0 * (shear / 24), v0 * (2 * shear * beta / 24), beta};
    const Planes strain = hourglass_strain(u, v);
    const Vec &u1 = u[1], &u2 = u[2], &u3 = u[4];
    const Real g11 = dot(u1, u1), g22 = dot(u2, u2), g33 = dot(u3, u3);
    const Real g12 = dot(u1, u2), g13 = dot(u1, u3), g23 = dot(u2, u3);
    const PlaneForces x =
        plane_forces(c, rest_metric<brick>(metric, 0), {g22, g33, g23}, strain.x);
    const PlaneForces y =
        plane_forces(c, rest_metric<brick>(metric, 1), {g11, g33, g13}, strain.y);
    const PlaneForces z =
        plane_forces(c, rest_metric<brick>(metric, 2), {g11, g22, g12}, strain.z);
    const Planes stress{x.strain, y.strain, z.strain};
    hourglass_forces(stress, u, v, g, w);
    const Real t11 = -2.0 * (y.metric.first + z.metric.first);
    const Real t22 = -2.0 * (x.metric.first + z.metric.second);
    const Real t33 = -2.0 * (x.metric.second + y.metric.second);
    const Real t12 = -2.0 * z.metric.shear, t13 = -2.0 * y.metric.shear;
    const Real t23 = -2.0 * x.metric.shear;
    g[1] = g[1] + t11 * u1 + t12 * u2 + t13 * u3;
    g[2] = g[2] + t12 * u1 + t22 * u2 + t23 * u3;
    g[4] = g[4] + t13 * u1 + t23 * u2 + t33 * u3;
    return dot(stress, strain);
}

}  // namespace
}  // namespace magfsi::structure::MAGFSI_ISA

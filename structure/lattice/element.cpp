// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/element.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace magfsi::structure {
namespace {

using Hourglass = Eigen::Matrix<double, 8, 4>;
constexpr std::array<int, 4> hourglass_modes{3, 6, 5, 7};  // xy, yz, xz, xyz

// Hourglass vectors that vanish on linear fields: gamma = h - b (X^T h) / V0.
Hourglass hourglass_vectors(const Positions8& nodes_m, const HexahedronIntegrals& in) {
    Hourglass gamma;
    for (int k = 0; k < 4; ++k) {
        Eigen::Matrix<double, 8, 1> h;
        for (int a = 0; a < 8; ++a) h(a) = mode_sign(hourglass_modes[k], a);
        gamma.col(k) = h - in.gradient * (nodes_m.transpose() * h) / in.volume;
    }
    return gamma;
}

// Square root of the factor by which assumed_strain scales the entry of the mode xyz of
// the matrix C of full.
double xyz_scale(const Vec3& length) {
    const auto [x, y, z] = length;
    const double xy = x * x * y * y, yz = y * y * z * z, xz = x * x * z * z;
    return std::sqrt(3 * std::min({xy, yz, xz}) / (xy + yz + xz));
}

}  // namespace

Matrix8 spring_matrix(const Positions8& nodes_m, const HexahedronIntegrals& in,
                      ElementVariant variant) {
    if (variant == ElementVariant::full) return in.laplacian;
    const Matrix8 mean = in.gradient * in.gradient.transpose() / in.volume;
    const Hourglass gamma = hourglass_vectors(nodes_m, in);
    // in.laplacian - mean = Gamma C Gamma^T, solved for C.
    const Eigen::Matrix4d inverse = (gamma.transpose() * gamma).inverse();
    const Eigen::Matrix4d c =
        inverse * (gamma.transpose() * (in.laplacian - mean) * gamma) * inverse;
    const double scale = xyz_scale(element_edges(nodes_m).length_m);
    Eigen::Matrix4d kept = Eigen::Matrix4d::Zero();
    kept(3, 3) = scale * c(3, 3) * scale;
    return mean + gamma * kept * gamma.transpose();
}

// The position is x(xi) = sum_m u_m xi^m with the Hadamard modes u_m = 1/8 sum_a h_m(a)
// x_a. In the integral of det(dx/dxi) over [-1, 1]^3 the terms even in each direction
// remain: V = 8 [r1.(r2 x r3) + (r1.(s12 x s31) + r2.(s23 x s12) + r3.(s31 x s23)) / 3].
VolumeAndGradient exact_volume(const Positions8& x_m) {
    std::array<Eigen::Vector3d, 8> u;
    for (int m = 0; m < 8; ++m) {
        u[m].setZero();
        for (int a = 0; a < 8; ++a) {
            u[m] += 0.125 * mode_sign(m, a) * x_m.row(a).transpose();
        }
    }
    const auto &r1 = u[1], &r2 = u[2], &r3 = u[4], &s12 = u[3], &s23 = u[6], &s31 = u[5];
    std::array<Eigen::Vector3d, 7> d;  // dV/du_m / 8
    d[0].setZero();
    d[1] = r2.cross(r3) + s12.cross(s31) / 3;
    d[2] = r3.cross(r1) + s23.cross(s12) / 3;
    d[4] = r1.cross(r2) + s31.cross(s23) / 3;
    d[3] = (s31.cross(r1) + r2.cross(s23)) / 3;
    d[6] = (s12.cross(r2) + r3.cross(s31)) / 3;
    d[5] = (r1.cross(s12) + s23.cross(r3)) / 3;
    VolumeAndGradient out;
    out.volume_m3 =
        8 *
        (r1.dot(r2.cross(r3)) +
         (r1.dot(s12.cross(s31)) + r2.dot(s23.cross(s12)) + r3.dot(s31.cross(s23))) / 3);
    for (int a = 0; a < 8; ++a) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (int m = 1; m < 7; ++m) sum += mode_sign(m, a) * d[m];
        out.gradient_m2.row(a) = sum.transpose();
    }
    return out;
}

VolumeAndGradient mean_volume(const Positions8& x_m,
                              const Positions8& reference_gradient_m2,
                              double reference_volume_m3) {
    const Eigen::Matrix3d f =
        x_m.transpose() * reference_gradient_m2 / reference_volume_m3;
    Eigen::Matrix3d cofactor;
    cofactor.col(0) = f.col(1).cross(f.col(2));
    cofactor.col(1) = f.col(2).cross(f.col(0));
    cofactor.col(2) = f.col(0).cross(f.col(1));
    VolumeAndGradient out;
    out.volume_m3 = reference_volume_m3 * f.determinant();
    out.gradient_m2 = reference_gradient_m2 * cofactor.transpose();
    return out;
}

ElementReference element_reference(const Positions8& nodes_m, ElementVariant variant,
                                   int element_number) {
    const HexahedronIntegrals integrals = integrate_hexahedron(nodes_m, element_number);
    return {variant,
            spring_matrix(nodes_m, integrals, variant),
            integrals.gradient,
            integrals.volume,
            integrals.node_volume,
            hourglass_reference(nodes_m, integrals)};
}

VolumeAndGradient element_volume(const ElementReference& reference,
                                 const Positions8& x_m) {
    return reference.variant == ElementVariant::full
               ? exact_volume(x_m)
               : mean_volume(x_m, reference.gradient, reference.volume);
}

}  // namespace magfsi::structure

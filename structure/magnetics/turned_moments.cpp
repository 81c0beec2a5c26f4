// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/magnetics/turned_moments.h"

#include <Eigen/Dense>
#include <cmath>

#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The matrix of w x.
Matrix3d cross_matrix(const Vector3d& w) {
    Matrix3d out;
    out << 0, -w(2), w(1), w(2), 0, -w(0), -w(1), w(0), 0;
    return out;
}

// The vector of a - a^T.
Vector3d axial(const Matrix3d& a) {
    return {a(2, 1) - a(1, 2), a(0, 2) - a(2, 0), a(1, 0) - a(0, 1)};
}

// State of one element. A change dF turns it by the vector y axial(R^T dF).
struct Turned {
    Matrix3d rotation, stretch;
    Matrix3d y;              // inverse of tr U - U
    Vector3d field, couple;  // b and t
    Vector3d c;              // y t
};

Matrix3d mean_gradient_of(const TurnedElement& element, const Positions8& x_m) {
    return x_m.transpose() * element.gradient_m2 / element.volume_m3;
}

Turned turned(const TurnedElement& element, const Vector3d& field_t,
              const Positions8& x_m) {
    Turned out;
    const Matrix3d f = mean_gradient_of(element, x_m);
    out.rotation = rotation_of(f);
    const Matrix3d u = out.rotation.transpose() * f;
    out.stretch = 0.5 * (u + u.transpose());
    out.y = (out.stretch.trace() * Matrix3d::Identity() - out.stretch).inverse();
    out.field = out.rotation.transpose() * field_t;
    out.couple = element.magnetization_a_m.cross(out.field);
    out.c = out.y * out.couple;
    return out;
}

Positions8 positions_of(const std::array<int, 8>& nodes, const double* x) {
    Positions8 out;
    for (int a = 0; a < 8; ++a) {
        for (int d = 0; d < 3; ++d)
            out(a, d) = x[3L * nodes[a] + d] - x[3L * nodes[0] + d];
    }
    return out;
}

// Change of dE/dF over V0 for the change dF.
Matrix3d turned_change(const Turned& s, const Vector3d& magnetization,
                       const Matrix3d& df) {
    const Matrix3d a = s.rotation.transpose() * df;
    const Vector3d turn = s.y * axial(a);
    const Matrix3d spin = cross_matrix(turn);
    const Matrix3d du = a - spin * s.stretch;
    const Vector3d dcouple = -magnetization.cross(turn.cross(s.field));
    const Vector3d dc = s.y * (dcouple - (du.trace() * Matrix3d::Identity() - du) * s.c);
    return -s.rotation * (spin * cross_matrix(s.c) + cross_matrix(dc));
}

}  // namespace

// Newton's method for the nearest rotation, R <- (R + R^-T) / 2, which converges
// quadratically from F (Higham, SIAM J. Sci. Stat. Comput. 7 (1986) 1160).
Matrix3d rotation_of(const Matrix3d& f) {
    Matrix3d r = f / std::cbrt(f.determinant());
    for (int i = 0; i < 50; ++i) {
        const Matrix3d next = 0.5 * (r + r.inverse().transpose());
        const double change = (next - r).squaredNorm();
        r = next;
        if (!(change > 1e-24)) break;
    }
    return r;
}

std::vector<TurnedElement> turned_elements(const std::vector<Vec3>& nodes_m,
                                           const std::vector<Hexahedron>& elements,
                                           const std::vector<Vec3>& magnetization_a_m) {
    if (magnetization_a_m.size() != elements.size()) {
        refuse(
            "{} magnetisation vectors for {} elements found, one per element is needed",
            magnetization_a_m.size(), elements.size());
    }
    std::vector<TurnedElement> out;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const HexahedronIntegrals integrals =
            integrate_hexahedron(gather(nodes_m, elements[e]), static_cast<int>(e));
        out.push_back({integrals.gradient, integrals.volume,
                       Vector3d(magnetization_a_m[e].data())});
    }
    return out;
}

Vector3d turned_moment(const TurnedElement& element, const Positions8& x_m) {
    return element.volume_m3 * rotation_of(mean_gradient_of(element, x_m)) *
           element.magnetization_a_m;
}

Vector3d add_turned_forces(std::span<const TurnedElement> elements,
                           std::span<const std::array<int, 8>> nodes,
                           const Vector3d& field_t, const double* x, double* f) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const TurnedElement& element = elements[e];
        if (element.magnetization_a_m.isZero(0)) continue;
        const Turned s = turned(element, field_t, positions_of(nodes[e], x));
        sum += element.volume_m3 * s.rotation * element.magnetization_a_m;
        const Matrix3d stress = s.rotation * cross_matrix(s.c);
        for (int a = 0; a < 8; ++a) {
            const Vector3d force = stress * element.gradient_m2.row(a).transpose();
            for (int d = 0; d < 3; ++d) f[3L * nodes[e][a] + d] += force(d);
        }
    }
    return sum;
}

Eigen::Matrix<double, 24, 24> turned_tangent(const TurnedElement& element,
                                             const Vector3d& field_t,
                                             const Positions8& x_m) {
    Eigen::Matrix<double, 24, 24> out = Eigen::Matrix<double, 24, 24>::Zero();
    if (element.magnetization_a_m.isZero(0)) return out;
    const Turned s = turned(element, field_t, x_m);
    const Positions8& b = element.gradient_m2;
    for (int j = 0; j < 3; ++j) {
        for (int k = 0; k < 3; ++k) {
            Matrix3d unit = Matrix3d::Zero();
            unit(j, k) = 1;
            const Eigen::Matrix<double, 8, 3> on_nodes =
                b * turned_change(s, element.magnetization_a_m, unit).transpose() /
                element.volume_m3;
            for (int q = 0; q < 8; ++q) {
                for (int a = 0; a < 8; ++a) {
                    for (int i = 0; i < 3; ++i)
                        out(3 * a + i, 3 * q + j) += on_nodes(a, i) * b(q, k);
                }
            }
        }
    }
    return out;
}

}  // namespace magfsi::structure

// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/magnetics/magnetic_forces.h"

#include <Eigen/Dense>
#include <cmath>

#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

void check_count(std::size_t vectors, std::size_t elements) {
    if (vectors == elements) return;
    refuse("{} magnetisation vectors for {} elements found, one per element is needed",
           vectors, elements);
}

// Allowed defect of a gradient, relative to its largest entry: gradients are typed with a
// few digits, but a trace that is left acts like a source.
constexpr double allowed_defect = 1e-6;

void check(const Eigen::Matrix3d& a) {
    if (!a.allFinite()) {
        refuse(
            "a field gradient with an entry that is not finite found, all nine must be "
            "numbers");
    }
    const double allowed = allowed_defect * a.cwiseAbs().maxCoeff();
    for (int d = 0; d < 3; ++d) {
        for (int e = d + 1; e < 3; ++e) {
            if (std::abs(a(d, e) - a(e, d)) <= allowed) continue;
            refuse(
                "field gradient with dB_{0}/d{1} = {2:g} T/m and dB_{1}/d{0} = {3:g} T/m "
                "found; they must be equal, a static field outside its sources has no "
                "curl",
                "xyz"[d], "xyz"[e], a(d, e), a(e, d));
        }
    }
    if (std::abs(a.trace()) > allowed) {
        refuse(
            "field gradient with the diagonal {:g}, {:g}, {:g} T/m found; its sum must "
            "be zero, a magnetic field has no divergence",
            a(0, 0), a(1, 1), a(2, 2));
    }
}

// C_ab of moment_elements. Each factor has at most degree 3 in each direction, so that
// 2x2x2 Gauss points are exact.
Matrix8 moments_of(const Positions8& nodes_m, const Vec3& vector_a_m) {
    const Eigen::Vector3d magnetization_a_m(vector_a_m.data());
    Matrix8 half = Matrix8::Zero();
    const double q = 1 / std::sqrt(3.0);
    for (int g = 0; g < 8; ++g) {
        const Vec3 xi{q * node_sign(g, 0), q * node_sign(g, 1), q * node_sign(g, 2)};
        const Positions8 local = shape_gradients(xi);
        const Eigen::Matrix3d jacobian = nodes_m.transpose() * local;
        const auto values = shape_values(xi);
        const Eigen::Matrix<double, 8, 1> along =
            jacobian.determinant() * local * jacobian.inverse() * magnetization_a_m;
        half += along * Eigen::Map<const Eigen::Matrix<double, 1, 8>>(values.data());
    }
    return half;
}

// P_b of an element. It does not depend on the origin, as the columns of C sum to zero.
Positions8 node_moments(const Matrix8& moments, const std::array<int, 8>& nodes,
                        const double* x) {
    Positions8 now;
    for (int n = 0; n < 8; ++n) {
        for (int d = 0; d < 3; ++d)
            now(n, d) = x[3L * nodes[n] + d] - x[3L * nodes[0] + d];
    }
    return moments.transpose() * now;
}

}  // namespace

std::vector<double> nodal_charges(const std::vector<Vec3>& nodes_m,
                                  const std::vector<Hexahedron>& elements,
                                  const std::vector<Vec3>& magnetization_a_m) {
    std::vector<double> charges(nodes_m.size(), 0.0);
    if (magnetization_a_m.empty()) return charges;
    check_count(magnetization_a_m.size(), elements.size());
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const Eigen::Vector3d m(magnetization_a_m[e][0], magnetization_a_m[e][1],
                                magnetization_a_m[e][2]);
        const HexahedronIntegrals integrals =
            integrate_hexahedron(gather(nodes_m, elements[e]), static_cast<int>(e));
        for (int a = 0; a < 8; ++a) {
            charges[elements[e][a]] += integrals.gradient.row(a).dot(m);
        }
    }
    return charges;
}

FieldGradient::FieldGradient(const Eigen::Matrix3d& tesla_per_m, const Vec3& origin_m)
    : tesla_per_m_(tesla_per_m), origin_m_(origin_m) {
    check(tesla_per_m);
}

FieldGradient::FieldGradient(const GradientInput& input)
    : FieldGradient(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
                        input.matrix_t_m.front().data()),
                    input.origin_m) {}

std::vector<GradientElement> gradient_elements(
    const std::vector<Vec3>& nodes_m, const std::vector<Hexahedron>& elements,
    const std::vector<Vec3>& magnetization_a_m) {
    check_count(magnetization_a_m.size(), elements.size());
    std::vector<GradientElement> out(elements.size());
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const Matrix8 half =
            moments_of(gather(nodes_m, elements[e]), magnetization_a_m[e]);
        out[e].coupling = half + half.transpose();
    }
    return out;
}

double add_gradient_forces(std::span<const GradientElement> elements,
                           std::span<const std::array<int, 8>> nodes,
                           const FieldGradient& gradient, const double* x, double* f) {
    const Eigen::Matrix3d& a = gradient.tesla_per_m();
    const Eigen::RowVector3d origin =
        Eigen::Map<const Eigen::RowVector3d>(gradient.origin_m().data());
    double energy = 0;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        Positions8 now;
        for (int n = 0; n < 8; ++n) {
            now.row(n) =
                Eigen::Map<const Eigen::RowVector3d>(x + 3L * nodes[e][n]) - origin;
        }
        // Coupling times positions comes first: the rows of the coupling sum to the
        // charges, so that a body far from the origin loses no more digits than its net
        // force has.
        const Positions8 force = elements[e].coupling * now * a;
        energy -= 0.5 * force.cwiseProduct(now).sum();
        for (int n = 0; n < 8; ++n) {
            Eigen::Map<Eigen::RowVector3d>(f + 3L * nodes[e][n]) += force.row(n);
        }
    }
    return energy;
}

std::vector<Matrix8> moment_elements(const std::vector<Vec3>& nodes_m,
                                     const std::vector<Hexahedron>& elements,
                                     const std::vector<Vec3>& magnetization_a_m) {
    check_count(magnetization_a_m.size(), elements.size());
    std::vector<Matrix8> out;
    for (std::size_t e = 0; e < elements.size(); ++e)
        out.push_back(moments_of(gather(nodes_m, elements[e]), magnetization_a_m[e]));
    return out;
}

double add_source_forces(std::span<const Matrix8> moments,
                         std::span<const std::array<int, 8>> nodes,
                         std::span<const FieldSample> samples, const double* x,
                         double* f) {
    double energy = 0;
    for (std::size_t e = 0; e < moments.size(); ++e) {
        const Positions8 moment = node_moments(moments[e], nodes[e], x);
        Positions8 field, force;
        for (int n = 0; n < 8; ++n) {
            const FieldSample& at = samples[nodes[e][n]];
            field.row(n) = at.field_t.transpose();
            force.row(n) = moment.row(n) * at.gradient_t_m;
        }
        energy -= moment.cwiseProduct(field).sum();
        force += moments[e] * field;
        for (int n = 0; n < 8; ++n) {
            Eigen::Map<Eigen::RowVector3d>(f + 3L * nodes[e][n]) += force.row(n);
        }
    }
    return energy;
}

Eigen::Matrix<double, 24, 24> source_tangent(const Matrix8& moments,
                                             const std::array<int, 8>& nodes,
                                             std::span<const FieldSample> samples,
                                             const SourceField& field, const double* x) {
    const Positions8 moment = node_moments(moments, nodes, x);
    const auto gradient = [&](int n) -> const Eigen::Matrix3d& {
        return samples[nodes[n]].gradient_t_m;
    };
    Eigen::Matrix<double, 24, 24> out;
    for (int a = 0; a < 8; ++a) {
        for (int b = 0; b < 8; ++b)
            out.block<3, 3>(3 * a, 3 * b) =
                -moments(a, b) * gradient(b) - moments(b, a) * gradient(a).transpose();
        const double* at = x + 3L * nodes[a];
        out.block<3, 3>(3 * a, 3 * a) -=
            field.gradient_along({at[0], at[1], at[2]}, moment.row(a).transpose());
    }
    return out;
}

}  // namespace magfsi::structure

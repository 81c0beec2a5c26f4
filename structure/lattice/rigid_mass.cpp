// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/rigid_mass.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "structure/eigen_vector.h"
#include "structure/lattice/hexahedron.h"
#include "structure/lattice/inertia.h"

namespace magfsi::structure {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Sums over points: mass, first and second moments about an origin near the body.
struct PointSums {
    double mass = 0;
    Vector3d first = Vector3d::Zero();
    Matrix3d second = Matrix3d::Zero();

    void add(double m, const Vector3d& x) {
        mass += m;
        first += m * x;
        second += m * x * x.transpose();
    }
    // Inertia about the centre of mass.
    Matrix3d inertia() const {
        const Matrix3d central = second - first * first.transpose() / mass;
        return central.trace() * Matrix3d::Identity() - central;
    }
};

// An origin among the nodes of the part, so that sums lose no digits far from (0, 0, 0).
Vec3 origin_of(const Body& body, int part, std::span<const Vec3> nodes_m) {
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e)
        if (body.element_rigid[e] == part) return nodes_m[body.mesh.elements[e][0]];
    return {};
}

// Adds the solid of an element by Gauss points.
void add_solid(PointSums& sums, const Positions8& nodes, double density_kg_m3) {
    const double far = std::sqrt(0.6);
    const std::array<double, 3> place{-far, 0, far}, weight{5.0 / 9, 8.0 / 9, 5.0 / 9};
    for (int g = 0; g < 27; ++g) {
        const int i = g % 3, j = g / 3 % 3, k = g / 9;
        const Vec3 xi{place[i], place[j], place[k]};
        const auto values = shape_values(xi);
        Vector3d x = Vector3d::Zero();
        for (int a = 0; a < 8; ++a) x += values[a] * nodes.row(a).transpose();
        const double jacobian = (nodes.transpose() * shape_gradients(xi)).determinant();
        sums.add(density_kg_m3 * weight[i] * weight[j] * weight[k] * jacobian, x);
    }
}

Positions8 near_origin(std::span<const Vec3> nodes_m, const Hexahedron& element,
                       const Vec3& origin) {
    Positions8 x = gather(nodes_m, element);
    x.rowwise() -= as_eigen(origin).transpose();
    return x;
}

PointSums solid_of(const Body& body, int part, std::span<const Vec3> nodes_m,
                   const Vec3& origin) {
    PointSums sums;
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        if (body.element_rigid[e] != part) continue;
        add_solid(sums, near_origin(nodes_m, body.mesh.elements[e], origin),
                  material_of(body, e).density_kg_m3);
    }
    return sums;
}

}  // namespace

RigidMass rigid_mass(const Body& body, int part, std::span<const Vec3> nodes_m) {
    const Vec3 origin = origin_of(body, part, nodes_m);
    PointSums sums = solid_of(body, part, nodes_m, origin);
    const auto part_of_node = rigid_part_of_nodes(body);
    const auto masses_kg = element_masses_kg(body);
    for (std::size_t e = 0; e < masses_kg.size(); ++e) {
        if (!is_soft(body, e)) continue;
        for (std::size_t a = 0; a < 8; ++a) {
            const int node = body.mesh.elements[e][a];
            if (part_of_node[node] == part)
                sums.add(masses_kg[e][a], as_eigen(nodes_m[node] - origin));
        }
    }
    const Vec3 centre = origin + as_vec3(sums.first / sums.mass);
    return {sums.mass, centre, sums.inertia()};
}

Matrix3d inertia_beyond_nodes_kg_m2(const Body& body, int part,
                                    std::span<const Vec3> nodes_m) {
    const Vec3 origin = origin_of(body, part, nodes_m);
    PointSums lumped;
    const auto masses_kg = element_masses_kg(body);
    for (std::size_t e = 0; e < masses_kg.size(); ++e) {
        if (body.element_rigid[e] != part) continue;
        for (std::size_t a = 0; a < 8; ++a)
            lumped.add(masses_kg[e][a],
                       as_eigen(nodes_m[body.mesh.elements[e][a]] - origin));
    }
    return solid_of(body, part, nodes_m, origin).inertia() - lumped.inertia();
}

double rate_on_part(const Body& body, int part, const std::vector<double>& of_node) {
    using Matrix6 = Eigen::Matrix<double, 6, 6>;
    const std::span<const Vec3> nodes_m(body.mesh.nodes);
    const RigidMass mass = rigid_mass(body, part, nodes_m);
    const auto part_of_node = rigid_part_of_nodes(body);
    Matrix6 springs = Matrix6::Zero(), masses = Matrix6::Zero();
    masses.topLeftCorner<3, 3>() = mass.mass_kg * Matrix3d::Identity();
    masses.bottomRightCorner<3, 3>() = mass.inertia_kg_m2;
    for (std::size_t n = 0; n < nodes_m.size(); ++n) {
        if (part_of_node[n] != part) continue;
        const Vector3d arm = as_eigen(nodes_m[n] - mass.centre_m);
        Eigen::Matrix<double, 3, 6> motion;  // velocity of the node: v + w x arm
        motion << Matrix3d::Identity(), Matrix3d::Zero();
        motion.rightCols<3>() << 0, arm[2], -arm[1], -arm[2], 0, arm[0], arm[1], -arm[0],
            0;
        springs += of_node[n] * motion.transpose() * motion;
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6> solver(
        springs, masses, Eigen::EigenvaluesOnly);
    return solver.eigenvalues()(5);
}

Vec3 moment_of_part_a_m2(const Body& body, int part) {
    Vec3 sum{};
    for (std::size_t e = 0; e < body.magnetization_a_m.size(); ++e) {
        if (body.element_rigid[e] != part) continue;
        const Positions8 x = gather(body.mesh.nodes, body.mesh.elements[e]);
        sum += integrate_hexahedron(x, static_cast<int>(e)).volume *
               body.magnetization_a_m[e];
    }
    return sum;
}

}  // namespace magfsi::structure

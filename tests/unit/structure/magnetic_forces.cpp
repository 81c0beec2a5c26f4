// SPDX-License-Identifier: GPL-2.0-or-later
// Forces of uniform fields (Figs. 1b and 2) and of field gradients.
#include "structure/magnetics/magnetic_forces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "structure/magnetics/magnetization.h"
#include "structure/mesh/body_points.h"
#include "tests/support/checks.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

double largest(const std::vector<double>& values) {
    double out = 0;
    for (double value : values) out = std::max(out, std::abs(value));
    return out;
}

TEST(MagneticForces, SumToZeroOnADistortedBody) {
    const Mesh mesh = test::distorted_block({{1e-3, 6e-4, 3e-4}, {10, 6, 3}}, 8e-6, 16);
    const auto m = harmonic_magnetization(mesh, {62e3, 1e-3, 0.7, 0, 2});
    const auto q = nodal_charges(mesh.nodes, mesh.elements, m);
    double sum = 0;
    for (double charge : q) sum += charge;
    EXPECT_LT(std::abs(sum), 1e-13 * largest(q));  // rounding of 300 terms
}

TEST(MagneticForces, VanishInsideAUniformlyMagnetisedBox) {  // Fig. 1b
    const Box box{{5e-4, 4e-4, 3e-4}, {5, 4, 3}};
    const Mesh mesh = box_mesh(box);
    const Vec3 m{143e3, 0, 0};
    const auto q =
        nodal_charges(mesh.nodes, mesh.elements, uniform_magnetization(mesh, m));
    double left = 0;
    double right = 0;
    for (std::size_t a = 0; a < q.size(); ++a) {
        const double x = mesh.nodes[a][0];
        if (x > 1e-6 && x < 4.99e-4) {
            EXPECT_LT(std::abs(q[a]), 1e-13 * largest(q));  // rounding
        }
        (x < 2.5e-4 ? left : right) += q[a];
    }
    // The end faces carry -M A and M A.
    EXPECT_NEAR(left, -143e3 * 4e-4 * 3e-4, 1e-13);
    EXPECT_NEAR(right, 143e3 * 4e-4 * 3e-4, 1e-13);
}

TEST(MagneticForces, DipoleIsMagnetizationTimesVolume) {
    const Mesh mesh = test::distorted_block({{1e-3, 6e-4, 3e-4}, {5, 3, 3}}, 8e-6, 17);
    const Vec3 m{1e4, -2e4, 3e4};
    const auto q =
        nodal_charges(mesh.nodes, mesh.elements, uniform_magnetization(mesh, m));
    for (int d = 0; d < 3; ++d) {
        double dipole = 0;
        for (std::size_t a = 0; a < q.size(); ++a) dipole += q[a] * mesh.nodes[a][d];
        EXPECT_NEAR(dipole / (m[d] * volume_m3(mesh)), 1,
                    1e-12);  // charges of both signs cancel
    }
}

TEST(MagneticForces, RefuseAMagnetisationOfAnotherMesh) {
    const Mesh mesh = box_mesh({{1, 1, 1}, {2, 1, 1}});
    EXPECT_THROW(nodal_charges(mesh.nodes, mesh.elements, {Vec3{1, 0, 0}}),
                 std::invalid_argument);
}

// Fig. 2: a plate of oblique domains. In a uniform field, forces act on domain borders
// and on the plate's outline, and nowhere else.
constexpr int cells = 4;
constexpr double magnetization_a_m = 81e3;
constexpr double angle_rad = std::numbers::pi / 3;

ObliquePlate plate(const std::array<int, 3>& elements_per_cell) {
    ObliquePlate out;
    out.cells = {cells, cells};
    out.length_a_m = out.length_b_m = 10e-3;
    out.angle_rad = angle_rad;
    out.thickness_m = 1e-3;
    out.elements_per_cell = elements_per_cell;
    return out;
}

// Across the oblique sides of each cell, in turn to the right and to the left.
std::vector<Vec3> origami(const Mesh& mesh) {
    std::map<std::string, Vec3> vectors;
    for (int row = 0; row < cells; ++row) {
        for (int column = 0; column < cells; ++column) {
            const double sense = column % 2 == 0 ? 1 : -1;
            const double lean = row % 2 == 0 ? 1 : -1;
            vectors["row " + std::to_string(row) + " column " + std::to_string(column)] =
                {sense * magnetization_a_m * std::sin(angle_rad),
                 -sense * lean * magnetization_a_m * std::cos(angle_rad), 0};
        }
    }
    return region_magnetization(mesh, vectors);
}

// Nodes that only elements of one region share, and not on the outline.
std::vector<bool> inside_a_cell(const Mesh& mesh) {
    std::vector<int> region(mesh.nodes.size(), -1);
    std::vector<bool> inside(mesh.nodes.size(), true);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        for (int node : mesh.elements[e]) {
            const auto n = static_cast<std::size_t>(node);
            if (region[n] >= 0 && region[n] != mesh.region[e]) inside[n] = false;
            region[n] = mesh.region[e];
        }
    }
    for (const char* name : {"x_min", "x_max", "y_min", "y_max"}) {
        for (int node : mesh.faces.at(name))
            inside[static_cast<std::size_t>(node)] = false;
    }
    return inside;
}

TEST(OrigamiCharges, VanishInsideTheCells) {
    for (const auto& elements : {std::array{4, 4, 1}, std::array{6, 5, 2}}) {
        const Mesh mesh = oblique_mesh(plate(elements));
        const auto charge = nodal_charges(mesh.nodes, mesh.elements, origami(mesh));
        const auto inside = inside_a_cell(mesh);
        double largest = 0, largest_inside = 0, sum = 0;
        int count = 0;
        for (std::size_t n = 0; n < charge.size(); ++n) {
            largest = std::max(largest, std::abs(charge[n]));
            sum += charge[n];
            if (!inside[n]) continue;
            ++count;
            largest_inside = std::max(largest_inside, std::abs(charge[n]));
        }
        EXPECT_EQ(count, cells * cells * (elements[0] - 1) * (elements[1] - 1) *
                             (elements[2] + 1));
        // Rounding: up to eight terms, each as large as the largest.
        EXPECT_LT(largest_inside, 1e-14 * largest);
        EXPECT_LT(std::abs(sum), 1e-12 * largest);  // thousands of terms
    }
}

TEST(OrigamiCharges, AnObliqueBorderCarriesTwiceTheMagnetizationTimesItsArea) {
    const std::array elements{4, 4, 1};
    const Mesh mesh = oblique_mesh(plate(elements));
    const auto charge = nodal_charges(mesh.nodes, mesh.elements, origami(mesh));
    // Nodes strictly within the side between columns 0 and 1 of row 0, on both faces:
    // three quarters of its area. M is across the side, towards it from both cells.
    double sum = 0;
    for (std::size_t n = 0; n < charge.size(); ++n) {
        const auto& [x, y, z] = mesh.nodes[n];
        const double from_side = x - 10e-3 - y / std::tan(angle_rad);
        const bool within = y > 1e-6 && y < 10e-3 * std::sin(angle_rad) - 1e-6;
        if (within && std::abs(from_side) < 1e-9) sum += charge[n];
    }
    const double area_m2 = 0.75 * 10e-3 * 1e-3;
    EXPECT_NEAR(sum / (2 * magnetization_a_m * area_m2), 1, 1e-12);  // rounding
}

const Vec3 magnetization{2e4, -3e4, 5e4};
const Vec3 field{4e-3, 1e-3, -7e-3};

FieldGradient some_gradient() {
    Eigen::Matrix3d a;
    a << 0.4, 0.3, -0.2, 0.3, -0.9, 0.15, -0.2, 0.15, 0.5;
    return {a, {1e-3, -2e-3, 5e-4}};
}

struct Magnet {
    Mesh mesh = test::distorted_block({{1e-3, 6e-4, 3e-4}, {4, 3, 2}}, 8e-6, 21);
    std::vector<double> charge = nodal_charges(
        mesh.nodes, mesh.elements, uniform_magnetization(mesh, magnetization));
    std::vector<GradientElement> coupling = gradient_elements(
        mesh.nodes, mesh.elements, uniform_magnetization(mesh, magnetization));

    // Uniform part and gradient together; returns the energy.
    double add_forces(const std::vector<double>& x, std::vector<double>& f) const {
        f.assign(x.size(), 0.0);
        double energy = add_gradient_forces(coupling, mesh.elements, some_gradient(),
                                            x.data(), f.data());
        for (std::size_t q = 0; q < x.size(); ++q) {
            f[q] += charge[q / 3] * field[q % 3];
            energy -= charge[q / 3] * field[q % 3] * x[q];
        }
        return energy;
    }
    std::vector<double> turned(const Eigen::Matrix3d& r,
                               const Eigen::Vector3d& shift) const {
        std::vector<double> x;
        for (const Vec3& node : mesh.nodes) {
            const Eigen::Vector3d p =
                r * Eigen::Vector3d(node[0], node[1], node[2]) + shift;
            x.insert(x.end(), p.data(), p.data() + 3);
        }
        return x;
    }
};

Eigen::Vector3d vector_at(const std::vector<double>& values, std::size_t node) {
    return Eigen::Map<const Eigen::Vector3d>(&values[3 * node]);
}

TEST(FieldGradient, ForceIsMinusTheEnergyGradient) {
    const Magnet magnet;
    test::Random random(22);
    auto x = magnet.turned(random.rotation(), {2e-3, 1e-3, -1e-3});
    for (double& coordinate : x) coordinate += 2e-5 * random.uniform();
    std::vector<double> force, ignored;
    magnet.add_forces(x, force);
    double scale = 0;
    for (double f : force) scale = std::max(scale, std::abs(f));
    // The energy is quadratic, so a central difference with a step of the element's size
    // has rounding only: 1e-16 E / (h F), E / F being the distance to the origin of 3 mm.
    const double h = 1e-4;
    for (std::size_t q = 0; q < x.size(); ++q) {
        const double at = x[q];
        x[q] = at + h;
        const double above = magnet.add_forces(x, ignored);
        x[q] = at - h;
        const double below = magnet.add_forces(x, ignored);
        x[q] = at;
        EXPECT_NEAR(force[q], -(above - below) / (2 * h), 1e-11 * scale);
    }
}

// Net force grad (m . B) = A m and torque m x B(centre) + sum over the body of r x A M
// dV, whose last part is exact here from moments of the undeformed body.
TEST(FieldGradient, RigidMagnetFeelsTheForceAndTorqueOfADipole) {
    const Magnet magnet;
    test::Random random(23);
    const Eigen::Matrix3d r = random.rotation();
    const auto x = magnet.turned(r, {2e-3, 1e-3, -1e-3});
    std::vector<double> force;
    magnet.add_forces(x, force);
    const Eigen::Vector3d moment =
        volume_m3(magnet.mesh) *
        (r * Eigen::Vector3d(magnetization[0], magnetization[1], magnetization[2]));
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const Hexahedron& element : magnet.mesh.elements) {
        const auto in = integrate_hexahedron(gather(magnet.mesh.nodes, element), 0);
        for (int a = 0; a < 8; ++a) {
            centre +=
                in.node_volume[a] * vector_at(x, element[a]) / volume_m3(magnet.mesh);
        }
    }
    const FieldGradient gradient = some_gradient();
    const Eigen::Matrix3d& a = gradient.tesla_per_m();
    const Eigen::Vector3d origin =
        Eigen::Map<const Eigen::Vector3d>(gradient.origin_m().data());
    const Eigen::Vector3d b =
        Eigen::Map<const Eigen::Vector3d>(field.data()) + a * (centre - origin);
    Eigen::Vector3d net = Eigen::Vector3d::Zero();
    Eigen::Vector3d torque = Eigen::Vector3d::Zero();
    for (std::size_t n = 0; n < magnet.mesh.nodes.size(); ++n) {
        net += vector_at(force, n);
        torque += (vector_at(x, n) - centre).cross(vector_at(force, n));
    }
    // About the centroid of volume the body's first moment vanishes, so the torque is
    // that of the dipole alone. Rounding of 60 nodes whose charges cancel.
    const Eigen::Vector3d expected_force = a * moment;
    const Eigen::Vector3d expected_torque = moment.cross(b);
    EXPECT_LT((net - expected_force).norm(), 1e-11 * expected_force.norm());
    EXPECT_LT((torque - expected_torque).norm(), 1e-11 * expected_torque.norm());
}

TEST(FieldGradient, CouplingRowsSumToTheCharges) {
    const Magnet magnet;
    std::vector<double> sum(magnet.mesh.nodes.size(), 0.0);
    for (std::size_t e = 0; e < magnet.coupling.size(); ++e) {
        for (int a = 0; a < 8; ++a) {
            sum[magnet.mesh.elements[e][a]] += magnet.coupling[e].coupling.row(a).sum();
        }
    }
    // Rounding against the charge of one element's face.
    for (std::size_t n = 0; n < sum.size(); ++n) {
        EXPECT_NEAR(sum[n], magnet.charge[n], 1e-13 * 5e4 * 4e-8);
    }
}

std::string refusal(const Eigen::Matrix3d& a) {
    return test::message_of<std::invalid_argument>([&] { FieldGradient(a, {}); });
}

TEST(FieldGradient, RefusesFieldsThatMaxwellForbids) {
    Eigen::Matrix3d a = Eigen::Vector3d(1, 1, -2).asDiagonal();
    EXPECT_EQ(refusal(a), "");
    a(0, 1) = 0.5;
    test::expect_says(refusal(a), {"dB_x/dy = 0.5 T/m and dB_y/dx = 0 T/m"});
    a(0, 1) = 0;
    a(2, 2) = -1;
    test::expect_says(refusal(a), {"diagonal 1, 1, -1 T/m"});
    a(2, 2) = std::nan("");
    test::expect_says(refusal(a), {"not finite"});
}

}  // namespace
}  // namespace magfsi::structure

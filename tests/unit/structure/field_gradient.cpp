#include "structure/magnetics/magnetic_forces.h"

#include <gtest/gtest.h>

#include "structure/magnetics/magnetization.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

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
    double volume() const {
        double sum = 0;
        for (const Hexahedron& element : mesh.elements) {
            sum += integrate_hexahedron(gather(mesh.nodes, element), 0).volume;
        }
        return sum;
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
        magnet.volume() *
        (r * Eigen::Vector3d(magnetization[0], magnetization[1], magnetization[2]));
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const Hexahedron& element : magnet.mesh.elements) {
        const auto in = integrate_hexahedron(gather(magnet.mesh.nodes, element), 0);
        for (int a = 0; a < 8; ++a) {
            centre += in.node_volume[a] * vector_at(x, element[a]) / magnet.volume();
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
    try {
        FieldGradient(a, {});
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

TEST(FieldGradient, RefusesFieldsThatMaxwellForbids) {
    Eigen::Matrix3d a = Eigen::Vector3d(1, 1, -2).asDiagonal();
    EXPECT_EQ(refusal(a), "accepted");
    a(0, 1) = 0.5;
    EXPECT_NE(refusal(a).find("dB_x/dy = 0.5 T/m and dB_y/dx = 0 T/m"),
              std::string::npos);
    a(0, 1) = 0;
    a(2, 2) = -1;
    EXPECT_NE(refusal(a).find("diagonal 1, 1, -1 T/m"), std::string::npos);
    a(2, 2) = std::nan("");
    EXPECT_NE(refusal(a).find("not finite"), std::string::npos);
}

}  // namespace
}  // namespace magfsi::structure

// SPDX-License-Identifier: GPL-2.0-or-later
// One element: what its shape functions, springs, volume and hourglass energy must
// fulfil.
#include "structure/lattice/element.h"
#include "structure/lattice/tangent.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <fstream>
#include <sstream>

#include "structure/lattice/plain_element.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

// Sums of eight terms of order one: a few times the unit roundoff.
constexpr double roundoff = 1e-14;

TEST(PartitionOfUnity, ShapeFunctionsSumToOneAndGradientsToZero) {
    test::Random random(1);
    for (int trial = 0; trial < 50; ++trial) {
        const Vec3 xi{random.uniform(), random.uniform(), random.uniform()};
        double sum = 0;
        for (double value : shape_values(xi)) sum += value;
        EXPECT_NEAR(sum, 1, roundoff);
        EXPECT_LT(shape_gradients(xi).colwise().sum().norm(), roundoff);
    }
}

TEST(PartitionOfUnity, IntegralsOfADistortedElementSumToItsVolume) {
    test::Random random(2);
    for (int trial = 0; trial < 50; ++trial) {
        const Positions8 x = test::distorted_element(random);
        const HexahedronIntegrals in = integrate_hexahedron(x, 0);
        double sum = 0;
        for (double volume : in.node_volume) sum += volume;
        EXPECT_NEAR(sum / in.volume, 1, roundoff);
        EXPECT_LT(in.gradient.colwise().sum().norm(), roundoff * in.gradient.norm());
        EXPECT_LT(in.laplacian.rowwise().sum().norm(), roundoff * in.laplacian.norm());
        // sum_a x_a b_a^T = V0 times the identity: linear functions have exact gradients.
        const Eigen::Matrix3d identity = x.transpose() * in.gradient / in.volume;
        EXPECT_LT((identity - Eigen::Matrix3d::Identity()).norm(), 10 * roundoff);
    }
}

Eigen::Matrix3d some_deformation() {
    Eigen::Matrix3d f;
    f << 1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05;
    return f;
}

TEST(LinearFields, SpringMatrixTurnsPositionsIntoGradientIntegrals) {
    test::Random random(3);
    for (ElementVariant variant : test::all_variants) {
        for (int trial = 0; trial < 20; ++trial) {
            const Positions8 x = test::distorted_element(random);
            const HexahedronIntegrals in = integrate_hexahedron(x, 0);
            const Positions8 product = spring_matrix(x, in, variant) * x;
            // Rounding, times the condition of the 4x4 system behind assumed_strain.
            EXPECT_LT((product - in.gradient).norm(), 1e-12 * in.gradient.norm());
        }
    }
}

TEST(LinearFields, PairSpringsGiveTheEnergyOfTheHomogeneousState) {
    test::Random random(4);
    const Eigen::Matrix3d f = some_deformation();
    for (ElementVariant variant : test::all_variants) {
        const Positions8 reference = test::distorted_element(random);
        const HexahedronIntegrals in = integrate_hexahedron(reference, 0);
        const Matrix8 springs = -spring_matrix(reference, in, variant);
        const Positions8 x = reference * f.transpose();
        double energy = 0;
        for (int a = 0; a < 8; ++a) {
            for (int b = a + 1; b < 8; ++b) {
                energy += 0.5 * springs(a, b) * (x.row(a) - x.row(b)).squaredNorm();
            }
        }
        const double expected = 0.5 * in.volume * f.squaredNorm();
        EXPECT_NEAR(energy / expected, 1, 1e-12);  // rounding of 28 terms of both signs
    }
}

TEST(LinearFields, InnerNodesOfADistortedPatchFeelNoForce) {
    const Mesh mesh = test::distorted_block({{6e-4, 6e-4, 3e-4}, {3, 3, 3}}, 8e-6, 5);
    const Eigen::Matrix3d f = some_deformation();
    const Material material = test::soft_material();
    for (ElementVariant variant : test::all_variants) {
        std::vector<Eigen::Vector3d> force(mesh.nodes.size(), Eigen::Vector3d::Zero());
        double largest = 0;
        for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
            const Positions8 reference = gather(mesh.nodes, mesh.elements[e]);
            const ElementState state =
                element_energy(element_reference(reference, variant, 0), material,
                               reference * f.transpose());
            largest = std::max(largest, state.force_n.cwiseAbs().maxCoeff());
            for (int a = 0; a < 8; ++a) {
                force[mesh.elements[e][a]] += state.force_n.row(a).transpose();
            }
        }
        for (int k = 1; k < 3; ++k) {
            for (int j = 1; j < 3; ++j) {
                for (int i = 1; i < 3; ++i) {
                    // Eight element forces cancel: rounding against the largest of them.
                    EXPECT_LT(force[i + 4 * (j + 4 * k)].norm(), 1e-12 * largest);
                }
            }
        }
    }
}

TEST(Force, IsMinusTheEnergyGradientInRandomStatesOfDistortedElements) {
    const Material material = test::soft_material();
    const double h = 1e-9;  // of 1e-4: truncation (h/l)^2 = 1e-10, rounding about 1e-9
    const double tolerance = 1e-7;  // both, times the stiffening in the most bent states
    test::Random random(7);
    for (ElementVariant variant : test::all_variants) {
        for (int trial = 0; trial < 10; ++trial) {
            const Positions8 reference_x = test::distorted_element(random);
            const ElementReference reference = element_reference(reference_x, variant, 0);
            const Positions8 x =
                random.moved(reference_x * random.rotation().transpose(), 1.5e-5);
            const ElementState state = element_energy(reference, material, x);
            ASSERT_GT(state.volume_ratio, 0);
            for (int q = 0; q < 24; ++q) {
                Positions8 plus = x;
                Positions8 minus = x;
                plus(q / 3, q % 3) += h;
                minus(q / 3, q % 3) -= h;
                const double slope =
                    (element_energy(reference, material, plus).energy_j -
                     element_energy(reference, material, minus).energy_j) /
                    (2 * h);
                EXPECT_NEAR(state.force_n(q / 3, q % 3), -slope,
                            tolerance * state.force_n.norm());
            }
        }
    }
}

// Force of eq. (2)'s springs at rest, which the volume term balances: the scale of
// rounding.
double force_scale(const ElementReference& reference, const Material& material) {
    return material.shear_modulus_pa * reference.gradient.norm();
}
double energy_scale(const ElementReference& reference, const Material& material) {
    return material.shear_modulus_pa * reference.volume;
}

TEST(Rest, HasNoForceAndNoEnergy) {
    const Material material = test::soft_material();
    test::Random random(8);
    for (ElementVariant variant : test::all_variants) {
        const Positions8 x = test::distorted_element(random);
        const ElementReference reference = element_reference(x, variant, 0);
        const ElementState state = element_energy(reference, material, x);
        // ln J of a J that rounds to 1 + 1e-15, times K/G = 20.
        EXPECT_LT(state.force_n.norm(), 1e-12 * force_scale(reference, material));
        EXPECT_LT(std::abs(state.energy_j), 1e-12 * energy_scale(reference, material));
    }
}

TEST(Rotation, ChangesNoEnergyAndTurnsTheForces) {
    const Material material = test::soft_material();
    test::Random random(9);
    for (ElementVariant variant : test::all_variants) {
        for (int trial = 0; trial < 20; ++trial) {
            const Positions8 x0 = test::distorted_element(random);
            const ElementReference reference = element_reference(x0, variant, 0);
            const Positions8 x = random.moved(x0, 1.5e-5);
            const Eigen::Matrix3d r = random.rotation();
            const Eigen::RowVector3d shift(1e-3, -2e-3, 3e-3);
            const Positions8 turned = (x * r.transpose()).rowwise() + shift;
            const ElementState a = element_energy(reference, material, x);
            const ElementState b = element_energy(reference, material, turned);
            // The shift of 3e-3 m costs 1e-16 * 3e-3 / 1e-4 in relative positions, K/G =
            // 20 times that in forces.
            EXPECT_NEAR(a.energy_j, b.energy_j,
                        1e-12 * energy_scale(reference, material));
            EXPECT_LT((a.force_n * r.transpose() - b.force_n).norm(),
                      1e-12 * force_scale(reference, material));
        }
    }
}

TEST(Element, ExertsNoNetForceAndNoNetTorque) {
    const Material material = test::soft_material();
    test::Random random(10);
    for (ElementVariant variant : test::all_variants) {
        for (int trial = 0; trial < 20; ++trial) {
            const Positions8 x0 = test::distorted_element(random);
            const Positions8 x = random.moved(x0, 1.5e-5);
            const ElementState state =
                element_energy(element_reference(x0, variant, 0), material, x);
            Eigen::Vector3d torque = Eigen::Vector3d::Zero();
            for (int a = 0; a < 8; ++a) {
                torque += x.row(a).transpose().cross(
                    Eigen::Vector3d(state.force_n.row(a).transpose()));
            }
            // Sums of eight forces: rounding.
            EXPECT_LT(state.force_n.colwise().sum().norm(), 1e-13 * state.force_n.norm());
            EXPECT_LT(torque.norm(), 1e-13 * state.force_n.norm() * x.norm());
        }
    }
}

// One element in the homogeneous states of homogeneous_states.csv, whose header derives
// them from eq. (1): nodal forces must add up to the nominal stress times the area,
// energies to U V0.
struct State {
    std::string name;
    double parameter, lateral, j, nominal, energy;
};

std::vector<State> read_states() {
    std::ifstream file(MAGFSI_HOMOGENEOUS_STATES);
    std::vector<State> out;
    std::string line;
    while (std::getline(file, line)) {
        if (line.empty() || line[0] == '#' || line.starts_with("case")) continue;
        std::istringstream fields(line);
        std::vector<std::string> cell;
        for (std::string word; std::getline(fields, word, ',');) cell.push_back(word);
        out.push_back({cell.at(0), std::stod(cell.at(1)),
                       cell.at(2).empty() ? 0.0 : std::stod(cell.at(2)),
                       std::stod(cell.at(3)), std::stod(cell.at(4)),
                       std::stod(cell.at(6))});
    }
    return out;
}

// ln J = -(s^2 - 1) / (K/G) on a free lateral face; one Newton solve sharpens the table's
// nine digits to the last one.
double sharpen(double stretch, double other, int free_directions) {
    for (int i = 0; i < 5; ++i) {
        const double f = stretch * stretch - 1 +
                         20 * std::log(other * std::pow(stretch, free_directions));
        stretch -= f / (2 * stretch + 20 * free_directions / stretch);
    }
    return stretch;
}

Eigen::Matrix3d deformation(const State& state) {
    Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
    const double p = state.parameter;
    if (state.name == "uniaxial") {
        const double s = sharpen(state.lateral, p, 2);
        f.diagonal() << p, s, s;
    } else if (state.name == "simple_shear") {
        f(0, 1) = p;
    } else if (state.name == "hydrostatic") {
        f.diagonal().setConstant(std::cbrt(p));
    } else if (state.name == "uniaxial_strain") {
        f(0, 0) = p;
    } else {
        f.diagonal() << p, sharpen(state.lateral, p, 1), 1;
    }
    return f;
}

TEST(HomogeneousStates, StressAndEnergyAreThoseOfEquationOne) {
    const Material material = test::soft_material();
    const double g = material.shear_modulus_pa;
    const auto states = read_states();
    ASSERT_GE(states.size(), 20U);
    test::Random random(11);
    const Positions8 x0 = test::distorted_element(random);
    for (ElementVariant variant : test::all_variants) {
        const ElementReference reference = element_reference(x0, variant, 0);
        for (const State& state : states) {
            const Eigen::Matrix3d f = deformation(state);
            const ElementState found =
                element_energy(reference, material, x0 * f.transpose());
            // f_a = -P b_a and sum_a b_a X_a^T = V0 I, so P = -sum f_a X_a^T / V0.
            const Eigen::Matrix3d p =
                -(found.force_n.transpose() * x0) / reference.volume / g;
            const double nominal = state.name == "simple_shear" ? p(0, 1) : p(0, 0);
            // The closed form at this F, to 1e-10; the table, to its own nine digits.
            const double log_j = std::log(f.determinant());
            const Eigen::Matrix3d exact = f + (20 * log_j - 1) * f.inverse().transpose();
            const double energy =
                0.5 * (f.squaredNorm() - 3) - log_j + 10 * log_j * log_j;
            EXPECT_LT((p - exact).norm(), 1e-10) << state.name << ' ' << state.parameter;
            EXPECT_NEAR(found.energy_j / reference.volume / g, energy, 1e-10)
                << state.name;
            EXPECT_NEAR(nominal, state.nominal, 2e-8 * (1 + std::abs(state.nominal)))
                << state.name << ' ' << state.parameter;
            EXPECT_NEAR(energy, state.energy, 2e-8 * (1 + state.energy)) << state.name;
            // Nine digits of a number above one: off by up to 5e-9.
            EXPECT_NEAR(found.volume_ratio, state.j, 5.1e-9) << state.name;
        }
    }
}

// A free element has six motions that cost nothing, the rigid ones, and no other: no
// hourglass mode is left without stiffness.
void expect_six_rigid_motions(const Positions8& x, ElementVariant variant) {
    const Material material = test::soft_material();
    const Matrix24 k = element_tangent(element_reference(x, variant, 0), material, x);
    const Eigen::SelfAdjointEigenSolver<Matrix24> solver(k, Eigen::EigenvaluesOnly);
    const auto& values = solver.eigenvalues();
    for (int i = 0; i < 6; ++i) {
        EXPECT_LT(std::abs(values(i)), 1e-13 * values(23));  // rounding
    }
    // The softest hourglass mode costs about G h, h the shortest edge, less what the
    // shape takes: far above rounding, a hundredth of it is asked for.
    const double shortest = std::sqrt(std::min({(x.row(1) - x.row(0)).squaredNorm(),
                                                (x.row(2) - x.row(0)).squaredNorm(),
                                                (x.row(4) - x.row(0)).squaredNorm()}));
    EXPECT_GT(values(6), 0.01 * material.shear_modulus_pa * shortest);
}

TEST(FreeElement, HasOnlySixMotionsWithoutStiffness) {
    for (ElementVariant variant : test::all_variants) {
        for (double r : {1.0, 2.0, 4.0}) {
            expect_six_rigid_motions(test::brick({r * 1e-4, r * 1e-4, 1e-4}), variant);
        }
        test::Random random(41);
        for (int trial = 0; trial < 10; ++trial) {
            expect_six_rigid_motions(test::distorted_element(random), variant);
        }
    }
}

// Bent elements keep it: the tangent of the hourglass energy is the difference of its
// gradient, and its energy is never negative.
TEST(HourglassEnergy, TangentIsTheDifferenceOfTheGradient) {
    const Material material = test::soft_material();
    test::Random random(42);
    for (int trial = 0; trial < 10; ++trial) {
        const Positions8 x0 = test::distorted_element(random);
        const HourglassReference reference =
            element_reference(x0, ElementVariant::assumed_strain, 0).hourglass;
        const Positions8 x = random.moved(x0 * random.rotation().transpose(), 1.5e-5);
        EXPECT_GT(hourglass_energy(reference, material, x).energy_j, 0);
        const Matrix24 tangent = hourglass_tangent(reference, material, x);
        const double h =
            1e-8;  // of 1e-4: the gradient is cubic, truncation (h/l)^2 = 1e-8
        for (int q = 0; q < 24; ++q) {
            Positions8 plus = x;
            Positions8 minus = x;
            plus(q / 3, q % 3) += h;
            minus(q / 3, q % 3) -= h;
            const Positions8 column =
                (hourglass_energy(reference, material, plus).gradient_n -
                 hourglass_energy(reference, material, minus).gradient_n) /
                (2 * h);
            for (int p = 0; p < 24; ++p) {
                EXPECT_NEAR(tangent(p, q), column(p / 3, p % 3), 1e-7 * tangent.norm());
            }
        }
    }
}

}  // namespace
}  // namespace magfsi::structure

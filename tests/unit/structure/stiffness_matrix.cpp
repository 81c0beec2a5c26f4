// SPDX-License-Identifier: GPL-2.0-or-later
// The tangent of an element, and the sparse matrix of a body against dense algebra.
#include <gtest/gtest.h>

#include "structure/equilibrium/static_problem.h"
#include "structure/lattice/plain_element.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

TEST(Tangent, IsMinusTheForceGradientInRandomStatesOfDistortedElements) {
    const Material material = test::soft_material();
    const double h = 1e-9;  // of 1e-4: truncation (h/l)^2 = 1e-10, rounding about 1e-11
    // Truncation and rounding, times the stiffening in the most bent states.
    const double tolerance = 1e-8;
    test::Random random(11);
    for (ElementVariant variant : test::all_variants) {
        for (int trial = 0; trial < 10; ++trial) {
            const Positions8 rest = test::distorted_element(random);
            const ElementReference reference = element_reference(rest, variant, 0);
            const Positions8 x =
                random.moved(rest * random.rotation().transpose(), 1.5e-5);
            ASSERT_GT(element_energy(reference, material, x).volume_ratio, 0);
            const Matrix24 tangent = element_tangent(reference, material, x);
            EXPECT_LT((tangent - tangent.transpose()).norm(), 1e-13 * tangent.norm());
            for (int q = 0; q < 24; ++q) {
                Positions8 plus = x;
                Positions8 minus = x;
                plus(q / 3, q % 3) += h;
                minus(q / 3, q % 3) -= h;
                const Positions8 slope =
                    (element_energy(reference, material, minus).force_n -
                     element_energy(reference, material, plus).force_n) /
                    (2 * h);
                for (int p = 0; p < 24; ++p) {
                    EXPECT_NEAR(tangent(p, q), slope(p / 3, p % 3),
                                tolerance * tangent.norm());
                }
            }
        }
    }
}

TEST(Tangent, LeavesTranslationsAndTurnsAtRestFree) {
    test::Random random(12);
    for (ElementVariant variant : test::all_variants) {
        const Positions8 x = test::distorted_element(random);
        const Matrix24 tangent =
            element_tangent(element_reference(x, variant, 0), test::soft_material(), x);
        const Eigen::SelfAdjointEigenSolver<Matrix24> eigen(tangent);
        const double largest = eigen.eigenvalues()(23);
        // Six rigid motions, to rounding; the seventh mode is a real deformation.
        EXPECT_LT(eigen.eigenvalues().head<6>().cwiseAbs().maxCoeff(), 1e-12 * largest);
        EXPECT_GT(eigen.eigenvalues()(6), 1e-4 * largest);
    }
}

// Two pieces of elements in random shape, one of them with held axes, and a node of no
// element.
struct TwoPieces {
    Mesh mesh = test::distorted_block({{4e-3, 2e-3, 1e-3}, {2, 2, 1}}, 5e-5, 1);
    std::vector<HeldAxes> held;
    std::vector<double> volumes_m3;

    TwoPieces() {
        const Mesh other = box_mesh({{1e-3, 2e-3, 9e-3}, {1, 1, 3}});
        const int first = static_cast<int>(mesh.nodes.size());
        mesh.nodes.push_back({0, 0, 0});  // of no element
        mesh.nodes.insert(mesh.nodes.end(), other.nodes.begin(), other.nodes.end());
        for (Hexahedron element : other.elements) {
            for (int& node : element) node += first + 1;
            mesh.elements.push_back(element);
        }
        held.resize(mesh.nodes.size());
        held[0] = {true, true, true};
        held[5] = {false, true, false};
        volumes_m3.assign(mesh.nodes.size(), 2.0);
        volumes_m3[first] = 0;
    }
    bool is_held(Eigen::Index q) const {
        return held[q / 3][q % 3] || !volumes_m3[q / 3];
    }
};

// Puts random symmetric element matrices into the matrix; returns the dense one.
Eigen::MatrixXd fill(const TwoPieces& body, StiffnessMatrix& matrix, double foundation) {
    test::Random random(3);
    const auto size = static_cast<Eigen::Index>(3 * body.held.size());
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
    matrix.set_zero();
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        Matrix24 element = Matrix24::NullaryExpr([&] { return random.uniform(); });
        element += element.transpose().eval();
        matrix.add_element(e, element);
        const Hexahedron& nodes = body.mesh.elements[e];
        for (int p = 0; p < 24; ++p) {
            for (int q = 0; q < 24; ++q) {
                dense(3 * nodes[p / 3] + p % 3, 3 * nodes[q / 3] + q % 3) +=
                    element(p, q);
            }
        }
    }
    matrix.raise_foundation(0.5 * foundation);
    matrix.raise_foundation(foundation);
    for (Eigen::Index q = 0; q < size; ++q) {
        dense(q, q) += foundation * body.volumes_m3[q / 3];
        if (!body.is_held(q)) continue;
        dense.row(q).setZero();
        dense.col(q).setZero();
        dense(q, q) = 1;
    }
    return dense;
}

TEST(StiffnessMatrix, SolvesAsDenseAlgebraDoes) {
    const TwoPieces body;
    StiffnessMatrix matrix(body.mesh, body.held, body.volumes_m3);
    const Eigen::MatrixXd dense = fill(body, matrix, 40);
    ASSERT_TRUE(matrix.factorize());
    Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(dense.rows(), -1, 2);
    const Eigen::VectorXd x = matrix.solve(right);
    for (Eigen::Index q = 0; q < x.size(); ++q) {
        if (!body.is_held(q)) continue;
        EXPECT_EQ(x[q], 0);
        right[q] = 0;
    }
    EXPECT_LT((dense * x - right).norm(), 1e-13 * right.norm());  // rounding
}

TEST(StiffnessMatrix, CountsTheNegativeEigenvalues) {
    const TwoPieces body;
    StiffnessMatrix matrix(body.mesh, body.held, body.volumes_m3);
    for (double foundation : {-20.0, -3.0, 0.0, 1.0, 3.0, 6.0, 40.0}) {
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
            fill(body, matrix, foundation));
        const auto expected = (eigen.eigenvalues().array() < 0).count();
        EXPECT_EQ(matrix.negative_eigenvalues(), expected) << foundation;
        EXPECT_EQ(matrix.factorize(), expected == 0) << foundation;
    }
}

// A free beam pressed together along its length, more and more: the tangent of every
// element variant becomes indefinite in more and more modes.
TEST(StiffnessMatrix, CountsTheNegativeEigenvaluesOfATangent) {
    for (ElementVariant variant : test::all_variants) {
        Body body;
        body.name = "beam";
        body.mesh = box_mesh({{20e-3, 2e-3, 1e-3}, {10, 2, 2}});
        body.material = test::soft_material();
        body.element = variant;
        StaticProblem problem(body);
        Eigen::Index most = 0;
        for (double strain : {0.0, 0.001, 0.01, 0.1, 0.4}) {
            Eigen::VectorXd x = flat_positions(body.mesh.nodes);
            for (Eigen::Index q = 0; q < x.size(); q += 3) x[q] *= 1 - strain;
            problem.assemble(x);
            problem.matrix().raise_foundation(problem.rigid_foundation());
            const Eigen::MatrixXd dense = problem.matrix().lower_triangle();
            const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(dense);
            const auto expected = (eigen.eigenvalues().array() < 0).count();
            EXPECT_EQ(problem.matrix().negative_eigenvalues(), expected)
                << "strain " << strain;
            EXPECT_GE(expected, most);
            most = expected;
        }
        EXPECT_GT(most, 10);
    }
}

}  // namespace
}  // namespace magfsi::structure

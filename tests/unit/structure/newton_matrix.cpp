// The block-tridiagonal solver against dense algebra, and the slices it works on.
#include <gtest/gtest.h>

#include <random>

#include "structure/equilibrium/block_tridiagonal.h"
#include "structure/equilibrium/node_levels.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

const std::vector<int> block_sizes{5, 8, 3, 7};

// A symmetric matrix of random blocks with its diagonal raised by `shift`.
Eigen::MatrixXd fill(BlockTridiagonal& matrix, double shift) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(matrix.size(), matrix.size());
    matrix.set_zero();
    for (int i = 0; i < static_cast<int>(block_sizes.size()); ++i) {
        const int n = block_sizes[i];
        const int at = matrix.offset(i);
        Eigen::MatrixXd block =
            Eigen::MatrixXd::NullaryExpr(n, n, [&] { return uniform(engine); });
        block += block.transpose().eval();
        block.diagonal().array() += shift;
        matrix.diagonal(i) = block;
        dense.block(at, at, n, n) = block;
        if (i == 0) continue;
        const int before = block_sizes[i - 1];
        matrix.below(i) =
            Eigen::MatrixXd::NullaryExpr(n, before, [&] { return uniform(engine); });
        dense.block(at, matrix.offset(i - 1), n, before) = matrix.below(i);
        dense.block(matrix.offset(i - 1), at, before, n) = matrix.below(i).transpose();
    }
    return dense;
}

TEST(BlockTridiagonal, SolvesAsDenseAlgebraDoes) {
    BlockTridiagonal matrix(block_sizes);
    const Eigen::MatrixXd dense = fill(matrix, 20);
    ASSERT_TRUE(matrix.factorize());
    const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(matrix.size(), -1, 2);
    Eigen::VectorXd x = right;
    matrix.solve_in_place(x);
    EXPECT_LT((dense * x - right).norm(), 1e-13 * right.norm());  // rounding
}

TEST(BlockTridiagonal, CountsTheNegativeEigenvalues) {
    for (double shift : {-20.0, -3.0, 0.0, 1.0, 3.0, 6.0, 20.0}) {
        BlockTridiagonal matrix(block_sizes);
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(fill(matrix, shift));
        const auto expected = (eigen.eigenvalues().array() < 0).count();
        EXPECT_EQ(matrix.count_negative(), expected) << "shift " << shift;
        fill(matrix, shift);
        EXPECT_EQ(matrix.factorize(), expected == 0) << "shift " << shift;
    }
}

TEST(NodeLevels, AreTheCrossSectionsOfABlockOfBricks) {
    const NodeLevels levels = node_levels(box_mesh({{2e-3, 5e-3, 1e-3}, {3, 7, 2}}));
    EXPECT_EQ(levels.size, std::vector<int>(8, 12));  // seven elements along y
}

TEST(NodeLevels, JoinOnlyNeighboursInABodyOfTwoPieces) {
    Mesh mesh = test::distorted_block({{4e-3, 2e-3, 1e-3}, {4, 3, 2}}, 5e-5, 1);
    const Mesh other = box_mesh({{1e-3, 2e-3, 9e-3}, {2, 2, 5}});
    const int first = static_cast<int>(mesh.nodes.size());
    mesh.nodes.insert(mesh.nodes.end(), other.nodes.begin(), other.nodes.end());
    for (Hexahedron element : other.elements) {
        for (int& node : element) node += first;
        mesh.elements.push_back(element);
    }
    mesh.nodes.push_back({0, 0, 0});  // of no element
    const NodeLevels levels = node_levels(mesh);
    int nodes = 0;
    for (int size : levels.size) nodes += size;
    EXPECT_EQ(nodes, static_cast<int>(mesh.nodes.size()) - 1);
    EXPECT_EQ(levels.level.back(), -1);
    for (const Hexahedron& element : mesh.elements) {
        for (int a : element) {
            for (int b : element) {
                EXPECT_LE(std::abs(levels.level[a] - levels.level[b]), 1);
            }
        }
    }
}

}  // namespace
}  // namespace magfsi::structure

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace magfsi::structure

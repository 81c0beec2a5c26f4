// SPDX-License-Identifier: GPL-2.0-or-later
// The vector type of all parts (base/vector/vec3.h).
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>
#include "base/vector/vec3.h"

namespace magfsi {
namespace {

// Numbers whose sums and products round.
constexpr Vec3 a{0.1, -2.3, 1e3 / 7}, b{1 / 3.0, 4.7, -0.9};

TEST(Vector, OperatorsRoundAsComponentsWrittenOut) {
    for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_EQ((a + b)[d], a[d] + b[d]);
        EXPECT_EQ((a - b)[d], a[d] - b[d]);
        EXPECT_EQ((-a)[d], -a[d]);
        EXPECT_EQ((0.3 * a)[d], 0.3 * a[d]);
        EXPECT_EQ((a * 0.3)[d], 0.3 * a[d]);
        EXPECT_EQ((a / 0.3)[d], a[d] / 0.3);
        EXPECT_EQ(lower(a, b)[d], std::min(a[d], b[d]));
        EXPECT_EQ(higher(a, b)[d], std::max(a[d], b[d]));
    }
    EXPECT_EQ(dot(a, b), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
    EXPECT_EQ(norm(a), std::hypot(a[0], a[1], a[2]));
}

TEST(Vector, CompoundOperatorsAreTheirPlainOnes) {
    Vec3 sum = a, difference = a, product = a, quotient = a;
    EXPECT_EQ(sum += b, a + b);
    EXPECT_EQ(difference -= b, a - b);
    EXPECT_EQ(product *= 0.3, a * 0.3);
    EXPECT_EQ(quotient /= 0.3, a / 0.3);
    Vec3 own = a;  // a factor that the operator changes on the way
    EXPECT_EQ(own *= own[0], a[0] * a);
}

TEST(Vector, CrossProductTurnsByTheRightHand) {
    constexpr Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    EXPECT_EQ(cross(x, y), z);
    EXPECT_EQ(cross(y, z), x);
    EXPECT_EQ(cross(z, x), y);
    EXPECT_EQ(cross(y, x), -z);
}

TEST(Vector, LengthOverflowsNowhereOnTheWay) {
    EXPECT_DOUBLE_EQ(norm(Vec3{3e200, 4e200, 0}), 5e200);
    EXPECT_DOUBLE_EQ(norm(Vec3{3e-200, 4e-200, 0}), 5e-200);
}

TEST(Vector, ManyAreOneListOfNumbers) {
    std::vector<Vec3> many{a, b};
    const std::span<double> flat(many.front().data(), 6);
    EXPECT_EQ(flat[5], b[2]);
    EXPECT_EQ(vector_at(&flat[3]), b);
    add_to(&flat[3], a);
    EXPECT_EQ(many[1], b + a);
    const auto& [x, y, z] = many[0];
    EXPECT_EQ(&z, &flat[2]);
    EXPECT_EQ((Vec3{x, y, z}), a);
}

}  // namespace
}  // namespace magfsi

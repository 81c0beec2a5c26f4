// A marker's force reaches its nodes by the transpose of what brings their motion to it.
#include <gtest/gtest.h>

#include <numeric>

#include "coupler/immersed_boundary/markers.h"
#include "tests/unit/coupler/random_markers.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

TEST(MarkerWeights, the_two_ways_are_transposed) {
    Random random(21);
    for (const Marker& marker : random_markers(random, 100)) {
        const auto velocity = random_nodal(random);
        const Vec3 force = random.vector(1);
        const Vec3 at = at_marker(marker, velocity.data());
        std::vector<double> nodal(velocity.size());
        to_nodes(marker, force, nodal.data());
        const double at_the_marker =
            force[0] * at[0] + force[1] * at[1] + force[2] * at[2];
        const double at_the_nodes =
            std::inner_product(nodal.begin(), nodal.end(), velocity.begin(), 0.0);
        // 24 products of order 0.1.
        EXPECT_NEAR(at_the_marker, at_the_nodes, 1e-15);
    }
}

TEST(MarkerWeights, forces_add_to_what_the_nodes_hold) {
    Random random(22);
    const Marker marker = random_markers(random, 1)[0];
    std::vector<double> nodal(3 * nodes, 5.0);
    to_nodes(marker, {1, 0, -2}, nodal.data());
    Vec3 sum{};
    for (std::size_t i = 0; i < nodal.size(); ++i) sum[i % 3] += nodal[i] - 5.0;
    // The weights add up to one; differences to 5 are rounded to 1e-15 each.
    EXPECT_NEAR(sum[0], 1, 1e-14);
    EXPECT_EQ(sum[1], 0);
    EXPECT_NEAR(sum[2], -2, 1e-14);
}

}  // namespace
}  // namespace magfsi::coupler

// The sample with half the pending forces is the mean of the samples before and after the
// step in which they act, wherever the markers have gone to in the meantime.
#include <gtest/gtest.h>

#include "coupler/immersed_boundary/fluid_side.h"
#include "tests/mpi/coupler/travelling_markers.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

class ForcedSample : public ::testing::Test {
  protected:
    const Grid grid = channel(1);
    const TravellingMarkers markers{grid.spacing_m};
    ArrayFluid fluid{grid, 0};
    FluidSide side{fluid, grid.owned_by_rank[0], kernel, ArrayFluid::step_s};
};

TEST_F(ForcedSample, is_the_mean_of_before_and_after) {
    // Four steps apart: about one cell, so that the rows overlap in part.
    const auto there = markers.positions(4);
    side.spread(markers.positions(0), markers.impulses(0));
    const auto copy = [](std::span<const Vec3> u) {
        return std::vector<Vec3>(u.begin(), u.end());
    };
    const auto before = copy(side.sample(there));
    const auto forced = copy(side.sample_forced(there, ArrayFluid::density_kg_m3));
    fluid.advance();
    const auto after = copy(side.sample(there));
    double largest_change = 0;
    for (std::size_t m = 0; m < there.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d) {
            // Velocities are of order one; some hundred roundings.
            EXPECT_NEAR(forced[m][d], 0.5 * (before[m][d] + after[m][d]), 1e-14);
            largest_change = std::max(largest_change, after[m][d] - before[m][d]);
        }
    }
    EXPECT_GT(largest_change, 1e-4);  // there was something to be seen
}

// A fluid that has moved on is audited with what the markers felt before.
TEST_F(ForcedSample, audit_with_the_velocities_that_were_felt) {
    const auto points = markers.positions(0);
    side.spread(points, markers.impulses(3));
    const auto felt = side.sample(points);
    InterfaceBalance given;
    const auto impulses = markers.impulses(5);
    for (std::size_t m = 0; m < points.size(); ++m)
        add_marker(given, impulses[m], felt[m]);
    fluid.advance();
    side.spread(points, impulses);
    const auto received = side.received(side.sampled_cells());
    EXPECT_NEAR(received.work_j, given.work_j, 1e-13 * given.work_scale_j);
    EXPECT_GT(std::abs(side.received().work_j - given.work_j), 1e-6 * given.work_scale_j);
}

}  // namespace
}  // namespace magfsi::coupler

// A plane flow in a periodic slab is the same one cell deep and four cells deep.
#include <gtest/gtest.h>

#include "tests/unit/fluid_boundary/channel.h"

namespace magfsi::fluid {
namespace {

FluidConfig slab(int depth, int axis) {
    std::array<int, 3> cells{24, 12, 12};
    cells[axis] = depth;
    FluidConfig config = channel(cells, 0.55, 0, 0.05, BoundaryKind::no_slip);
    config.boundaries[2 * axis].kind = BoundaryKind::periodic;
    config.boundaries[2 * axis + 1].kind = BoundaryKind::periodic;
    config.boundaries[0].inlet.profile = InletProfile::parabolic;
    config.obstacles = {{"rod", Cylinder{{7.2, 5.7, 5.7}, 4, axis, {}}}};
    return config;
}

// Largest difference of the velocities of this rank's cells.
double difference(const Fluid& one, const Fluid& deep, int axis) {
    const auto thin = all_rows(one);
    std::vector<double> u(3 * thin.size() * thin.front().size());
    one.velocity(thin, u);
    std::size_t first = 0;
    double largest = 0;
    const CellBox owned = deep.owned();
    for (CellRow row : thin) {
        // The middle plane of four; the fluids may be cut into ranks along other axes.
        (axis == 1 ? row.y : row.z) = 2;
        const bool here = row.y >= owned.lo[1] && row.y < owned.hi[1] &&
                          row.z >= owned.lo[2] && row.z < owned.hi[2];
        std::vector<double> v(3 * static_cast<std::size_t>(row.size()));
        if (here) {
            deep.velocity({&row, 1}, v);
            for (std::size_t i = 0; i < v.size(); ++i)
                largest = std::max(largest, std::abs(v[i] - u[first + i]));
        }
        first += v.size();
    }
    return largest;
}

TEST(ThinSlab, OneCellIsAsDeepAsFour) {
    for (const int axis : {1, 2}) {
        Fluid one(MPI_COMM_WORLD, slab(1, axis)), deep(MPI_COMM_WORLD, slab(4, axis));
        advance(one, 101);  // both arrangements of in-place streaming
        advance(deep, 101);
        // Rounding of sums in another order, over 100 steps of 0.05.
        EXPECT_LT(difference(one, deep, axis), 1e-14) << "axis " << axis;
        const double force = one.obstacle_forces()[0][0];
        EXPECT_GT(force, 1e-4);
        EXPECT_NEAR(deep.obstacle_forces()[0][0] / (4 * force), 1, 1e-10);
    }
}

}  // namespace
}  // namespace magfsi::fluid

// A cell that went wrong is named by its global index, in both arrangements.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

FluidConfig calm() {
    return lattice_fluid({9, 6, 5}, 0.8, Collision::automatic);
}

bool owns(const Fluid& fluid, int y, int z) {
    const CellBox box = fluid.owned();
    return y >= box.lo[1] && y < box.hi[1] && z >= box.lo[2] && z < box.hi[2];
}

TEST(Divergence, CalmFluidHasNone) {
    Fluid fluid(MPI_COMM_WORLD, calm());
    EXPECT_FALSE(fluid.divergence());
    fluid.step();
    EXPECT_FALSE(fluid.divergence());
}

TEST(Divergence, NamesTheCellThatIsNotFinite) {
    FluidConfig config = calm();
    config.initial_pressure = [](const Vec3& x) {
        return x == Vec3{3.5, 4.5, 2.5} ? NAN : 0.0;
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    const auto found = fluid.divergence();
    ASSERT_EQ(found.has_value(), owns(fluid, 4, 2));
    if (!found) return;
    EXPECT_EQ(found->cell, (std::array<int, 3>{3, 4, 2}));
}

TEST(Divergence, NamesTheCellThatIsTooFast) {
    Fluid fluid(MPI_COMM_WORLD, calm());
    std::vector<CellRow> row;
    std::vector<double> force;
    if (owns(fluid, 2, 1)) {
        row.push_back({2, 1, 7, 8});
        force = {3, 0, 0};  // accelerates the neighbours downstream beyond the limit
    }
    fluid.set_force(row, force);
    fluid.step();
    const auto found = fluid.divergence();
    int any = found.has_value();
    MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    ASSERT_EQ(any, 1);
    if (found) {
        EXPECT_GT(found->lattice_speed, 0.4);
        EXPECT_LE(std::abs(found->cell[1] - 2), 1);
        EXPECT_LE(std::abs(found->cell[2] - 1), 1);
    }
}

}  // namespace
}  // namespace magfsi::fluid

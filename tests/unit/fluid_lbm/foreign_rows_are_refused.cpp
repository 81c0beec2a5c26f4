// Rows outside the rank's box and values that do not match them are refused.
#include <gtest/gtest.h>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

TEST(ForeignRows, AreRefused) {
    Fluid fluid(MPI_COMM_WORLD, lattice_fluid({9, 6, 5}, 0.8, Collision::automatic));
    const CellBox box = fluid.owned();
    const CellRow good{box.lo[1], box.lo[2], 0, 9};
    std::vector<double> values(27);
    EXPECT_NO_THROW(fluid.velocity(std::span(&good, 1), values));
    CellRow outside = good;
    outside.y = box.hi[1];
    CellRow beyond = good;
    beyond.x_begin = 1;
    beyond.x_end = 10;
    for (const CellRow& row : {outside, beyond}) {
        EXPECT_THROW(fluid.velocity(std::span(&row, 1), values), std::invalid_argument);
        EXPECT_THROW(fluid.set_force(std::span(&row, 1), values), std::invalid_argument);
    }
    values.pop_back();
    EXPECT_THROW(fluid.set_force(std::span(&good, 1), values), std::invalid_argument);
}

TEST(InstructionSet, UnknownNameIsRefused) {
    setenv("MAGFSI_ISA", "mmx", 1);
    const FluidConfig config = lattice_fluid({4, 6, 5}, 0.8, Collision::automatic);
    EXPECT_THROW(Fluid(MPI_COMM_WORLD, config), std::invalid_argument);
    setenv("MAGFSI_ISA", "sse2", 1);
    EXPECT_EQ(Fluid(MPI_COMM_WORLD, config).kernel(), "sse2");
    unsetenv("MAGFSI_ISA");
}

}  // namespace
}  // namespace magfsi::fluid

// velocity() reads the same flow from both arrangements of the populations, for any row
// length and any part of a row.
#include <gtest/gtest.h>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

class VelocityInBothStates : public testing::TestWithParam<int> {};

TEST_P(VelocityInBothStates, OfUniformFlow) {
    for (Collision collision :
         {Collision::bgk, Collision::trt, Collision::recursive_regularized}) {
        FluidConfig config = lattice_fluid({GetParam(), 4, 3}, 0.6, collision);
        const Vec3 wind{0.05, -0.03, 0.02};
        config.initial_velocity = [&](const Vec3&) { return wind; };
        Fluid fluid(MPI_COMM_WORLD, config);
        for (int step = 0; step < 5; ++step) {
            const std::vector<double> u = velocity(fluid);
            for (std::size_t i = 0; i < u.size(); ++i) {
                // A few roundings of f - w near 1e-2 a step.
                ASSERT_NEAR(u[i], wind[i % 3], 2e-15) << "step " << step;
            }
            fluid.step();
        }
    }
}

TEST_P(VelocityInBothStates, OfPartsOfRows) {
    const int nx = GetParam();
    FluidConfig config = lattice_fluid({nx, 4, 3}, 0.6, Collision::automatic);
    set_walls(config, 0);
    set_walls(config, 1);
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.01 * x[1], 0.02 / (1 + x[0]), 0.01 * x[2] * x[0] / 30};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    for (int step = 0; step < 3; ++step) {
        const std::vector<double> whole = velocity(fluid);
        std::size_t first = 0;
        for (const CellRow& row : all_rows(fluid)) {
            for (int begin = 0; begin < nx; begin += 3) {
                CellRow part = row;
                part.x_begin = begin;
                part.x_end = std::min(begin + 4, nx);
                std::vector<double> u(3 * part.size());
                fluid.velocity(std::span(&part, 1), u);
                for (std::size_t i = 0; i < u.size(); ++i) {
                    ASSERT_EQ(u[i], whole[first + 3 * begin + i]);
                }
            }
            first += 3 * row.size();
        }
        fluid.step();
    }
}

INSTANTIATE_TEST_SUITE_P(RowLengths, VelocityInBothStates, testing::Values(5, 8, 13, 33));

}  // namespace
}  // namespace magfsi::fluid

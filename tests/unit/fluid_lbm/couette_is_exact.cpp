// Plane Couette flow: half-way bounce-back with the moving wall's term gives the linear
// profile to rounding, for walls on every axis.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

struct Case {
    Collision collision;
    int normal, along;
};

class Couette : public testing::TestWithParam<Case> {};

TEST_P(Couette, ProfileIsLinear) {
    const auto [collision, normal, along] = GetParam();
    constexpr int n = 8;
    std::array<int, 3> cells{5, 4, 4};
    cells[normal] = n;
    FluidConfig config = lattice_fluid(cells, 0.9, collision);
    set_walls(config, normal);
    // The profile is exact at low Mach number only; density varies by u^2.
    constexpr double low = -1e-6, high = 2e-6;
    config.boundaries[2 * normal].wall_velocity_m_s[along] = low;
    config.boundaries[2 * normal + 1].wall_velocity_m_s[along] = high;
    Fluid fluid(MPI_COMM_WORLD, config);
    // The slowest mode decays by exp(-pi^2 nu t / n^2) = exp(-41).
    constexpr int steps = 2001;
    for (int i = 0; i < steps; ++i) fluid.step();
    double worst = 0;
    const CellBox box = fluid.owned();
    const std::vector<double> u = velocity(fluid);
    std::size_t i = 0;
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        for (int y = box.lo[1]; y < box.hi[1]; ++y) {
            for (int x = box.lo[0]; x < box.hi[0]; ++x, i += 3) {
                const int position = std::array<int, 3>{x, y, z}[normal];
                const double exact = low + (high - low) * (position + 0.5) / n;
                worst = std::max(worst, std::abs(u[i + along] - exact) / (high - low));
            }
        }
    }
    std::printf("largest error over wall speed: %.1e\n", worst);
    EXPECT_LT(worst, 1e-10);  // rounding of f - w near 1e-7 and the rest of the transient
}

INSTANTIATE_TEST_SUITE_P(
    All, Couette,
    testing::Values(Case{Collision::bgk, 0, 1}, Case{Collision::bgk, 1, 2},
                    Case{Collision::bgk, 2, 0}, Case{Collision::trt, 0, 1},
                    Case{Collision::trt, 1, 0}, Case{Collision::trt, 2, 1},
                    Case{Collision::recursive_regularized, 0, 2},
                    Case{Collision::recursive_regularized, 1, 0},
                    Case{Collision::recursive_regularized, 2, 1}));

}  // namespace
}  // namespace magfsi::fluid

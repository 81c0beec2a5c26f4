// Velocity, vorticity and totals of a fluid do not depend on the number of ranks.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

FluidConfig lid_driven(bool periodic_z) {
    FluidConfig config = lattice_fluid({10, 6, 6}, 0.53, Collision::automatic);
    set_walls(config, 0);
    set_walls(config, 1);
    if (!periodic_z) set_walls(config, 2);
    config.boundaries[3].wall_velocity_m_s = {0.05, 0, 0.03};
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.02 * std::sin(x[1] + x[2]), 0.02 * std::cos(x[0]), 0.01 * x[1] / 6};
    };
    return config;
}

// Values of all cells of the box (three each) at the cells of this rank.
std::vector<float> part(const std::vector<float>& whole, const CellBox& box,
                        const std::array<int, 3>& cells) {
    std::vector<float> mine;
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        for (int y = box.lo[1]; y < box.hi[1]; ++y) {
            const std::size_t row = static_cast<std::size_t>(z) * cells[1] + y;
            const auto first = whole.begin() + static_cast<long>(3 * row * cells[0]);
            mine.insert(mine.end(), first, first + 3 * cells[0]);
        }
    }
    return mine;
}

std::vector<float> vorticity(const Fluid& fluid) {
    std::vector<float> values(3 * 10 * all_rows(fluid).size());
    fluid.vorticity(values);
    return values;
}

void expect_close(double a, double b, const char* what) {
    EXPECT_NEAR(a, b, 1e-12 * std::abs(b)) << what;  // sums in another order
}

class Sampling : public testing::TestWithParam<bool> {};

TEST_P(Sampling, IsTheSameOnAnyRanks) {
    const FluidConfig config = lid_driven(GetParam());
    Fluid parallel(MPI_COMM_WORLD, config), serial(MPI_COMM_SELF, config);
    for (int step = 0; step < 5; ++step) {
        EXPECT_EQ(vorticity(parallel),
                  part(vorticity(serial), parallel.owned(), config.cells));
        const Totals a = parallel.totals(), b = serial.totals();
        expect_close(a.mass_kg, b.mass_kg, "mass");
        expect_close(a.kinetic_energy_j, b.kinetic_energy_j, "kinetic energy");
        expect_close(parallel.enstrophy_1_s2(), serial.enstrophy_1_s2(), "enstrophy");
        EXPECT_EQ(a.max_speed_m_s, b.max_speed_m_s);
        parallel.step();
        serial.step();
    }
}

INSTANTIATE_TEST_SUITE_P(PeriodicAlongZ, Sampling, testing::Bool());

}  // namespace
}  // namespace magfsi::fluid

// A step that is taken again with other forces ends where a fluid ends that took it with
// those alone, to the last bit: from either arrangement, on any ranks, whether only the
// forced rows are swept again or the whole state is put back.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

constexpr std::array<int, 3> cells{10, 9, 8};

enum class Sides { periodic, walls, moving_wall, outlet };

FluidConfig box(Sides sides, Precision precision) {
    FluidConfig config = lattice_fluid(cells, 0.53, Collision::automatic);
    config.precision = precision;
    if (sides != Sides::periodic) {
        set_walls(config, 0);
        set_walls(config, 1);
    }
    if (sides == Sides::moving_wall)
        config.boundaries[3].wall_velocity_m_s = {0.05, 0, 0.03};
    if (sides == Sides::outlet) {
        config.boundaries[0].kind = BoundaryKind::velocity_inlet;
        config.boundaries[0].inlet = {{0.02, 0, 0}, InletProfile::uniform, 0, {}};
        config.boundaries[1].kind = BoundaryKind::pressure_outlet;
    }
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.02 * std::sin(x[1] + x[2]), 0.02 * std::cos(x[0]), 0.01 * x[1] / 6};
    };
    return config;
}

// In the rows of this rank that lie in a block across most cuts; another one each time.
void push(Fluid& fluid, int time, int attempt) {
    std::vector<CellRow> rows;
    std::vector<double> force;
    const CellBox own = fluid.owned();
    for (int z = std::max(2, own.lo[2]); z < std::min(7, own.hi[2]); ++z) {
        for (int y = std::max(0, own.lo[1]); y < std::min(6, own.hi[1]); ++y) {
            rows.push_back({y, z, 0, 7});
            for (int i = 0; i < 21; ++i)
                force.push_back(1e-3 *
                                std::sin(1.0 + i + 3 * y + 5 * z + time + 7 * attempt));
        }
    }
    fluid.set_force(rows, force);
}

std::vector<double> state_of(const Fluid& fluid) {
    const CellBox own = fluid.owned();
    std::vector<double> all;
    for (int z = own.lo[2]; z < own.hi[2]; ++z) {
        std::vector<double> plane(static_cast<std::size_t>(populations_a_cell * cells[0] *
                                                           (own.hi[1] - own.lo[1])));
        fluid.populations(z, plane);
        all.insert(all.end(), plane.begin(), plane.end());
    }
    return all;
}

void expect_same(Sides sides, Precision precision = Precision::double_) {
    Fluid once(MPI_COMM_WORLD, box(sides, precision));
    Fluid again(MPI_COMM_WORLD, box(sides, precision));
    for (int step = 0; step < 6; ++step) {
        again.keep();
        for (int attempt = 2; attempt > 0; --attempt) {
            push(again, step, attempt);
            again.step();
            again.go_back();
        }
        push(again, step, 0);
        again.step();
        push(once, step, 0);
        once.step();
        ASSERT_EQ(state_of(again), state_of(once)) << "step " << step;
        EXPECT_EQ(again.steps_done(), once.steps_done());
        once.step();  // one that is not repeated in between
        again.step();
        ASSERT_EQ(state_of(again), state_of(once)) << "after step " << step;
        if (step % 2 == 0) continue;
        once.step();  // the next one starts from the other arrangement
        again.step();
    }
}

TEST(StepsAgain, in_a_periodic_box) {
    expect_same(Sides::periodic);
}

TEST(StepsAgain, between_walls) {
    expect_same(Sides::walls);
}

TEST(StepsAgain, in_single_precision) {
    expect_same(Sides::walls, Precision::float_);
}

TEST(StepsAgain, beside_a_moving_wall) {
    expect_same(Sides::moving_wall);
}

TEST(StepsAgain, between_an_inlet_and_an_outlet) {
    expect_same(Sides::outlet);
}

// Swept alone, a row must see the force of its own: the first attempt is to leave no
// trace, also not in what was found unsound.
TEST(StepsAgain, what_was_unsound_in_an_attempt_is_forgotten) {
    Fluid fluid(MPI_COMM_SELF, box(Sides::walls, Precision::double_));
    fluid.keep();
    const std::vector<CellRow> row{{3, 3, 2, 3}};
    fluid.set_force(row, std::vector<double>{1e3, 0, 0});
    fluid.step();
    EXPECT_TRUE(fluid.diverged());
    fluid.go_back();
    fluid.set_force(row, std::vector<double>{1e-3, 0, 0});
    fluid.step();
    EXPECT_FALSE(fluid.diverged());
}

}  // namespace
}  // namespace magfsi::fluid

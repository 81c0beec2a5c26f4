// SPDX-License-Identifier: GPL-2.0-or-later
// 100,000 steps in a closed box, driven at a body that circles and is followed: the mass
// stays within what as many roundings may add up to.
#include <gtest/gtest.h>

#include <cstdio>

#include "fluid_lbm/refinement/refined_fluid.h"
#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

TEST(Refinement, KeepsTheMassOver100000Steps) {
    RefinedConfig config;
    config.coarse = lattice_fluid({18, 16, 14}, 0.55, Collision::recursive_regularized);
    for (int axis = 0; axis < 3; ++axis) set_walls(config.coarse, axis);
    config.rule.slack_cells = 0;
    const auto body = [](int step) {
        const double x = 9 + 1.5 * std::sin(step / 60.0), y = 8 + std::cos(step / 60.0);
        return std::vector<BodyBox>{
            {Vec3{x - 1.4, y - 1.4, 6}, Vec3{x + 1.4, y + 1.4, 8}}};
    };
    RefinedFluid fluid(MPI_COMM_WORLD, config, body(0));
    const double mass = fluid.totals().mass_kg;
    double worst = 0, fastest = 0;
    for (int step = 0; step < 100000; ++step) {
        if (fluid.levels_are_level()) fluid.follow(body(step));
        const int x = static_cast<int>(2 * body(step)[0][0][0]), y = 15, z = 14;
        const std::vector rows{CellRow{y, z, x, x + 4}, CellRow{y + 1, z, x, x + 4}};
        fluid.set_force(rows, std::vector(24, step % 400 < 200 ? 1e-3 : -1e-3));
        fluid.step();
        if (step % 1000 != 999) continue;
        const Totals all = fluid.totals();
        worst = std::max(worst, std::abs(all.mass_kg / mass - 1));
        fastest = std::max(fastest, all.max_speed_m_s);
    }
    std::printf("%lld moves, speeds to %.3g cells a step: mass within %.2g\n",
                static_cast<long long>(fluid.moves()), fastest, worst);
    EXPECT_GT(fluid.moves(), 1000);
    EXPECT_GT(fastest, 1e-3);
    EXPECT_LT(worst, 1e-12);
}

}  // namespace
}  // namespace magfsi::fluid

// What the script's drag and clamps do in real LAMMPS.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

TEST(Drag, SlowsEveryNodeAtItsRateWhateverItsMass) {
    LammpsInput input = test::bare_strip();
    input.drag_rate_1_s = 300;
    const test::SharedFolder folder;
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("velocity all set 0.1 0.0 -0.2");
    run.command("run 0");
    run.command("run 1000 pre no post no");
    const double decay = std::exp(-300 * 1000 * input.time_step_s);
    const auto v = run.gather("v");
    for (std::size_t q = 0; q < v.size(); q += 3) {
        // The force uses the velocity of the half step: first order, rate dt = 1e-3.
        EXPECT_NEAR(v[q], 0.1 * decay, 2e-3 * 0.1);
        EXPECT_NEAR(v[q + 2], -0.2 * decay, 2e-3 * 0.2);
    }
}

TEST(Clamps, HoldTheirNodesAndCarryTheWeight) {
    LammpsInput input = test::bare_strip();
    input.bodies[0].clamps = {"x_min"};
    input.gravity_m_s2 = Vec3{0, 0, -9.81};
    input.drag_rate_1_s = 220;
    const test::SharedFolder folder;
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("run 0");
    const auto start = run.gather("x");
    run.command("run 30000 pre no post no");
    const auto x = run.gather("x");
    const auto f = run.gather("f");
    double reaction = 0;
    for (int node : input.bodies[0].mesh.faces.at("x_min")) {
        for (std::size_t d = 0; d < 3; ++d) {
            const std::size_t q = 3 * static_cast<std::size_t>(node) + d;
            EXPECT_EQ(x[q], start[q]);
            reaction += d == 2 ? f[q] : 0;
        }
    }
    const double weight = 1860 * 3.7e-3 * 1.5e-3 * 0.185e-3 * 9.81;
    // The lowest mode, 112 rad/s, is damped critically: exp(-110 / s * 0.105 s) is 1e-5
    // of the first swing, times its phase.
    EXPECT_NEAR(reaction / weight, -1, 1e-3);
}

}  // namespace
}  // namespace magfsi::structure

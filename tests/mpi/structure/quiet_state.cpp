#include <gtest/gtest.h>

#include <cmath>

#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

LammpsInput cantilever() {
    LammpsInput input = test::strip_in_field();
    input.bodies[0].clamps = {"x_min"};
    input.field = FieldProgram{{0, 2}, ConstantField{2e-3, 1.0}};
    input.gravity_m_s2 = Vec3{0, 0, -9.81};
    input.drag_rate_1_s = 220;  // twice the lowest frequency, 112 rad/s
    input.quiet = true;
    return input;
}

TEST(Quiet, StartsAtOneWhereNothingIsStrained) {
    const LammpsInput input = cantilever();
    const test::SharedFolder folder;
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("run 0");
    const double force = run.fix_value("quiet", 0);
    EXPECT_GT(force, 0);
    // Elastic forces at rest are rounding: 1e-16 of G times a face over nodes of 1e-10 N.
    EXPECT_NEAR(run.fix_value("quiet", 1) / force, 1, 1e-6);
}

TEST(Quiet, HaltsARunInTheEquilibrium) {
    const LammpsInput input = cantilever();
    const test::SharedFolder folder;
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("variable unrest equal f_quiet");
    run.command("fix stop all halt 500 v_unrest < 1e-3 error continue message no");
    run.command("run 100000 post no");
    const double ratio = run.fix_value("quiet", 0) / run.fix_value("quiet", 1);
    const double steps = run.variable("unrest");
    std::printf("cantilever: halted at a ratio of %.2g\n", ratio);
    EXPECT_LT(ratio, 1e-3);
    EXPECT_EQ(steps, ratio);
    const auto x = run.gather("x");
    run.command("unfix stop");
    run.command("run 30000 post no");
    const auto later = run.gather("x");
    double moved = 0;
    double bent = 0;
    for (std::size_t q = 2; q < x.size(); q += 3) {
        moved = std::max(moved, std::abs(later[q] - x[q]));
        bent = std::max(bent, std::abs(later[q] - 0.185e-3));
    }
    std::printf("moved after that by %.2g m of %.2g m\n", moved, bent);
    // The slowest mode's share of the force is small against that of a stiff one: a ratio
    // of 1e-3 leaves more than 1e-3 of the displacement.
    EXPECT_LT(moved, 0.05 * bent);
}

}  // namespace
}  // namespace magfsi::structure

// What real LAMMPS makes of the generated field against the interpolation.
#include <gtest/gtest.h>

#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

void expect_field_of(const FieldProgram& program) {
    LammpsInput input = test::strip_in_field();
    input.field = program;
    const test::SharedFolder folder;
    const LammpsScript script = folder.write(input);
    test::LammpsRun run(MPI_COMM_WORLD, script.setup);
    run.command("run 0");
    long step = 0;
    for (int steps : {0, 1, 7, 500, 2000}) {
        run.command("run " + std::to_string(steps) + " pre no post no");
        step += steps;
        const Vec3 b = field_at(program, static_cast<double>(step) * input.time_step_s);
        // The time step is written with 17 digits: nothing is lost.
        EXPECT_EQ(run.variable("Bx"), b[0]) << step;
        EXPECT_EQ(run.variable("By"), b[1]) << step;
        EXPECT_EQ(run.variable("Bz"), b[2]) << step;
    }
    run.command("reset_timestep 123456");
    run.command("run 0");
    EXPECT_EQ(run.variable("Bz"), field_at(program, 123456 * input.time_step_s)[2]);
}

TEST(FieldVariables, FollowTheTable) {
    expect_field_of({{0, 2},
                     FieldTable{{0, 0.002, 0.003, 0.004},
                                {-0.017, 0.017, -0.017, -0.017},
                                {0.8, 0.9, 1.0, 0.8},
                                true}});
}

TEST(FieldVariables, FollowTheRotation) {
    expect_field_of({{1, 2}, RotatingField{0.005, 0.3, 25}});
}

TEST(FieldVariables, CanBeReplacedFromTheScript) {
    const LammpsInput input = test::strip_in_field();
    const test::SharedFolder folder;
    const LammpsScript script = folder.write(input);
    test::LammpsRun run(MPI_COMM_WORLD, script.setup);
    for (const char* component : {"Bx", "By", "Bz"}) {
        run.command(std::string("variable ") + component + " equal 0");
    }
    run.command("run 0");
    run.command("run 100 pre no post no");
    // No field, no force: rest up to rounding of forces, 1e-16 of G l over 1e-10 kg
    // nodes.
    for (double v : run.gather("v")) EXPECT_LT(std::abs(v), 1e-9);
}

}  // namespace
}  // namespace magfsi::structure

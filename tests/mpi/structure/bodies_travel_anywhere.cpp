#include <gtest/gtest.h>

#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

TEST(Gravity, DropsABodyFarOutOfItsBoxWithoutLosingAtoms) {
    LammpsInput input = test::bare_strip();
    input.gravity_m_s2 = Vec3{1e5, 0, -5e4};
    const test::SharedFolder folder;
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("run 0");
    const auto start = run.gather("x");
    constexpr int steps = 400;
    run.command("run 400 pre no post no");
    const double t = steps * input.time_step_s;
    const auto x = run.gather("x");
    ASSERT_GT(5e4 * t * t, 10 * 3.7e-3);  // ten lengths along x
    for (std::size_t q = 0; q < x.size(); q += 3) {
        // Velocity Verlet is exact for constant forces; rounding over 400 steps.
        EXPECT_NEAR(x[q] - start[q], 5e4 * t * t, 1e-10);
        EXPECT_NEAR(x[q + 2] - start[q + 2], -2.5e4 * t * t, 1e-10);
    }
    run.command("run 10 post no");  // setup anew where the body now is
    EXPECT_EQ(run.atoms(), 567);
}

}  // namespace
}  // namespace magfsi::structure

// Rollers in real LAMMPS: held along one axis, free along the others.
#include <gtest/gtest.h>

#include "structure/body.h"
#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

TEST(Rollers, HoldOneCoordinateAndLeaveTheOthersFree) {
    LammpsInput input = test::bare_strip();
    input.bodies[0].rollers = {{{"y_min"}, 1}, {{"y_max"}, 1}, {{"x_min"}, 0}};
    input.gravity_m_s2 = Vec3{1, 2, -3};
    const test::SharedFolder folder;
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("run 0");
    const auto start = run.gather("x");
    run.command("run 2000 pre no post no");
    const auto x = run.gather("x");
    const double time = 2000 * input.time_step_s;
    const auto held = held_axes(input.bodies[0]);
    double fallen = 0;
    for (std::size_t q = 0; q < x.size(); ++q) {
        EXPECT_TRUE(!held[q / 3][q % 3] || x[q] == start[q]) << "value " << q;
        if (q % 3 == 2) fallen += (x[q] - start[q]) * 3 / static_cast<double>(x.size());
    }
    // Nothing holds it along z: free fall, but for the 2 % that bending moves nodes
    // against the centre of mass, which is not their mean.
    EXPECT_NEAR(fallen / (-1.5 * time * time), 1, 0.02);
}

}  // namespace
}  // namespace magfsi::structure

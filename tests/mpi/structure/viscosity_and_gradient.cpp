// Kelvin-Voigt damping and a field gradient in real LAMMPS.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

TEST(Viscosity, TakesTheEnergyThatIsLost) {
    LammpsInput input = test::bare_strip();
    Placement placement;
    placement.relaxed = ConstantField{5e-3, 0.8};
    input.placements = {placement};
    input.bodies[0].material.viscosity_pa_s = 2;
    input.time_step_s = 0.9 * stable_step_s(input.bodies[0]);
    const test::SharedFolder folder;
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("run 0");
    const double start = run.fix_value("magttice_strip", 0);
    run.command("run 8000 pre no post no");
    const double left = test::kinetic_energy(input.bodies[0], run.gather("v")) +
                        run.fix_value("magttice_strip", 0);
    const double lost = run.fix_value("magttice_strip", 4);
    std::printf("viscous vibration: %.3f of the energy lost, balance %.2g\n",
                lost / start, (left + lost) / start - 1);
    EXPECT_GT(lost, 0.1 * start);
    // The loss is summed with the velocity of the half step before: first order in the
    // step times the frequency of the modes that lose the energy, 1e-3.
    EXPECT_NEAR((left + lost) / start, 1, 1e-2);
}

LammpsInput strip_in_gradient() {
    LammpsInput input = test::bare_strip();
    input.bodies[0].magnetization_a_m =
        uniform_magnetization(input.bodies[0].mesh, {62e3, 0, 0});
    input.gradient = GradientInput{{{{0.2, 0, 0}, {0, -0.1, 0}, {0, 0, -0.1}}},
                                   {1.85e-3, 0.75e-3, 0.0925e-3}};
    return input;
}

TEST(Gradient, PullsADipoleAndItsWorkIsTheEnergyOfTheBody) {
    const LammpsInput input = strip_in_gradient();
    const test::SharedFolder folder;
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("run 0");
    run.command("run 1000 pre no post no");
    const double t = 1000 * input.time_step_s;
    const auto v = run.gather("v");
    const Vec3 p = test::momentum(input.bodies[0], v);
    // m dv/dt = V (M . grad) B: 62 kA/m times 0.2 T/m in the body's volume.
    const double expected = 3.7e-3 * 1.5e-3 * 0.185e-3 * 62e3 * 0.2 * t;
    const double work = run.fix_value("magttice_strip", 2);
    const double energy =
        test::kinetic_energy(input.bodies[0], v) + run.fix_value("magttice_strip", 0);
    std::printf(
        "gradient: momentum %.5f of V (M.grad) B t, work - energy %.2g of the work\n",
        p[0] / expected, energy / work - 1);
    // F M is longer than M by the strain, (62 kA/m * 0.2 T/m * L / 2) / (3 G) = 2e-4.
    EXPECT_NEAR(p[0] / expected, 1, 1e-3);
    EXPECT_NEAR(p[2] / expected, 0, 1e-3);
    // Velocity Verlet's shadow energy, as without a gradient.
    EXPECT_NEAR(energy / work, 1, 5e-3);
}

}  // namespace
}  // namespace magfsi::structure

#include <gtest/gtest.h>

#include <cmath>

#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

struct Vibration {
    double drift = 0;  // largest change of the total energy over the energy at start
    double largest_kinetic = 0;  // over the energy at start
};

// 14 ms of a strip let go from the V of 5 mT.
Vibration vibrate(int refinement) {
    LammpsInput input = test::bare_strip();
    Placement placement;
    placement.relaxed = ConstantField{5e-3, 0.8};
    input.placements = {placement};
    input.time_step_s /= refinement;
    const test::SharedFolder folder;
    const LammpsScript script = folder.write(input);
    test::LammpsRun run(MPI_COMM_WORLD, script.setup);
    run.command("run 0");
    const double start = run.fix_value("magttice_strip", 0);
    Vibration out;
    const std::string chunk =
        "run " + std::to_string(100 * refinement) + " pre no post no";
    for (int i = 0; i < 40; ++i) {
        run.command(chunk);
        const double kinetic = test::kinetic_energy(input.bodies[0], run.gather("v"));
        const double total = kinetic + run.fix_value("magttice_strip", 0);
        out.drift = std::max(out.drift, std::abs(total - start) / start);
        out.largest_kinetic = std::max(out.largest_kinetic, kinetic / start);
    }
    return out;
}

TEST(Energy, OfAFreeVibrationStaysToSecondOrder) {
    const Vibration coarse = vibrate(1);
    const Vibration fine = vibrate(2);
    std::printf(
        "free vibration, 14 ms: energy within %.2g of the start, %.2g at half the "
        "step\n",
        coarse.drift, fine.drift);
    EXPECT_GT(coarse.largest_kinetic, 0.5);  // it does swing through
    // Velocity Verlet keeps a shadow energy, off by (omega dt)^2 / 8 of the energy of
    // each mode: the stiff modes (omega dt about 1) hold less than a hundredth of it.
    EXPECT_LT(coarse.drift, 1e-3);
    // Four times less, give or take what the samples every 0.35 ms miss.
    EXPECT_LT(fine.drift, coarse.drift / 3);
}

TEST(Energy, OfAMovedBodyIsTheWorkOfTheField) {
    const LammpsInput input = test::strip_in_field();
    const test::SharedFolder folder;
    const LammpsScript script = folder.write(input);
    test::LammpsRun run(MPI_COMM_WORLD, script.setup);
    run.command("run 0");
    double largest = 0;
    double worst = 0;
    for (int chunk = 0; chunk < 40; ++chunk) {
        run.command("run 100 pre no post no");
        const double work = run.fix_value("magttice_strip", 2);
        const double energy = test::kinetic_energy(input.bodies[0], run.gather("v")) +
                              run.fix_value("magttice_strip", 0);
        largest = std::max(largest, std::abs(work));
        worst = std::max(worst, std::abs(work - energy));
    }
    std::printf("driven strip, 4000 steps: |work - energy| %.2g of %.2g J\n", worst,
                largest);
    EXPECT_GT(largest, 1e-8);
    // As above; the sudden start of the field also excites stiffer modes.
    EXPECT_LT(worst, 5e-3 * largest);
}

}  // namespace
}  // namespace magfsi::structure

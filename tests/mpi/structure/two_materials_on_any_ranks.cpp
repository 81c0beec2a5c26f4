// A beam of two materials, one of them viscous, in real LAMMPS: on one rank and on all.
#include <gtest/gtest.h>

#include <cmath>

#include "structure/lattice/stable_step.h"
#include "tests/mpi/structure/lammps_run.h"
#include "tests/unit/structure/two_materials.h"

namespace magfsi::structure {
namespace {

LammpsInput bending_bar() {
    LammpsInput input;
    Body body = test::soft_and_stiff_bar();
    body.other_materials[0].viscosity_pa_s = 0.5;
    body.magnetization_a_m = uniform_magnetization(body.mesh, {60e3, 0, 0});
    body.clamps = {"x_min"};
    input.field = FieldProgram{{0, 2}, ConstantField{10e-3, 1.5}};
    input.gravity_m_s2 = Vec3{0, 0, -9.81};
    input.time_step_s = 0.9 * stable_step_s(body);
    input.bodies = {body};
    return input;
}

TEST(TwoMaterials, GiveTheSameMotionAndSumsOnAnyRanks) {
    const LammpsInput input = bending_bar();
    const test::SharedFolder folder;
    const LammpsScript script = folder.write(input);
    test::LammpsRun alone(MPI_COMM_SELF, script.setup);
    test::LammpsRun together(MPI_COMM_WORLD, script.setup);
    for (test::LammpsRun* run : {&alone, &together}) {
        run->command("run 0");
        run->command("run 400 pre no post no");
    }
    const auto a = alone.gather("x");
    const auto b = together.gather("x");
    double apart = 0;
    double moved = 0;
    for (std::size_t q = 0; q < a.size(); ++q) {
        apart = std::max(apart, std::abs(a[q] - b[q]));
        moved =
            std::max(moved, std::abs(a[q] - input.bodies[0].mesh.nodes[q / 3][q % 3]));
    }
    EXPECT_GT(moved, 1e-5);
    // Sums of element forces in another order, rounded by 1e-18 m a step, over 400 steps.
    EXPECT_LT(apart, 1e-13 * 8e-3);
    for (int entry = 0; entry < 5; ++entry) {
        // Energies and work are small differences of larger terms.
        EXPECT_NEAR(together.fix_value("magttice_bar", entry) /
                        alone.fix_value("magttice_bar", entry),
                    1, 1e-8)
            << entry;
    }
}

// What the field and the weight have done is elastic, kinetic or lost.
TEST(TwoMaterials, KeepTheBalanceOfEnergy) {
    const LammpsInput input = bending_bar();
    const Body& body = input.bodies[0];
    const test::SharedFolder folder;
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("run 0");
    run.command("run 2000 pre no post no");
    const auto mass = node_masses(build_lattice(body));
    const auto x = run.gather("x");
    const auto v = run.gather("v");
    double kinetic = 0;
    double weight = 0;
    for (std::size_t q = 0; q < x.size(); ++q) {
        kinetic += 0.5 * mass[q / 3] * v[q] * v[q];
        if (q % 3 == 2) {
            weight -= 9.81 * mass[q / 3] * (x[q] - body.mesh.nodes[q / 3][2]);
        }
    }
    const double elastic = run.fix_value("magttice_bar", 0);
    const double work = run.fix_value("magttice_bar", 2);
    const double lost = run.fix_value("magttice_bar", 4);
    std::printf("work %.4g J, weight %.4g, elastic %.4g, kinetic %.4g, lost %.4g\n", work,
                weight, elastic, kinetic, lost);
    EXPECT_GT(lost, 1e-4 * work);
    // The loss is summed with the velocity of the half step: first order in the step
    // times the frequency of the modes that lose the energy; below 1e-2 of it.
    EXPECT_NEAR((elastic + kinetic + lost) / (work + weight), 1, 1e-2);
}

}  // namespace
}  // namespace magfsi::structure

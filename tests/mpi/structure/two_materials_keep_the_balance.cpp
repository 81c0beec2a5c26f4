// What the field and the weight do to a body of two materials is elastic, kinetic or
// lost.
#include <gtest/gtest.h>

#include "structure/lattice/lattice.h"
#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/two_material_bar.h"

namespace magfsi::structure {
namespace {

TEST(TwoMaterials, KeepTheBalanceOfEnergy) {
    const LammpsInput input = test::bending_bar();
    const Body& body = input.bodies[0];
    const test::SharedFolder folder;
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("run 0");
    run.command("run 2000 pre no post no");
    const auto mass = build_lattice(body).node_mass_kg;
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

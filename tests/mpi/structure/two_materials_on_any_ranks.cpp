// A beam of two materials, one of them viscous, in real LAMMPS: on one rank and on all.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/two_material_bar.h"

namespace magfsi::structure {
namespace {

TEST(TwoMaterials, GiveTheSameMotionAndSumsOnAnyRanks) {
    const LammpsInput input = test::bending_bar();
    const test::SharedFolder folder;
    test::AloneAndTogether runs(folder.write(input));
    runs.command("run 0");
    runs.command("run 400 pre no post no");
    auto& [alone, together] = runs;
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

}  // namespace
}  // namespace magfsi::structure

// Atoms that change ranks in the middle of a run, which only contact asks for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "structure/lammps/effects/contact/contact_law.h"
#include "structure/lammps/effects/platform/platform_law.h"
#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

// A sheet that turns about y over a rough platform while it bends: its ends change sides,
// and so do the ranks that own them.
LammpsInput tumbling_sheet() {
    LammpsInput input = test::strip_in_field();
    input.contact = ContactLaw{};
    input.platform = Platform{};
    input.platform->point_m = {0, 0, -0.2e-3};
    input.platform->friction = 0.4;
    input.gravity_m_s2 = Vec3{0, 0, -9.81};
    input.drag_rate_1_s = 20;
    const double stiffness = platform_of(input).stiffness_pa_m;
    input.time_step_s =
        0.8 * std::min(platform_step_limit_s(input.bodies[0], stiffness),
                       contact_step_limit_s(input.bodies[0], contact_law(input)));
    return input;
}

// 1000 rad/s about y through the centre.
void spin(test::LammpsRun& run) {
    run.command("variable vx atom 1000*(z-0.0925e-3)");
    run.command("variable vz atom -1000*(x-1.85e-3)");
    run.command("velocity all set v_vx 0.0 v_vz");
}

TEST(Migration, ChangesNothingInTheMotion) {
    const LammpsInput input = tumbling_sheet();
    const test::SharedFolder folder;
    const LammpsScript script = folder.write(input);
    test::LammpsRun alone(MPI_COMM_SELF, script.setup);
    test::LammpsRun together(MPI_COMM_WORLD, script.setup);
    auto before = together.owned();
    for (test::LammpsRun* run : {&alone, &together}) {
        spin(*run);
        run->command("run 0");
        run->command("run 1500 pre no post no");
    }
    auto after = together.owned();
    std::ranges::sort(before);
    std::ranges::sort(after);
    std::vector<int> arrived;
    std::ranges::set_difference(after, before, std::back_inserter(arrived));
    int here = static_cast<int>(arrived.size());
    int moved = 0;
    MPI_Allreduce(&here, &moved, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    const auto a = alone.gather("x");
    const auto b = together.gather("x");
    double apart = 0;
    for (std::size_t q = 0; q < a.size(); ++q) {
        apart = std::max(apart, std::abs(a[q] - b[q]));
    }
    std::printf(
        "%d atoms changed ranks, positions %.2g m apart, largest normal force "
        "%.3g N\n",
        moved, apart, alone.fix_value("platform", 0));
    int ranks = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    EXPECT_GT(moved, ranks > 1 ? 100 : -1);
    // 1e-10 of the length: sums in another order, grown over 1500 steps of a sheet that
    // tumbles on a platform.
    EXPECT_LT(apart, 1e-10 * 3.7e-3);
    for (int entry = 0; entry < 3; ++entry) {
        EXPECT_NEAR(alone.fix_value("platform", entry),
                    together.fix_value("platform", entry),
                    1e-7 * std::abs(alone.fix_value("platform", entry)))
            << entry;
    }
}

}  // namespace
}  // namespace magfsi::structure

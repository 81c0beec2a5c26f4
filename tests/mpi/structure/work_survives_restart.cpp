#include <gtest/gtest.h>

#include <cmath>

#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

// The script's lines for a start from a restart file, which brings the atoms, the box and
// the step number along.
std::vector<std::string> restarted(const std::vector<std::string>& lines,
                                   const std::string& file) {
    std::vector<std::string> out;
    for (const std::string& line : lines) {
        if (line.starts_with("read_data")) {
            out.push_back("read_restart " + file);
        } else if (!line.starts_with("group") && !line.starts_with("balance")) {
            out.push_back(line);
        }
    }
    return out;
}

TEST(Restart, KeepsTheWorkOfTheFieldAndTheMotion) {
    const LammpsInput input = test::strip_in_field();
    const test::SharedFolder folder;
    const LammpsScript script = folder.write(input);
    const std::string file = (folder.path() / "half.restart").string();
    test::LammpsRun whole(MPI_COMM_WORLD, script.setup);
    whole.command("run 300");
    whole.command("write_restart " + file);
    const double half = whole.fix_value("magttice_strip", 2);
    whole.command("run 300");

    test::LammpsRun second(MPI_COMM_WORLD, restarted(script.setup, file));
    second.command("run 0");
    EXPECT_EQ(second.fix_value("magttice_strip", 2), half);
    second.command("run 300");
    // The sum starts anew from its total on one rank: rounding.
    const double work = whole.fix_value("magttice_strip", 2);
    EXPECT_NEAR(second.fix_value("magttice_strip", 2), work, 1e-11 * std::abs(work));
    const auto a = whole.gather("x");
    const auto b = second.gather("x");
    // Atoms may be stored in another order, which reorders sums: rounding over 300 steps.
    for (std::size_t q = 0; q < a.size(); ++q) EXPECT_NEAR(a[q], b[q], 1e-15);
}

// Drag, a rough platform with its stick points, contact and a field: everything whose
// state is in positions, velocities and the restart file.
TEST(Restart, GoesOnAsTheUninterruptedRunWould) {
    LammpsInput input = test::strip_in_field();
    input.gravity_m_s2 = Vec3{3, 0, -9.81};
    input.drag_rate_1_s = 100;
    input.contact = ContactLaw{};
    input.platform = Platform{};
    input.platform->friction = 0.5;
    input.time_step_s *= 0.8;
    const test::SharedFolder folder;
    const LammpsScript script = folder.write(input);
    const std::string file = (folder.path() / "half.restart").string();
    test::LammpsRun whole(MPI_COMM_WORLD, script.setup);
    whole.command("run 1200");
    test::LammpsRun first(MPI_COMM_WORLD, script.setup);
    first.command("run 600");
    first.command("write_restart " + file);
    const double friction = first.fix_value("platform", 1);
    EXPECT_GT(friction, 0);

    test::LammpsRun second(MPI_COMM_WORLD, restarted(script.setup, file));
    second.command("run 0");
    // Springs stretched by 1 nm between positions of mm, which are rounded to 1e-19 m.
    EXPECT_NEAR(second.fix_value("platform", 1) / friction, 1, 1e-9);
    second.command("run 600");
    const auto a = whole.gather("x");
    const auto b = second.gather("x");
    const auto u = whole.gather("v");
    const auto v = second.gather("v");
    double apart = 0;
    double apart_v = 0;
    double fastest = 0;
    for (std::size_t q = 0; q < a.size(); ++q) {
        apart = std::max(apart, std::abs(a[q] - b[q]));
        apart_v = std::max(apart_v, std::abs(u[q] - v[q]));
        fastest = std::max(fastest, std::abs(u[q]));
    }
    std::printf("restarted: %.2g m and %.2g of %.2g m/s apart\n", apart, apart_v,
                fastest);
    // Rounding of forces whose sums run in another order, over 600 steps; a node that
    // touches a step earlier or later would show as 1e-9 m.
    EXPECT_LT(apart, 1e-13 * 3.7e-3);
    EXPECT_LT(apart_v, 1e-10 * fastest);
}

TEST(FixModify, SetsTheWork) {
    const test::SharedFolder folder;
    const LammpsScript script = folder.write(test::strip_in_field());
    test::LammpsRun run(MPI_COMM_WORLD, script.setup);
    run.command("fix_modify magttice_strip work 1.25e-7");
    run.command("run 0");
    EXPECT_EQ(run.fix_value("magttice_strip", 2), 1.25e-7);
}

}  // namespace
}  // namespace magfsi::structure

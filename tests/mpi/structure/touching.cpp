// SPDX-License-Identifier: GPL-2.0-or-later
// What bodies touch: each other with friction, and solid shapes that do not move.
#include <gtest/gtest.h>

#include <cmath>

#include "structure/lattice/lattice.h"
#include "structure/lattice/stable_step.h"
#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"
#include "tests/support/stl_surfaces.h"

namespace magfsi::structure {
namespace {

void take_stable_step(LammpsInput& input) {
    const Body& body = input.bodies[0];
    input.time_step_s = 0.8 * step_limit_s(body, surface_spring_pa_m(input, body));
}

// The upper of two crossed sheets falls obliquely on the lower.
LammpsInput rubbing_sheets() {
    LammpsInput input = test::crossed_strips(0.385e-3);
    input.contact->friction = 0.5;
    take_stable_step(input);
    return input;
}

constexpr const char* thrown = "velocity upper set 0.4 0 -0.4";
constexpr int lost_to_friction = 3;

TEST(Rubbing, KeepsMomentumAndTakesWhatItSays) {
    const LammpsInput input = rubbing_sheets();
    const Body& sheet = input.bodies[0];
    const std::size_t nodes = sheet.mesh.nodes.size();
    test::Run run(input, {thrown});
    const auto v0 = run.gather("v");
    const double start = test::kinetic_energy(sheet, v0, nodes);
    double lost = 0, drift = 0;
    for (int chunk = 0; chunk < 40; ++chunk) {
        run.steps(20);
        const auto v = run.gather("v");
        EXPECT_GE(run.compute_value("contact", lost_to_friction), lost);
        lost = run.compute_value("contact", lost_to_friction);
        const double energy =
            test::kinetic_energy(sheet, v) + test::kinetic_energy(sheet, v, nodes) +
            run.compute_value("contact", 0) + run.fix_value("magttice_strip", 0) +
            run.fix_value("magttice_upper", 0);
        drift = std::max(drift, std::abs(energy + lost - start));
    }
    const auto v = run.gather("v");
    const Vec3 lower = test::momentum(sheet, v), upper = test::momentum(sheet, v, nodes);
    const Vec3 before = test::momentum(sheet, v0, nodes);
    for (const std::size_t d : {0U, 2U})
        EXPECT_NEAR((lower[d] + upper[d]) / before[d], 1, 1e-11);
    EXPECT_GT(lower[0] / before[0], 0.02);  // dragged along
    EXPECT_GT(lost, 0.01 * start);
    // As without friction, of the kinks of the force (surfaces.cpp).
    EXPECT_LT(drift, 0.01 * start);
}

TEST(Rubbing, IsTheSameOnAnyRanks) {
    test::AloneAndTogether runs(rubbing_sheets());
    for (const char* line : {"run 0", thrown, "run 400 pre no post no"})
        runs.command(line);
    // Rounding over 400 steps, in which nodes that touch a step apart would show as 1e-8.
    EXPECT_LT(runs.largest_difference("x"), 1e-12 * 3.7e-3);
    const double lost = runs.alone.compute_value("contact", lost_to_friction);
    EXPECT_GT(lost, 0);
    EXPECT_NEAR(runs.together.compute_value("contact", lost_to_friction) / lost, 1, 1e-9);
}

// What sticks is in LAMMPS's restart file: the second half from there is that of a whole
// run. stored: what the springs hold at half of it.
void expect_same_over_a_restart(const LammpsInput& input, const std::string& thrown_by,
                                double (*stored)(test::LammpsRun&)) {
    const test::SharedScript script(input);
    const std::string file = (script.folder() / "half.restart").string();
    test::LammpsRun whole(MPI_COMM_WORLD, script.lines());
    for (const std::string& line : {thrown_by, std::string("run 400"),
                                    "write_restart " + file, std::string("run 0")})
        whole.command(line);
    const double at_half = stored(whole);
    EXPECT_GT(at_half, 0);
    whole.command("run 200");

    std::vector<std::string> lines;
    for (const std::string& line : script.lines()) {
        if (line.starts_with("read_data"))
            lines.push_back("read_restart " + file);
        else if (!line.starts_with("group") && !line.starts_with("balance"))
            lines.push_back(line);
    }
    test::LammpsRun second(MPI_COMM_WORLD, lines);
    second.command("run 0");
    EXPECT_NEAR(stored(second) / at_half, 1, 1e-9);
    second.command("run 200");
    EXPECT_LT(test::largest_difference(whole.gather("x"), second.gather("x")),
              1e-12 * 3.7e-3);
}

TEST(Rubbing, GoesOnOverARestart) {
    expect_same_over_a_restart(rubbing_sheets(), thrown, [](test::LammpsRun& run) {
        return run.compute_value("contact", 0);
    });
}

// --- solid shapes

LammpsInput sheet_on(const SolidShape& shape, double friction = 0) {
    LammpsInput input = test::bare_strip();
    if (friction > 0) {
        input.contact = ContactLaw{};
        input.contact->friction = friction;
    }
    input.walls.push_back({"post", {}, shape, {0}});
    take_stable_step(input);
    return input;
}

// Thrown down, off the middle. Where the nodes are then; the energy's drift over it.
std::vector<double> thrown_on(const SolidShape& shape, int chunks, double& drift) {
    const LammpsInput input = sheet_on(shape);
    const Body& sheet = input.bodies[0];
    test::Run run(input, {"velocity all set 0 0 -0.3"});
    const double start = test::kinetic_energy(sheet, run.gather("v"));
    double most = 0;
    drift = 0;
    for (int chunk = 0; chunk < chunks; ++chunk) {
        run.steps(25);
        const double pressed = run.fix_scalar("wall_post");
        const double energy = test::kinetic_energy(sheet, run.gather("v")) + pressed +
                              run.fix_value("magttice_strip", 0);
        most = std::max(most, pressed / start);
        drift = std::max(drift, std::abs(energy / start - 1));
    }
    EXPECT_GT(most, 1e-3);
    return run.gather("x");
}

struct Files : test::SharedScript {
    Files() : SharedScript(test::bare_strip()) {}
    Surface surface(const magfsi::test::Triangles& triangles) {
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        const auto file = folder() / "shape.stl";
        MPI_Barrier(MPI_COMM_WORLD);
        if (rank == 0) magfsi::test::write_stl(file, triangles);
        MPI_Barrier(MPI_COMM_WORLD);
        return read_surface(file, 1, {});
    }
};

// The lowest corner of the sheet is the origin.
TEST(Solid, BrickOfTrianglesIsTheBrick) {
    Files files;
    const Brick brick{{1.3e-3, 0.3e-3, -0.5e-3}, {2.1e-3, 1.1e-3, -0.05e-3}};
    const auto triangles =
        files.surface(magfsi::test::brick_surface(brick.low_m, brick.high_m));
    double drift = 0;
    thrown_on(brick, 20, drift);
    EXPECT_LT(drift, 0.01);
    // Rounding, 1e-19 m a step, over the 300 steps in which the sheet lands: 2e-17 m, and
    // a margin of 20. While it wraps itself about the brick afterwards, rounding grows by
    // a factor of three to six in every 50 steps, on other processors by another one.
    EXPECT_LT(test::largest_difference(thrown_on(brick, 12, drift),
                                       thrown_on(triangles, 12, drift)),
              1e-13 * 3.7e-3);
}

TEST(Solid, BallOfTrianglesConvergesToTheBall) {
    Files files;
    const Ball ball{{1.7e-3, 0.7e-3, -1.05e-3}, 1e-3};
    double drift = 0;
    const auto smooth = thrown_on(ball, 40, drift);
    EXPECT_LT(drift, 0.01);
    std::vector<double> apart;
    for (const int n : {8, 16, 32}) {
        const auto found = thrown_on(
            files.surface(magfsi::test::ball_surface(ball.centre_m, ball.radius_m, n)),
            40, drift);
        apart.push_back(test::largest_difference(smooth, found));
        EXPECT_LT(drift, 0.01);
    }
    // Distances are right to the square of the triangles' edges (unit test), directions
    // to the first power.
    EXPECT_LT(apart[2], apart[0] / 4);
    EXPECT_LT(apart[2], 0.01 * 0.3 * 1000 * sheet_on(ball).time_step_s);
}

TEST(Solid, PushesTheSameOnAnyRanks) {
    Files files;
    const auto triangles =
        magfsi::test::ball_surface({1.7e-3, 0.7e-3, -1.05e-3}, 1e-3, 8);
    test::AloneAndTogether runs(sheet_on(files.surface(triangles), 0.4));
    for (const char* line : {"velocity all set 0.2 0 -0.3", "run 500"})
        runs.command(line);
    EXPECT_GT(runs.alone.fix_scalar("wall_post"), 0);
    const double lost = runs.alone.fix_value("wall_post", 0);
    EXPECT_GT(lost, 0);
    EXPECT_NEAR(runs.together.fix_value("wall_post", 0) / lost, 1, 1e-9);
    EXPECT_LT(runs.largest_difference("x"), 1e-12 * 3.7e-3);
}

TEST(Solid, RubsOnOverARestart) {
    const Ball ball{{1.7e-3, 0.7e-3, -1.05e-3}, 1e-3};
    expect_same_over_a_restart(
        sheet_on(ball, 0.4), "velocity all set 0.2 0 -0.3",
        [](test::LammpsRun& run) { return run.fix_scalar("wall_post"); });
}

}  // namespace
}  // namespace magfsi::structure

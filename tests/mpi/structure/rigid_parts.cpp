// SPDX-License-Identifier: GPL-2.0-or-later
// Rigid parts in real LAMMPS: what their nodes do, beside soft elements and on ranks.
#include <gtest/gtest.h>

#include <cmath>

#include "structure/lattice/rigid_mass.h"
#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"
#include "tests/support/checks.h"

namespace magfsi::structure {
namespace {

// A bar of 6 x 2 x 2 elements, magnetised along itself, whose last third is rigid.
LammpsInput bar_with_a_rigid_end() {
    LammpsInput input;
    Body body;
    body.name = "bar";
    body.mesh = box_mesh({{6e-3, 1e-3, 1e-3}, {6, 2, 2}});
    body.material = {100e3, 400e3, 1200};
    body.magnetization_a_m = uniform_magnetization(body.mesh, {40e3, 0, 0});
    body.rigid_parts = {{"end", {}}};
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e)
        body.element_rigid.push_back(e % 6 < 4 ? -1 : 0);
    input.bodies = {body};
    input.field = FieldProgram{{0, 2}, ConstantField{5e-3, 1.2}};
    input.time_step_s = 0.9 * stable_step_s(body);
    return input;
}

LammpsInput free_brick() {
    LammpsInput input = bar_with_a_rigid_end();
    Body& body = input.bodies[0];
    body.material = {0, 0, 1200};
    body.element_rigid.assign(body.mesh.elements.size(), 0);
    input.field.reset();
    input.time_step_s = 1e-5;
    Placement start;
    start.velocity_m_s = Vec3{0.1, 0.02, 0};
    start.angular_velocity_rad_s = Vec3{30, 60, -20};
    input.placements = {start};
    return input;
}

// Largest change of a distance between nodes of the rigid end, over the distance.
double stretched(const LammpsInput& input, const std::vector<double>& now) {
    const Body& body = input.bodies[0];
    const auto part = rigid_part_of_nodes(body);
    double worst = 0;
    for (std::size_t a = 0; a < part.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            if (part[a] < 0 || part[b] < 0) continue;
            const double then = distance_m(body.mesh.nodes[a], body.mesh.nodes[b]);
            const double is = distance_m(vector_at(&now[3 * a]), vector_at(&now[3 * b]));
            worst = std::max(worst, std::abs(is / then - 1));
        }
    }
    return worst;
}

TEST(RigidParts, KeepTheirShapeWhileTheRestBends) {
    const LammpsInput input = bar_with_a_rigid_end();
    test::Run run(input);
    run.steps(3000);
    EXPECT_LT(stretched(input, run.gather("x")), 1e-12);
    // The soft end has bent: its far nodes are nearer to or farther from the rigid end.
    const auto x = run.gather("x");
    EXPECT_GT(distance_m(vector_at(&x[0]), input.bodies[0].mesh.nodes[0]), 1e-5);
}

// A uniform field gives no force: momentum stays zero, with the rigid end's mass and what
// it shares with soft elements.
TEST(RigidParts, AndTheSoftRestKeepMomentum) {
    const LammpsInput input = bar_with_a_rigid_end();
    test::Run run(input);
    double largest = 0, fastest = 0;
    for (int i = 0; i < 10; ++i) {
        run.steps(200);
        const auto v = run.gather("v");
        largest = std::max(largest, norm(test::momentum(input.bodies[0], v)));
        for (const double one : v) fastest = std::max(fastest, std::abs(one));
    }
    EXPECT_GT(fastest, 1e-3);
    EXPECT_LT(largest, 1e-11 * 1200 * 6e-9 * fastest);
}

// The work of the field is the energy of all, with the inertia of the end's solid: masses
// at its nodes alone would leave a residual of first order.
TEST(RigidParts, TakeTheWorkOfTheField) {
    const LammpsInput input = bar_with_a_rigid_end();
    test::Run run(input);
    const Body& body = input.bodies[0];
    const auto part = rigid_part_of_nodes(body);
    const auto mass = build_lattice(body).node_mass_kg;
    double largest = 0, worst = 0;
    for (int chunk = 0; chunk < 20; ++chunk) {
        run.steps(100);
        const auto v = run.gather("v");
        double kinetic = run.fix_scalar("rigid");
        for (std::size_t n = 0; n < mass.size(); ++n)
            if (part[n] < 0)
                for (int d = 0; d < 3; ++d)
                    kinetic += 0.5 * mass[n] * v[3 * n + d] * v[3 * n + d];
        const double work = run.fix_value("magttice_bar", 2);
        const double energy = kinetic + run.fix_value("magttice_bar", 0);
        largest = std::max(largest, std::abs(work));
        worst = std::max(worst, std::abs(work - energy));
    }
    EXPECT_GT(largest, 1e-10);
    EXPECT_LT(worst, 5e-3 * largest);  // as of a soft body, Energy.OfAMovedBody...
}

// Spun in LAMMPS, without a force.
TEST(RigidParts, FreelyTurningKeepEnergyAndPlace) {
    const LammpsInput input = free_brick();
    test::Run run(input);
    const double energy = run.fix_scalar("rigid");
    run.steps(20000);
    EXPECT_NEAR(run.fix_scalar("rigid") / energy, 1, 1e-9);
    EXPECT_LT(stretched(input, run.gather("x")), 1e-12);
    // The mean of all nodes is the centre of the brick.
    const auto x = run.gather("x");
    Vec3 mean{};
    for (std::size_t n = 0; n < x.size(); n += 3) mean += vector_at(&x[n]);
    mean /= static_cast<double>(x.size() / 3);
    EXPECT_NEAR(mean[0], 3e-3 + 0.1 * 0.2, 1e-12);
    EXPECT_NEAR(mean[1], 0.5e-3 + 0.02 * 0.2, 1e-12);
}

TEST(RigidParts, FallAndSlowDownAsTheirMassSays) {
    LammpsInput input = free_brick();
    input.gravity_m_s2 = Vec3{0, 0, -9.81};
    input.drag = Drag{25};
    test::Run run(input);
    const double energy = run.fix_scalar("rigid");
    run.steps(4000);
    // v(t) = g / rate (1 - e^(-rate t)); the turn decays by e^(-2 rate t) in its energy.
    const double t = 4000e-5, decay = std::exp(-25 * t);
    const auto v = run.gather("v");
    Vec3 mean{};
    for (std::size_t n = 0; n < v.size(); n += 3) mean += vector_at(&v[n]);
    mean /= static_cast<double>(v.size() / 3);
    // Push and decay are split: first order in rate times step, 2.5e-4.
    EXPECT_NEAR(mean[2] / (-9.81 / 25 * (1 - decay)), 1, 5e-4);
    EXPECT_NEAR(mean[0] / (0.1 * decay), 1, 1e-9);
    const double mass = 1200 * 6e-9;
    const double turning = energy - 0.5 * mass * (0.01 + 0.0004);
    const double fallen = 0.5 * mass * dot(mean, mean);
    EXPECT_NEAR((run.fix_scalar("rigid") - fallen) / (turning * decay * decay), 1, 1e-4);
}

TEST(RigidParts, AreTheSameOnAnyRanks) {
    for (const LammpsInput& input : {bar_with_a_rigid_end(), free_brick()}) {
        test::AloneAndTogether runs(input);
        runs.command("run 500");
        EXPECT_LT(runs.largest_difference("x"), 1e-12);
        EXPECT_LT(runs.largest_difference("v"), 1e-9);
    }
}

TEST(RigidParts, GoOnFromARestartFileOfLammps) {
    const LammpsInput input = bar_with_a_rigid_end();
    test::SharedScript script(input);
    const std::string file = (script.folder() / "state").string();
    test::LammpsRun first(MPI_COMM_WORLD, script.lines());
    first.command("run 300");
    first.command("write_restart " + file);
    first.command("run 200");
    std::vector<std::string> lines = script.lines();
    for (std::string& line : lines)
        if (line.starts_with("read_data")) line = "read_restart " + file;
    std::erase_if(lines, [](const std::string& line) {
        return line.starts_with("group") || line.starts_with("balance");
    });
    test::LammpsRun second(MPI_COMM_WORLD, lines);
    second.command("run 200");
    EXPECT_LT(test::largest_difference(first.gather("x"), second.gather("x")), 1e-13);
}

}  // namespace
}  // namespace magfsi::structure

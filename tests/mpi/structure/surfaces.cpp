// SPDX-License-Identifier: GPL-2.0-or-later
// Surfaces that meet: of two bodies, of one body that folds, and of a body and a
// platform.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "structure/lammps/effects/contact/contact_law.h"
#include "structure/lammps/platform_law.h"
#include "structure/lattice/stable_step.h"
#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

double contact_step_limit_s(const LammpsInput& input) {
    const Body& body = input.bodies[0];
    return step_limit_s(body, contact_spring_pa_m(body, contact_law(input)));
}

double platform_step_limit_s(const LammpsInput& input) {
    return step_limit_s(input.bodies[0],
                        with_stiffness(*input.platform, input.bodies).stiffness_pa_m);
}

// Two sheets across each other, 0.4 mm apart.
LammpsInput crossed_sheets() {
    LammpsInput input = test::crossed_strips(0.585e-3);
    input.time_step_s = 0.9 * contact_step_limit_s(input);
    return input;
}

TEST(Contact, OfTwoSheetsConservesMomentumAndEnergyAndLetsNothingThrough) {
    const LammpsInput input = crossed_sheets();
    const Body& sheet = input.bodies[0];
    const std::size_t nodes = sheet.mesh.nodes.size();
    test::Run run(input, {"velocity upper set 0 0 -0.5"});
    const auto v0 = run.gather("v");
    const double start = test::kinetic_energy(sheet, v0, nodes);
    double most = 0, closest = 1, drift = 0;
    for (int chunk = 0; chunk < 60; ++chunk) {
        run.steps(20);
        const auto v = run.gather("v");
        const double kinetic =
            test::kinetic_energy(sheet, v) + test::kinetic_energy(sheet, v, nodes);
        const double contact = run.compute_value("contact", 0);
        most = std::max(most, contact);
        closest = std::min(closest, run.compute_value("contact", 2));
        drift = std::max(drift,
                         std::abs(kinetic + contact + run.fix_value("magttice_strip", 0) +
                                  run.fix_value("magttice_upper", 0) - start));
    }
    const auto v = run.gather("v");
    const Vec3 lower = test::momentum(sheet, v);
    const Vec3 upper = test::momentum(sheet, v, nodes);
    const double momentum = test::momentum(sheet, v0, nodes)[2];
    EXPECT_GT(most, 0.01 * start);  // sheets bend more easily than contact gives way
    // The contact's force has kinks at its distance, where velocity Verlet loses its
    // order.
    EXPECT_LT(drift, 0.01 * start);
    EXPECT_GT(closest, 0.05e-3);
    EXPECT_GT(lower[2] / momentum, 0.3);
    // Pair forces are opposite to the last bit; sums over 1134 nodes and 1200 steps.
    EXPECT_NEAR((lower[2] + upper[2]) / momentum, 1, 1e-11);
}

// Centres of the two end faces of a C: left minus right, along x.
double ends_apart(const Body& body, const std::vector<double>& x) {
    double out = 0;
    for (const auto& [face, sign] : {std::pair{"x_min", -1.0}, std::pair{"x_max", 1.0}}) {
        const auto& nodes = body.mesh.faces.at(face);
        for (int node : nodes) {
            out += sign * x[3 * static_cast<std::size_t>(node)] /
                   static_cast<double>(nodes.size());
        }
    }
    return out;
}

double folded_end_distance(bool contact, double& closest_m) {
    LammpsInput input = test::strip_in_field();
    input.field = FieldProgram{{0, 2}, ConstantField{0.06, 4.0}};
    input.drag = Drag{300};
    if (contact) {
        input.contact = ContactLaw{};
        input.time_step_s = 0.9 * contact_step_limit_s(input);
    }
    test::Run run(input);
    double nearest = 1;
    closest_m = 1;
    for (int chunk = 0; chunk < 50; ++chunk) {
        run.steps(200);
        nearest = std::min(nearest, ends_apart(input.bodies[0], run.gather("x")));
        if (contact) closest_m = std::min(closest_m, run.compute_value("contact", 2));
    }
    return nearest;
}

TEST(Contact, KeepsTheEndsOfAFoldedSheetApart) {
    double closest = 0, ignored = 0;
    const double without = folded_end_distance(false, ignored);
    const double with = folded_end_distance(true, closest);
    EXPECT_LT(without, 0);  // they pass through each other
    EXPECT_GT(with, 0);
    EXPECT_GT(closest, 0.02e-3);
}

// --- platform

constexpr double mass_kg = 1860 * 3.7e-3 * 1.5e-3 * 0.185e-3;
constexpr double gravity_m_s2 = 9.81;

// The platform rises by `tilt` towards x; seen from it, gravity is tilted.
LammpsInput lying_strip(double tilt, double friction) {
    LammpsInput input = test::bare_strip();
    input.gravity_m_s2 =
        Vec3{gravity_m_s2 * std::sin(tilt), 0, -gravity_m_s2 * std::cos(tilt)};
    input.platform = Platform{};
    input.platform->friction = friction;
    // About critical for the sheet on the platform's springs (75 krad/s), so that it
    // comes to rest on it within the first milliseconds.
    input.platform->damping_pa_s_m = 2e4;
    input.time_step_s = 0.9 * platform_step_limit_s(input);
    return input;
}

TEST(Platform, CarriesTheWeightAndGivesWayByLessThanAHundredthOfTheThickness) {
    LammpsInput input = lying_strip(0, 0);
    input.drag = Drag{500};  // takes the energy of bending waves, of 1 krad/s and more
    test::Run run(input);
    run.steps(10000);
    const double weight = mass_kg * gravity_m_s2;
    const double normal = run.fix_value("platform", 0);
    const double gap = run.fix_value("platform", 3);
    // 30 ms at 250 / s leave e^-8 of the vibrations.
    EXPECT_NEAR(normal / weight, 1, 1e-3);
    EXPECT_NEAR(run.fix_value("platform", 6) / normal, 1, 1e-12);
    EXPECT_LT(gap, 0);
    EXPECT_GT(gap, -0.01 * 0.185e-3);
    // Weight per area over stiffness, k/2 penetration^2: edges, whose areas count their
    // two faces, sink in less than the middle, corners least.
    EXPECT_GT(run.fix_value("platform", 2), 0.25 * weight * -gap);
    EXPECT_LT(run.fix_value("platform", 2), 0.55 * weight * -gap);
}

// Mean distance along x in 4000 steps after the sheet has settled, beyond what its speed
// then makes of them.
double slid_m(double tilt, double friction, double& time_s) {
    const LammpsInput input = lying_strip(tilt, friction);
    test::Run run(input);
    run.steps(2000);  // settles
    const auto start = run.gather("x");
    const auto v = run.gather("v");
    run.steps(4000);
    const auto end = run.gather("x");
    time_s = 4000 * input.time_step_s;
    double moved = 0;
    for (std::size_t q = 0; q < end.size(); q += 3) {
        moved +=
            (end[q] - start[q] - v[q] * time_s) / static_cast<double>(end.size() / 3);
    }
    return moved;
}

TEST(Friction, HoldsBelowItsAngleAndSlidesAboveByCoulombsLaw) {
    constexpr double degree = std::numbers::pi / 180;
    double time = 0;
    const double held = slid_m(20 * degree, 0.5, time);
    const double slid = slid_m(40 * degree, 0.5, time);
    const double expected = 0.5 * time * time * gravity_m_s2 *
                            (std::sin(40 * degree) - 0.5 * std::cos(40 * degree));
    // tan 20 = 0.36 < 0.5: only what is left of the vibration of the springs.
    EXPECT_LT(std::abs(held), 1e-4 * expected);
    // The weight presses the springs by 2 nm only, so that a sliding, vibrating sheet
    // hops: a node's friction is that of the end of the step in which it lands, and the
    // hops are not over when the interval begins.
    EXPECT_NEAR(slid / expected, 1, 0.05);
}

// --- atoms that change ranks in the middle of a run, which plain scripts may ask for

// A sheet that turns about y over a rough platform while it bends: its ends change sides,
// and so do the ranks that own them.
LammpsInput tumbling_sheet() {
    LammpsInput input = test::strip_in_field();
    input.contact = ContactLaw{};
    input.platform = Platform{};
    input.platform->point_m = {0, 0, -0.2e-3};
    input.platform->friction = 0.4;
    input.gravity_m_s2 = Vec3{0, 0, -9.81};
    input.drag = Drag{20};
    input.time_step_s =
        0.8 * std::min(platform_step_limit_s(input), contact_step_limit_s(input));
    return input;
}

TEST(Migration, ChangesNothingInTheMotion) {
    test::AloneAndTogether runs(tumbling_sheet());
    test::LammpsRun& alone = runs.alone;
    test::LammpsRun& together = runs.together;
    const auto before = together.owned();
    for (const char* line :
         {"neigh_modify once no every 1 delay 0 check yes", "neighbor 0.1e-3 bin"})
        runs.command(line);
    for (const char* line :
         // 1000 rad/s about y through the centre
         {"variable vx atom 1000*(z-0.0925e-3)", "variable vz atom -1000*(x-1.85e-3)",
          "velocity all set v_vx 0.0 v_vz", "run 0", "run 1500 pre no post no"})
        runs.command(line);
    std::vector<int> arrived;
    std::ranges::set_difference(together.owned(), before, std::back_inserter(arrived));
    int here = static_cast<int>(arrived.size());
    int moved = 0;
    MPI_Allreduce(&here, &moved, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    const double apart = runs.largest_difference("x");
    int ranks = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    EXPECT_GT(moved, ranks > 1 ? 100 : -1);
    // 1e-10 of the length: sums in another order, grown over 1500 steps of a sheet that
    // tumbles on a platform.
    EXPECT_LT(apart, 1e-10 * 3.7e-3);
    for (int entry = 0; entry < 3; ++entry) {
        const double a = alone.fix_value("platform", entry);
        EXPECT_NEAR(together.fix_value("platform", entry), a, 1e-7 * std::abs(a))
            << entry;
    }
}

// --- how far from equilibrium

LammpsInput cantilever() {
    LammpsInput input = test::strip_in_field();
    input.bodies[0].clamps = {"x_min"};
    input.field = FieldProgram{{0, 2}, ConstantField{2e-3, 1.0}};
    input.gravity_m_s2 = Vec3{0, 0, -9.81};
    input.drag = Drag{220};  // twice the lowest frequency, 112 rad/s
    input.quiet = true;
    return input;
}

TEST(Quiet, StartsAtOneWhereNothingIsStrained) {
    test::Run run(cantilever());
    const double force = run.fix_value("quiet", 0);
    EXPECT_GT(force, 0);
    // Elastic forces at rest are rounding: 1e-16 of G times a face over nodes of 1e-10 N.
    EXPECT_NEAR(run.fix_value("quiet", 1) / force, 1, 1e-6);
}

TEST(Quiet, HaltsARunInTheEquilibrium) {
    test::Run run(cantilever(),
                  {"variable unrest equal f_quiet",
                   "fix stop all halt 500 v_unrest < 1e-3 error continue message no"});
    run.command("run 100000 post no");
    const double ratio = run.fix_value("quiet", 0) / run.fix_value("quiet", 1);
    EXPECT_LT(ratio, 1e-3);
    EXPECT_EQ(run.variable("unrest"), ratio);
    const auto x = run.gather("x");
    run.command("unfix stop");
    run.command("run 30000 post no");
    const auto later = run.gather("x");
    double moved = 0, bent = 0;
    for (std::size_t q = 2; q < x.size(); q += 3) {
        moved = std::max(moved, std::abs(later[q] - x[q]));
        bent = std::max(bent, std::abs(later[q] - 0.185e-3));
    }
    // The slowest mode's share of the force is small against that of a stiff one: a ratio
    // of 1e-3 leaves more than 1e-3 of the displacement.
    EXPECT_LT(moved, 0.05 * bent);
}

}  // namespace
}  // namespace magfsi::structure

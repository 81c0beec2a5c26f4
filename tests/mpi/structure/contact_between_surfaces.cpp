// Surfaces that meet: of two bodies, and of one body that folds.
#include <gtest/gtest.h>

#include <cmath>

#include "structure/lammps/effects/contact/contact_law.h"
#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

// Two sheets across each other, 0.4 mm apart.
LammpsInput crossed_sheets() {
    LammpsInput input = test::bare_strip();
    input.bodies.push_back(input.bodies[0]);
    input.bodies[1].name = "upper";
    input.placements.resize(2);
    input.placements[0].position_m = Vec3{0, 0, 0};
    input.placements[1].position_m = Vec3{0.2e-3, 0.1e-3, 0.585e-3};
    input.placements[1].rotation = PlaneRotation{{0, 1}, 1.2};
    input.contact = ContactLaw{};
    input.time_step_s = 0.9 * contact_step_limit_s(input.bodies[0], contact_law(input));
    return input;
}

TEST(Contact, OfTwoSheetsConservesMomentumAndEnergyAndLetsNothingThrough) {
    const LammpsInput input = crossed_sheets();
    const test::SharedFolder folder;
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("velocity upper set 0 0 -0.5");
    run.command("run 0");
    const std::size_t nodes = input.bodies[0].mesh.nodes.size();
    const auto v0 = run.gather("v");
    const double start =
        test::kinetic_energy(input.bodies[0], {v0.begin() + 3 * 567, v0.end()});
    double most = 0;
    double closest = 1;
    double drift = 0;
    for (int chunk = 0; chunk < 60; ++chunk) {
        run.command("run 20 pre no post no");
        const auto v = run.gather("v");
        const double kinetic =
            test::kinetic_energy(input.bodies[0], {v.begin(), v.begin() + 3 * 567}) +
            test::kinetic_energy(input.bodies[0], {v.begin() + 3 * 567, v.end()});
        const double contact = run.compute_value("contact", 0);
        most = std::max(most, contact);
        closest = std::min(closest, run.compute_value("contact", 2));
        drift = std::max(drift,
                         std::abs(kinetic + contact + run.fix_value("magttice_strip", 0) +
                                  run.fix_value("magttice_upper", 0) - start));
    }
    const auto v = run.gather("v");
    const Vec3 lower = test::momentum(input.bodies[0], v);
    const Vec3 upper = test::momentum(input.bodies[0], v, nodes);
    const double momentum = test::momentum(input.bodies[0], v0, nodes)[2];
    std::printf(
        "two sheets: contact takes %.2g of the energy, energy within %.2g, "
        "closest nodes %.3g m, momentum handed over %.3f, error %.2g\n",
        most / start, drift / start, closest, lower[2] / momentum,
        (lower[2] + upper[2]) / momentum - 1);
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
    input.drag_rate_1_s = 300;
    if (contact) {
        input.contact = ContactLaw{};
        input.time_step_s =
            0.9 * contact_step_limit_s(input.bodies[0], contact_law(input));
    }
    const test::SharedFolder folder;
    test::LammpsRun run(MPI_COMM_WORLD, folder.write(input).setup);
    run.command("run 0");
    double nearest = 1;
    closest_m = 1;
    for (int chunk = 0; chunk < 50; ++chunk) {
        run.command("run 200 pre no post no");
        nearest = std::min(nearest, ends_apart(input.bodies[0], run.gather("x")));
        if (contact) closest_m = std::min(closest_m, run.compute_value("contact", 2));
    }
    return nearest;
}

TEST(Contact, KeepsTheEndsOfAFoldedSheetApart) {
    double closest = 0;
    double ignored = 0;
    const double without = folded_end_distance(false, ignored);
    const double with = folded_end_distance(true, closest);
    std::printf(
        "folded sheet, ends apart: %.3g m without contact, %.3g m with it, "
        "closest nodes %.3g m\n",
        without, with, closest);
    EXPECT_LT(without, 0);  // they pass through each other
    EXPECT_GT(with, 0);
    EXPECT_GT(closest, 0.02e-3);
}

}  // namespace
}  // namespace magfsi::structure

// SPDX-License-Identifier: GPL-2.0-or-later
// The tether's law: under its weight a body that N springs of stiffness k hold swings as
// u = g / w^2 (1 - cos w t), w^2 = N k / m; and without the setting there is no command.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docs/examples/tether/tether.h"
#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

TEST(Tether, LetsABodySwingUnderItsWeight) {
    LammpsInput input = test::bare_strip();
    input.gravity_m_s2 = Vec3{0, 0, -9.81};
    const auto masses = build_lattice(input.bodies[0]).node_mass_kg;
    double mass = 0;
    for (const double m : masses) mass += m;
    const double omega = 500;
    tether_n_m = mass * omega * omega / static_cast<double>(masses.size());
    test::Run run(input);
    const auto start = run.gather("x");
    const double half_swing = std::numbers::pi / omega;
    run.steps(static_cast<int>(half_swing / input.time_step_s));
    const auto now = run.gather("x");
    double sunk = 0;
    for (std::size_t a = 0; a < masses.size(); ++a)
        sunk += masses[a] * (start[3 * a + 2] - now[3 * a + 2]) / mass;
    // Nodes of edges and corners have less mass and the same spring: the strip bends by
    // some percent of the swing.
    EXPECT_NEAR(sunk / (2 * 9.81 / (omega * omega)), 1, 0.05);
}

TEST(Tether, IsAbsentUnlessAskedFor) {
    const auto has_tether = [] {
        return std::ranges::any_of(
            test::SharedScript(test::bare_strip()).lines(),
            [](const std::string& line) { return line.starts_with("fix tether"); });
    };
    tether_n_m.reset();
    EXPECT_FALSE(has_tether());
    tether_n_m = 1;
    EXPECT_TRUE(has_tether());
}

}  // namespace
}  // namespace magfsi::structure

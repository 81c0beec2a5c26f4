// SPDX-License-Identifier: GPL-2.0-or-later
// The laws of one node on a platform and of two nodes in contact.
#include <gtest/gtest.h>
#include <cmath>
#include <fstream>
#include <numbers>
#include "structure/lammps/effects/contact/contact_law.h"
#include "structure/lammps/lattice_file.h"
#include "structure/lammps/platform_law.h"
#include "tests/support/checks.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

constexpr double at_rest[3] = {0, 0, 0};

Platform rough() {
    return {{1e-3, 0, 2e-3}, {0, 0.6, 0.8}, 1e9, 0.5, 0};
}

PlatformContact touch(const Platform& platform, const double* x, StickPoint& stick,
                      const double* v = at_rest) {
    return platform_contact(platform, 3e-8, x, v, 0, stick);
}

TEST(PlatformLaw, ForceIsMinusTheGradientOfItsEnergyWhileItSticks) {
    const Platform platform = rough();
    StickPoint stick;
    const double first[3] = {0, 1e-4, 1.9e-3};
    touch(platform, first, stick);
    double x[3] = {1e-6, 1.01e-4, 1.899e-3};
    const PlatformContact here = touch(platform, x, stick);
    for (int d = 0; d < 3; ++d) {
        const double h = 1e-9;
        const double middle = x[d];
        x[d] = middle + h;
        const double up = touch(platform, x, stick).energy_j;
        x[d] = middle - h;
        const double down = touch(platform, x, stick).energy_j;
        x[d] = middle;
        // The energy is quadratic: only rounding, 1e-16 of it over h.
        EXPECT_NEAR(-(up - down) / (2 * h), here.force_n[static_cast<std::size_t>(d)],
                    1e-16 * here.energy_j / h + 1e-12);
    }
}

TEST(PlatformLaw, FrictionIsLimitedAndASecondLookChangesNothing) {
    const Platform platform = rough();
    StickPoint stick;
    const double first[3] = {0, 1e-4, 1.9e-3};
    touch(platform, first, stick);
    const double x[3] = {3e-4, 1e-4, 1.9e-3};
    const PlatformContact slid = touch(platform, x, stick);
    // Along x only: mu times the normal force, against the motion.
    EXPECT_NEAR(slid.force_n[0] / (0.5 * slid.normal_n), -1, 1e-12);
    const PlatformContact again = touch(platform, x, stick);
    for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_NEAR(again.force_n[d], slid.force_n[d], 1e-12 * slid.normal_n);
    }
}

TEST(PlatformLaw, NeverPullsAndLetsGo) {
    Platform platform = rough();
    platform.damping_pa_s_m = 1e6;
    StickPoint stick;
    const double x[3] = {0, 1e-4, 1.9e-3};
    const double leaving[3] = {0, 6, 8};
    const PlatformContact contact = touch(platform, x, stick, leaving);
    EXPECT_LT(contact.gap_m, 0);
    EXPECT_EQ(contact.normal_n, 0);
    EXPECT_TRUE(stick.held);
    const double above[3] = {0, 0, 3e-3};
    const PlatformContact off = touch(platform, above, stick);
    EXPECT_GT(off.gap_m, 0);
    EXPECT_EQ(off.force_n, (Vec3{}));
    EXPECT_FALSE(stick.held);
}

TEST(ContactLawOfNodes, IsThatOfSurfacesWhateverTheMesh) {
    const ContactLaw law{2e-4, 1e9, 2};
    const double gap = 0.5e-4;
    for (const double spacing : {2e-5, 1e-5}) {
        const double node = spacing * spacing;
        double pressure = 0;
        double energy = 0;
        for (int i = -25; i <= 25; ++i) {
            for (int j = -25; j <= 25; ++j) {
                const double r = std::hypot(i * spacing, j * spacing, gap);
                const ContactForce pair = contact_force(law, node * node, r);
                pressure += pair.force_n * gap / r / node;
                energy += pair.energy_j / node;
            }
        }
        const double d = law.distance_m;
        // A sum in place of an integral over the disc that is in reach: ten and twenty
        // nodes along its radius, with a kink at its rim.
        EXPECT_NEAR(pressure / (6e9 * gap * (d - gap) * (d - gap) / (d * d)), 1, 0.02);
        EXPECT_GT(energy, 0);
    }
    EXPECT_EQ(contact_force(law, 1e-16, 0).force_n, 0);
    EXPECT_EQ(contact_force(law, 1e-16, 2e-4).force_n, 0);
}

constexpr double areas_m4 = 1e-16;

ContactLaw rough_nodes() {
    ContactLaw law{2e-4, 1e9};
    law.friction = 0.3;
    return law;
}

TEST(ContactLawOfNodes, FrictionIsMinusTheGradientOfItsEnergyWhileItSticks) {
    const ContactLaw law = rough_nodes();
    StuckPair stuck;
    pair_friction(law, areas_m4, {1e-5, 2e-5, 1.5e-4}, stuck);
    Vec3 x{1.4e-5, 1.7e-5, 1.48e-4};
    const Vec3 force = pair_friction(law, areas_m4, x, stuck).force_n;
    const double most = law.friction * contact_force(law, areas_m4, norm(x)).force_n;
    EXPECT_GT(norm(force), 0.01 * most);
    for (std::size_t d = 0; d < 3; ++d) {
        const double h = 1e-9;
        const auto energy_at = [&](double by) {
            Vec3 there = x;
            there[d] += by;
            pair_friction(law, areas_m4, there, stuck);
            return stuck_energy_j(law, areas_m4, stuck);
        };
        const double slope = (energy_at(h) - energy_at(-h)) / (2 * h);
        // Central differences over 1e-9 of 1.5e-4 m, and rounding of the energy over h.
        EXPECT_NEAR(-slope, force[d],
                    1e-9 * norm(force) + 1e-15 * norm(force) * 1e-4 / h);
    }
}

TEST(ContactLawOfNodes, FrictionIsCoulombsAndASecondLookChangesNothing) {
    const ContactLaw law = rough_nodes();
    StuckPair stuck;
    EXPECT_EQ(pair_friction(law, areas_m4, {0, 0, 1.5e-4}, stuck).force_n, (Vec3{}));
    const Vec3 far{5e-5, 0, 1.5e-4};
    const double most = law.friction * contact_force(law, areas_m4, norm(far)).force_n;
    const PairFriction slid = pair_friction(law, areas_m4, far, stuck);
    EXPECT_NEAR(norm(slid.force_n) / most, 1, 1e-12);
    // Against the motion, across the line between the nodes.
    EXPECT_LT(slid.force_n[0], 0);
    EXPECT_NEAR(slid.force_n[0] * far[0] + slid.force_n[2] * far[2], 0,
                1e-12 * most * 1e-4);
    EXPECT_GT(slid.lost_j, 0);
    const PairFriction again = pair_friction(law, areas_m4, far, stuck);
    for (std::size_t d = 0; d < 3; ++d)
        EXPECT_NEAR(again.force_n[d], slid.force_n[d], 1e-12 * most);
    EXPECT_NEAR(again.lost_j, 0, 1e-12 * slid.lost_j);
    // Out of reach it lets go, and what the spring had is lost.
    const double had = stuck_energy_j(law, areas_m4, stuck);
    const PairFriction off = pair_friction(law, areas_m4, {0, 0, 2.1e-4}, stuck);
    EXPECT_EQ(off.force_n, (Vec3{}));
    EXPECT_EQ(off.lost_j, had);
    EXPECT_FALSE(stuck.held);
    EXPECT_EQ(stuck_energy_j(law, areas_m4, stuck), 0);
}

// Round and back on a crooked way, pressed and relieved, steps small and large.
TEST(ContactLawOfNodes, WhatFrictionTakesIsWhatItHasAndWhatIsLost) {
    const ContactLaw law = rough_nodes();
    double last_error = 0;
    for (const int steps : {1600, 6400, 25600}) {
        StuckPair stuck;
        Vec3 x{0, 0, 1.6e-4};
        Vec3 force = pair_friction(law, areas_m4, x, stuck).force_n;
        double work = 0, lost = 0;
        for (int i = 1; i <= steps; ++i) {
            const double t = 2 * std::numbers::pi * i / steps;
            const Vec3 next{4e-5 * std::sin(2 * t), 3e-5 * (1 - std::cos(3 * t)),
                            1.6e-4 - 3e-5 * (1 - std::cos(t))};
            const PairFriction now = pair_friction(law, areas_m4, next, stuck);
            EXPECT_GE(now.lost_j, 0);
            work -= dot(0.5 * (force + now.force_n), next - x);
            lost += now.lost_j;
            force = now.force_n;
            x = next;
        }
        const double error = std::abs(stuck_energy_j(law, areas_m4, stuck) + lost - work);
        EXPECT_GT(lost, 0.5 * work);
        // Where it slips the direction of a step's force is known to first order.
        EXPECT_LT(error, 0.4 / steps * work);
        if (last_error > 0) {
            EXPECT_LT(error, 0.4 * last_error);
        }
        last_error = error;
    }
}

class LatticeFileTest : public ::testing::Test {
  protected:
    void write(const std::string& text) { std::ofstream(file_) << text; }
    std::string error() {
        return test::message_of<std::runtime_error>([&] { read_lattice_file(file_); });
    }
    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "strip.lattice";
};

TEST_F(LatticeFileTest, ReadsBackExactly) {
    const Mesh mesh = test::distorted_block({{1e-3, 6e-4, 3e-4}, {3, 2, 1}}, 1e-6, 20);
    LatticeFile out{mesh.nodes, mesh.elements, {}, {}};
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        out.magnetization_a_m.push_back({62e3 / 3, -1.0 / static_cast<double>(e + 1), 0});
    }
    write_lattice_file(out, file_);
    const LatticeFile back = read_lattice_file(file_);
    EXPECT_EQ(back.nodes_m, out.nodes_m);
    EXPECT_EQ(back.elements, out.elements);
    EXPECT_EQ(back.magnetization_a_m, out.magnetization_a_m);
    EXPECT_TRUE(back.element_material.empty());
}

TEST_F(LatticeFileTest, KeepsTheMaterialsOfTheElements) {
    const Mesh mesh = box_mesh({{1e-3, 6e-4, 3e-4}, {3, 1, 1}});
    write_lattice_file({mesh.nodes, mesh.elements, {}, {0, 2, 1}}, file_);
    EXPECT_EQ(read_lattice_file(file_).element_material, (std::vector{0, 2, 1}));
    write("nodes 1\n0 0 0\nelements 1\n0 0 0 0 0 0 0 0 1 2 3 soft\n");
    test::expect_says(error(), {"number of its material"});
    write("nodes 1\n0 0 0\nelements 1\n0 0 0 0 0 0 0 0 1 2 3 -1\n");
    test::expect_says(error(), {"number of its material"});
}

TEST_F(LatticeFileTest, KeepsTheRigidPartsOfTheElements) {
    const Mesh mesh = box_mesh({{1e-3, 6e-4, 3e-4}, {3, 1, 1}});
    write_lattice_file({mesh.nodes, mesh.elements, {}, {}, {-1, 1, 0}}, file_);
    EXPECT_EQ(read_lattice_file(file_).element_rigid, (std::vector{-1, 1, 0}));
    EXPECT_TRUE(read_lattice_file(file_).element_material.empty());
    write("nodes 1\n0 0 0\nelements 1\n0 0 0 0 0 0 0 0 1 2 3 0 -2\n");
    test::expect_says(error(), {"of its rigid part"});
}

TEST_F(LatticeFileTest, ErrorsNameTheLineAndWhatItShouldHold) {
    write("# comment\nnodes two\n");
    test::expect_says(error(), {"line 2: expected \"nodes N\""});
    write("nodes 1\n0 0\n");
    test::expect_says(error(), {"line 2: expected three coordinates"});
    write("nodes 1\n0 0 0\nelements 1\n0 0 0 0 0 0 0 0 1 2\n");
    test::expect_says(error(), {"line 4: expected eight node numbers"});
    write("nodes 1\n0 0 0\n");
    test::expect_says(error(), {"expected \"elements N\""});
}

TEST_F(LatticeFileTest, AFileThatIsNotThereIsNamed) {
    test::expect_says(error(), {file_.string()});
    EXPECT_THROW(write_lattice_file({}, "/nowhere/strip.lattice"), std::runtime_error);
}

}  // namespace
}  // namespace magfsi::structure

// SPDX-License-Identifier: GPL-2.0-or-later
// The laws of one node on a platform and of two nodes in contact.
#include <gtest/gtest.h>
#include <cmath>
#include <fstream>
#include "structure/lammps/effects/contact/contact_law.h"
#include "structure/lammps/effects/platform/platform_law.h"
#include "structure/lammps/lattice_file.h"
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

TEST(ContactLawOfNodes, FrictionIsCoulombsAboveTheSpeedAtWhichItsDragReachesIt) {
    ContactLaw law{2e-4, 1e9};
    law.friction = 0.3;
    const double drag = friction_drag_kg_s(law, 1e-8, 1e-9, 1e-6);
    // 6 A / (pi d^2) = 0.477 of 2.2, of a quarter of the mass in a step.
    EXPECT_NEAR(drag, 0.25e-3 * 0.4775 / 2.2, 1e-8);
    // Nodes closer than one another's area allows: no more than that quarter.
    EXPECT_DOUBLE_EQ(friction_drag_kg_s(law, 1e-6, 1e-9, 1e-6), 0.25e-3);
    const double normal_n = 1e-5;
    const Vec3 fast = friction_force_n(law, normal_n, drag, {3, -4, 0});
    EXPECT_NEAR(fast[0], -0.6 * 0.3 * normal_n, 1e-20);
    EXPECT_NEAR(fast[1], 0.8 * 0.3 * normal_n, 1e-20);
    EXPECT_DOUBLE_EQ(friction_force_n(law, normal_n, drag, {1e-3, 0, 0})[0],
                     -drag * 1e-3);
    EXPECT_EQ(friction_force_n(law, normal_n, drag, {})[0], 0);
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

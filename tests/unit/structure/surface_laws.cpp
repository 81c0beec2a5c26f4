// The laws of one node on a platform and of two nodes in contact.
#include <gtest/gtest.h>

#include <cmath>

#include "structure/lammps/effects/contact/contact_law.h"
#include "structure/lammps/effects/platform/platform_law.h"

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

}  // namespace
}  // namespace magfsi::structure

// SPDX-License-Identifier: GPL-2.0-or-later
// Where planes of markers put their wall, against the same theory by other means: a box
// of 256 spacings and numpy (tests/validation/no_slip/lattice_response.py).
#include "adapters/solvers/bodies/wall_of_planes.h"

#include <gtest/gtest.h>

namespace magfsi::bodies {
namespace {

constexpr auto two = coupler::Kernel::two_point, three = coupler::Kernel::three_point;

TEST(WallOfPlanes, IsAsThickAsTheTheoryOfTheLatticeSays) {
    struct Case {
        coupler::Kernel kernel;
        double tau, magic;
        EvenPlanes planes;
        double thickness;
    };
    for (const Case& c : {Case{three, 0.505, 0.01, {1, 1}, 1.6556},
                          Case{three, 0.505, 0.01, {2, 1}, 2.0965},
                          Case{three, 0.505, 0.01, {3, 1}, 3.8021},
                          Case{three, 0.505, 0.01, {4, 1}, 4.4853},
                          Case{three, 0.8, 0.1875, {2, 1.6}, 2.5956},
                          Case{two, 0.505, 0.01, {3, 1}, 3.4410},
                          Case{two, 0.8, 0.1875, {4, 1}, 3.8283}}) {
        EXPECT_NEAR(WallOfPlanes(c.kernel, c.tau, c.magic).thickness(c.planes),
                    c.thickness, 1e-3);
    }
}

TEST(WallOfPlanes, FindsPlanesAsThickAsABody) {
    for (const auto kernel : {two, three}) {
        const WallOfPlanes wall(kernel, 0.505, 0.01);
        for (double body = 0.1; body < 12; body += 0.3) {
            const EvenPlanes planes = wall.for_body(body);
            const double found = planes.count < 7 ? wall.thickness(planes)
                                                  : (planes.count - 1) * planes.apart +
                                                        2 * wall.depth(planes.apart);
            if (planes.count == 1) {  // one carries what it carries
                EXPECT_LT(body - found, 0.4);
                continue;
            }
            // Between the widest of n planes and the closest of n + 1 there are gaps.
            EXPECT_NEAR(found, body, 0.2) << planes.count << " x " << planes.apart;
            EXPECT_GE(planes.apart, 0.75);
            EXPECT_LE(planes.apart, planes.count == 2 ? 2.0 : fitted::widest_apart);
        }
    }
}

}  // namespace
}  // namespace magfsi::bodies

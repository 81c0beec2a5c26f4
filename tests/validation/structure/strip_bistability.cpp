// Turning, Fig. 5: in a field at 90 degrees the strip has two stable shapes. It keeps the
// C in which the field has turned it there from 225 degrees, but from flat it becomes a
// V.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/validation/structure/static_bodies.h"

namespace magfsi::structure {
namespace {

constexpr double field_t = 16.9e-3;

double energy_j(const Equilibrium& found) {
    return found.energy_elastic_j + found.energy_magnetic_j;
}

void print(const char* what, const Body& body, const Equilibrium& found) {
    const test::StripShape shape = test::strip_shape(body, found.nodes_m);
    std::printf(
        "%-22s bend %8.3f deg, tilt %8.3f deg, elastic %.4f nJ, magnetic %.4f nJ, "
        "negative eigenvalues %d, releases %d, %.2f s\n",
        what, shape.total_bend_deg, shape.mid_angle_deg, 1e9 * found.energy_elastic_j,
        1e9 * found.energy_magnetic_j, found.negative_eigenvalues, found.releases,
        found.seconds);
}

TEST(Bistability, AFieldAt90KeepsTheCThatItTurnedAndMakesAVFromFlat) {
    const Body body = test::harmonic_strip({40, 8, 1}, ElementVariant::assumed_strain);
    NewtonSolver solver(body);
    const StaticLoads start = test::field_xz(field_t, 225);
    const Equilibrium c = solver.solve(start);
    print("C at 225", body, c);
    const std::vector<StaticLoads> path{test::field_xz(field_t, 180),
                                        test::field_xz(field_t, 135),
                                        test::field_xz(field_t, 90)};
    const auto turned = solver.follow(c.nodes_m, start, path);
    for (const Equilibrium& found : turned) {
        print("turned by -45", body, found);
        EXPECT_EQ(found.releases, 0);
        EXPECT_EQ(found.negative_eigenvalues, 0);
    }
    const Equilibrium v = solver.release(body.mesh.nodes, path.back());
    print("released from flat, 90", body, v);
    EXPECT_EQ(v.negative_eigenvalues, 0);

    const test::StripShape before = test::strip_shape(body, c.nodes_m);
    const test::StripShape after = test::strip_shape(body, turned.back().nodes_m);
    // Without gravity a field turns the shape rigidly: only rounding and the residual of
    // 1e-9 times the softness of the strip (about 1e3) are left.
    EXPECT_NEAR(after.total_bend_deg, before.total_bend_deg, 1e-3);
    EXPECT_NEAR(after.mid_angle_deg, before.mid_angle_deg - 135, 1e-3);
    EXPECT_NEAR(energy_j(turned.back()) / energy_j(c), 1, 1e-6);

    const test::StripShape other = test::strip_shape(body, v.nodes_m);
    EXPECT_LT(after.total_bend_deg, -200);  // ends down
    EXPECT_GT(other.total_bend_deg, 60);    // ends up
    // Two minima, of clearly different depth.
    EXPECT_LT(energy_j(c), 1.5 * energy_j(v));
}

TEST(Bistability, FromFlatTheDirectionDecides) {
    const Body body = test::harmonic_strip({20, 8, 1}, ElementVariant::assumed_strain);
    NewtonSolver solver(body);
    // An overdamped rod goes to V up to 91 degrees from 45, and to C beyond 105 or more
    // (header of strip_harmonic.csv).
    for (double direction : {0.0, 45.0, 90.0, 120.0, 180.0, 225.0, 270.0}) {
        const Equilibrium found =
            solver.release(body.mesh.nodes, test::field_xz(5e-3, direction));
        print(("from flat at " + std::to_string(static_cast<int>(direction))).c_str(),
              body, found);
        EXPECT_EQ(found.negative_eigenvalues, 0);
        const double from_v = std::abs(std::remainder(direction - 45, 360));
        if (from_v < 80) {
            EXPECT_GT(test::strip_shape(body, found.nodes_m).total_bend_deg, 50);
        } else if (from_v > 110) {
            EXPECT_LT(test::strip_shape(body, found.nodes_m).total_bend_deg, -100);
        }
    }
}

}  // namespace
}  // namespace magfsi::structure

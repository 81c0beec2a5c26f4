// Sides and obstacles that cannot be are refused with a sentence that names what was
// found.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fluid_lbm/units.h"
#include "tests/unit/fluid_boundary/channel.h"

namespace magfsi::fluid {
namespace {

void expect_refused(const std::function<void(FluidConfig&)>& spoil,
                    const std::string& wanted) {
    FluidConfig config = channel({20, 10, 10}, 0.6, 0, 0.05, BoundaryKind::no_slip);
    ASSERT_NO_THROW(check(config));
    spoil(config);
    try {
        check(config);
        FAIL() << "accepted; wanted a refusal with: " << wanted;
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find(wanted), std::string::npos)
            << error.what();
    }
}

TEST(Openings, InletTooFastForTheLattice) {
    expect_refused([](FluidConfig& c) { c.boundaries[0].inlet.velocity_m_s[0] = 0.5; },
                   "inlet speed at x_min is 0.5 cells a step");
    // The peak counts: 9/4 of the mean between four walls.
    expect_refused(
        [](FluidConfig& c) {
            c.boundaries[0].inlet.velocity_m_s[0] = 0.2;
            c.boundaries[0].inlet.profile = InletProfile::parabolic;
        },
        "inlet speed at x_min is 0.4");
}

TEST(Openings, InletThatIsNoNumber) {
    expect_refused([](FluidConfig& c) { c.boundaries[0].inlet.velocity_m_s[1] = NAN; },
                   "inlet velocity at x_min is not finite");
    expect_refused([](FluidConfig& c) { c.boundaries[0].inlet.ramp_s = -1; },
                   "ramp at x_min is -1 s");
}

TEST(Openings, InletWithoutAWayOut) {
    expect_refused([](FluidConfig& c) { c.boundaries[1].kind = BoundaryKind::no_slip; },
                   "fluid inlets bring 5 m3/s and there is no pressure outlet");
}

TEST(Openings, InletsThatBalanceNeedNoOutlet) {
    FluidConfig config = channel({20, 10, 10}, 0.6, 0, 0.05, BoundaryKind::no_slip);
    config.boundaries[1] = config.boundaries[0];
    EXPECT_NO_THROW(check(config));
}

TEST(Openings, OutletsThatShareAnEdge) {
    expect_refused(
        [](FluidConfig& c) { c.boundaries[4].kind = BoundaryKind::pressure_outlet; },
        "x_max and z_min are pressure outlets that share an edge");
}

TEST(Openings, OutletOppositeAPeriodicSide) {
    expect_refused([](FluidConfig& c) { c.boundaries[0].kind = BoundaryKind::periodic; },
                   "x_min is periodic and the opposite side is not");
}

TEST(Openings, OutletPressureThatIsNoNumber) {
    expect_refused([](FluidConfig& c) { c.boundaries[1].outlet_pressure_pa = INFINITY; },
                   "outlet pressure at x_max is not finite");
}

TEST(Openings, PatchOutsideItsSide) {
    expect_refused(
        [](FluidConfig& c) {
            c.boundaries[0].patch = Disc{{8, 5}, 6};
        },
        "patch on x_min reaches from 5 to 11 m along y; the side reaches from "
        "0 to 10 m");
    expect_refused(
        [](FluidConfig& c) {
            c.boundaries[1].patch = Rectangle{{5, 5}, {2, 11}};
        },
        "patch on x_max reaches from -0.5 to 10.5 m along z");
}

TEST(Openings, PatchThatHoldsNoCell) {
    expect_refused(
        [](FluidConfig& c) {
            c.boundaries[0].patch = Disc{{5, 5}, 0.5};
        },
        "patch on x_min holds the centre of no cell");
}

TEST(Openings, PatchOfAWall) {
    expect_refused(
        [](FluidConfig& c) {
            c.boundaries[2].patch = Disc{{5, 5}, 2};
        },
        "y_min is no-slip and has a patch");
}

TEST(Openings, WallVelocityOfAnOpening) {
    expect_refused(
        [](FluidConfig& c) {
            c.boundaries[1].wall_velocity_m_s = {0, 1, 0};
        },
        "x_max is a pressure outlet and has a wall velocity");
}

TEST(Obstacles, OutsideTheBox) {
    expect_refused(
        [](FluidConfig& c) {
            c.obstacles = {{"ball", Sphere{{-3, 5, 5}, 4}}};
        },
        "\"ball\" reaches from -5 to -1 m along x; it lies outside the box");
    expect_refused(
        [](FluidConfig& c) {
            c.obstacles = {{"ball", Sphere{{NAN, 5, 5}, 4}}};
        },
        "along x");
}

TEST(Obstacles, WithoutSize) {
    expect_refused(
        [](FluidConfig& c) {
            c.obstacles = {{"ball", Sphere{{5, 5, 5}, 0}}};
        },
        "\"ball\" has the diameter 0 m");
    expect_refused(
        [](FluidConfig& c) {
            c.obstacles = {{"brick", Block{{5, 5, 5}, {6, 5, 6}}}};
        },
        "\"brick\" has the length along y 0 m");
    expect_refused(
        [](FluidConfig& c) {
            c.obstacles = {{"rod", Cylinder{{5, 5, 5}, 2, 3, {}}}};
        },
        "\"rod\" has the axis 3");
}

TEST(Obstacles, OfTheSameName) {
    expect_refused(
        [](FluidConfig& c) {
            c.obstacles = {{"a", Sphere{{5, 5, 5}, 2}}, {"a", Sphere{{9, 5, 5}, 2}}};
        },
        "both named \"a\"");
}

TEST(Obstacles, WithoutAFile) {
    expect_refused(
        [](FluidConfig& c) {
            c.obstacles = {{"part", StlSurface{"/none.stl", 1, {}}}};
        },
        "STL file /none.stl cannot be opened");
}

}  // namespace
}  // namespace magfsi::fluid

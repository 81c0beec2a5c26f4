// A configuration that cannot run is refused with a sentence that names what was found.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fluid_lbm/units.h"

namespace magfsi::fluid {
namespace {

FluidConfig water() {
    FluidConfig config;
    config.cells = {16, 8, 16};
    config.spacing_m = 1e-4;
    config.time_step_s = 1e-5;
    config.density_kg_m3 = 1000;
    config.viscosity_m2_s = 1e-6;
    for (Boundary& side : config.boundaries) side.kind = BoundaryKind::no_slip;
    return config;
}

void expect_refused(const std::function<void(FluidConfig&)>& spoil,
                    const std::string& wanted) {
    FluidConfig config = water();
    spoil(config);
    try {
        check(config);
        FAIL() << "accepted; wanted a refusal with: " << wanted;
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find(wanted), std::string::npos)
            << error.what();
    }
}

TEST(FluidConfig, WaterIsAccepted) {
    EXPECT_NO_THROW(check(water()));
    EXPECT_NEAR(relaxation_time(water()), 0.503, 1e-15);  // 3 * 1e-6 * 1e-5 / 1e-8 + 1/2
}

TEST(FluidConfig, RefusesTooFewCells) {
    expect_refused([](FluidConfig& c) { c.cells[1] = 1; }, "1 cells along y");
}

TEST(FluidConfig, RefusesUnphysicalNumbers) {
    expect_refused([](FluidConfig& c) { c.spacing_m = 0; }, "spacing is 0 m");
    expect_refused([](FluidConfig& c) { c.time_step_s = -1; }, "time step is -1 s");
    expect_refused([](FluidConfig& c) { c.density_kg_m3 = NAN; }, "density is nan");
    expect_refused([](FluidConfig& c) { c.viscosity_m2_s = 0; },
                   "3 nu dt / dx^2 + 1/2 is 0.5");
    expect_refused([](FluidConfig& c) { c.viscosity_m2_s = -1e-6; }, "relaxation time");
}

TEST(FluidConfig, RefusesOneSidedPeriodicity) {
    expect_refused([](FluidConfig& c) { c.boundaries[3].kind = BoundaryKind::periodic; },
                   "y_max is periodic and the opposite side is not");
}

TEST(FluidConfig, RefusesWallsThatMoveThroughThemselves) {
    expect_refused(
        [](FluidConfig& c) {
            c.boundaries[4].wall_velocity_m_s = {0, 0, 1e-3};
        },
        "z_min has the component 0.001 m/s along z");
}

TEST(FluidConfig, RefusesVelocityOfAPeriodicSide) {
    expect_refused(
        [](FluidConfig& c) {
            c.boundaries[2].kind = c.boundaries[3].kind = BoundaryKind::periodic;
            c.boundaries[2].wall_velocity_m_s = {1, 0, 0};
        },
        "y_min is periodic and has a wall velocity");
}

TEST(FluidConfig, RefusesWallsTooFastForTheLattice) {
    expect_refused(
        [](FluidConfig& c) {
            c.boundaries[2].wall_velocity_m_s = {5, 0, 0};
        },
        "y_min is 0.5 cells a step");
}

}  // namespace
}  // namespace magfsi::fluid

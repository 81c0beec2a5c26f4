// What goes through planes across a developed channel, in closed form: the volume flow is
// the inlet's everywhere, the flux of momentum 6/5 rho U^2 A, and the pressure falls by
// 12 rho nu U / H^2 a length.
#include <gtest/gtest.h>

#include "tests/unit/fluid_boundary/channel.h"

namespace magfsi::fluid {
namespace {

constexpr double speed = 0.002;
constexpr int height = 16, depth = 3;

FluidConfig plane_channel() {
    FluidConfig config =
        channel({60, height, depth}, 0.8, 0, speed, BoundaryKind::no_slip);
    config.boundaries[4].kind = config.boundaries[5].kind = BoundaryKind::periodic;
    config.boundaries[0].inlet.profile = InletProfile::parabolic;
    return config;
}

TEST(PlaneFlow, IsThatOfPoiseuille) {
    Fluid fluid(MPI_COMM_WORLD, plane_channel());
    advance(fluid, 6000);  // 2.3 times H^2 / nu: exp(-pi^2 2.3) of the start is left
    const double area = height * depth;
    const PlaneFlow near = fluid.plane_flow(0, 20.3), far = fluid.plane_flow(0, 40.3);
    // Compressible by pressure / c^2 = 3 * 12 nu U 40 / H^2 = 1.1e-3.
    EXPECT_NEAR(near.flow_m3_s / (speed * area), 1, 2e-3);
    EXPECT_NEAR(far.flow_m3_s / (speed * area), 1, 2e-3);
    // And the midpoint rule over 16 cells: 1 / (2 * 16^2).
    EXPECT_NEAR(near.momentum_flux_n[0] / (1.2 * speed * speed * area), 1, 8e-3);
    EXPECT_NEAR(near.momentum_flux_n[1] / (speed * speed * area), 0, 1e-3);
    const double viscosity = fluid.config().viscosity_m2_s;
    const double fall = 12 * viscosity * speed / (height * height) * 20;
    EXPECT_NEAR((near.pressure_pa - far.pressure_pa) / fall, 1, 1e-2);
    // Nothing goes through the walls and across the depth.
    EXPECT_NEAR(fluid.plane_flow(1, 8.2).flow_m3_s / (speed * area), 0, 2e-3);
    EXPECT_NEAR(fluid.plane_flow(2, 1.2).flow_m3_s / (speed * area), 0, 1e-12);
}

// Around an obstacle what flows is the same, through less of the plane; on any ranks.
TEST(PlaneFlow, IsTheSameOnAnyRanksAlsoAtObstacles) {
    FluidConfig config = plane_channel();
    config.obstacles = {{"brick", Block{{20, 5, -1}, {28, 11, 9}}}};
    Fluid parallel(MPI_COMM_WORLD, config), serial(MPI_COMM_SELF, config);
    advance(parallel, 3000);
    advance(serial, 3000);
    for (const int axis : {0, 1, 2}) {
        for (const double at : {0.0, 0.7, 2.1}) {
            const double place = axis == 0 ? 24 + at : at;
            const PlaneFlow a = parallel.plane_flow(axis, place);
            const PlaneFlow b = serial.plane_flow(axis, place);
            // Rounding of sums over some hundred cells in another order.
            EXPECT_NEAR(a.flow_m3_s, b.flow_m3_s, 1e-14);
            EXPECT_NEAR(a.pressure_pa, b.pressure_pa, 1e-15);
            for (int d = 0; d < 3; ++d)
                EXPECT_NEAR(a.momentum_flux_n[d], b.momentum_flux_n[d], 1e-15);
        }
    }
    // Compressibility, as above, three times the fall in pressure.
    EXPECT_NEAR(serial.plane_flow(0, 24).flow_m3_s / serial.plane_flow(0, 10).flow_m3_s,
                1, 1e-2);
}

}  // namespace
}  // namespace magfsi::fluid

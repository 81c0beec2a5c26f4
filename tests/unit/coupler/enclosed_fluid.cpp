// The force that takes the enclosed fluid's inertia away again and gives buoyancy.
#include <gtest/gtest.h>

#include "coupler/immersed_boundary/enclosed_fluid.h"

namespace magfsi::coupler {
namespace {

constexpr double step_s = 1e-4, density = 1000, volume = 2e-9;

std::vector<Marker> two_markers() {
    Marker marker;
    marker.displaced_m3 = volume;
    return {marker, marker};
}

TEST(EnclosedFluid, in_still_fluid_is_buoyancy) {
    EnclosedFluid enclosed(two_markers(), {density, step_s, {0, 0, -9.81}});
    enclosed.start(std::vector<Vec3>(2, Vec3{0.3, 0, 0}));
    for (int step = 0; step < 3; ++step) {
        enclosed.begin_step(std::vector<Vec3>(2, Vec3{0.3, 0, 0}));  // steady motion
        for (const Vec3& force : enclosed.force()) {
            EXPECT_EQ(force[0], 0);
            EXPECT_DOUBLE_EQ(force[2], density * volume * 9.81);
        }
    }
}

TEST(EnclosedFluid, in_accelerated_fluid_is_mass_times_acceleration) {
    EnclosedFluid enclosed(two_markers(), {density, step_s, {}});
    constexpr double acceleration = 5;
    for (int step = 0; step < 200; ++step) {
        const Vec3 u{acceleration * step * step_s, 0, 0};
        enclosed.begin_step(std::vector<Vec3>{u, Vec3{}});
    }
    // What is left of the start after 199 steps of 0.9: 1e-9.
    const double expected = density * volume * acceleration;
    EXPECT_NEAR(enclosed.force()[0][0] / expected, 1, 1e-8);
    EXPECT_EQ(enclosed.force()[1][0], 0);
}

// The impulse of a whole change of velocity is that of the enclosed mass, however it is
// smoothed.
TEST(EnclosedFluid, keeps_the_momentum_of_a_jump) {
    EnclosedFluid enclosed(two_markers(), {density, step_s, {}});
    enclosed.begin_step(std::vector<Vec3>(2));
    double impulse = 0;
    for (int step = 0; step < 300; ++step) {
        enclosed.begin_step(std::vector<Vec3>(2, Vec3{0, 0.2, 0}));
        impulse += enclosed.force()[0][1] * step_s;
    }
    EXPECT_NEAR(impulse / (density * volume * 0.2), 1, 1e-12);  // 0.9^300 and rounding
}

}  // namespace
}  // namespace magfsi::coupler

// A parabolic inlet and a pressure outlet carry Poiseuille flow: the profile between
// plates keeps its shape from end to end, the flux is the prescribed one, and the
// pressure falls by 12 rho nu U L / H^2. For all six sides as inlets and both directions
// of the plates.
#include <gtest/gtest.h>

#include "tests/unit/fluid_boundary/channel.h"

namespace magfsi::fluid {
namespace {

struct Case {
    int inlet, across;
};

class Developed : public testing::TestWithParam<Case> {};

TEST_P(Developed, KeepsItsProfile) {
    const auto [inlet, across] = GetParam();
    const int axis = inlet / 2;
    constexpr int length = 24, height = 12;
    constexpr double mean = 1e-3;  // so slow that density is constant to 0.06 %
    std::array<int, 3> cells{2, 2, 2};
    cells[axis] = length;
    cells[across] = height;
    FluidConfig config = channel(cells, 0.8, inlet, mean, BoundaryKind::no_slip);
    config.boundaries[inlet].inlet.profile = InletProfile::parabolic;
    config.boundaries[inlet].inlet.ramp_s = 100;
    const int third = 3 - axis - across;
    for (int side : {2 * third, 2 * third + 1}) {
        config.boundaries[side].kind = BoundaryKind::periodic;
    }
    Fluid fluid(MPI_COMM_WORLD, config);
    advance(fluid, 6000);  // diffusion takes height^2 / (pi^2 nu) = 146 steps
    const double sign = inlet % 2 == 0 ? 1 : -1;
    double worst = 0, flux[length] = {};
    for_each_velocity(fluid, [&](const std::array<int, 3>& cell, const Vec3& u) {
        const double s = (cell[across] + 0.5) * 2 / height - 1;
        const double exact = 1.5 * mean * (1 - s * s);
        worst = std::max(worst, std::abs(sign * u[axis] - exact) / mean);
        flux[cell[axis]] += sign * u[axis] / (2 * height);
    });
    std::printf(
        "inlet %d, across %d: largest error %.2e, flux %.5f at the inlet, %.5f at "
        "the outlet\n",
        inlet, across, worst, flux[sign > 0 ? 0 : length - 1] / mean,
        flux[sign > 0 ? length - 1 : 0] / mean);
    // Half-way walls and the inlet's links are second order: (1 / height)^2 = 0.7 %.
    EXPECT_LT(worst, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Sides, Developed,
                         testing::Values(Case{0, 1}, Case{0, 2}, Case{1, 1}, Case{2, 0},
                                         Case{2, 2}, Case{3, 0}, Case{4, 0}, Case{4, 1},
                                         Case{5, 1}));

}  // namespace
}  // namespace magfsi::fluid

// A pressure pulse that travels from inlet to outlet leaves the box: what comes back is
// below 5 % of what went out, by every side and with a mean flow, too.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/fluid_boundary/channel.h"

namespace magfsi::fluid {
namespace {

constexpr int length = 128;
// The pull of the pressure to its target reflects about 0.25 sqrt(2 pi) width / (2
// length) = 2 % of a pulse.
constexpr double middle = 50, width = 8, amplitude = 1e-4;  // of density

struct Case {
    int inlet;
    double speed;
    double relaxation_time;
};

double pulse(double distance) {
    const double s = (distance - middle) / width;
    return amplitude * std::exp(-0.5 * s * s);
}

// Of density over rest, inside the box.
double largest_excess(const Fluid& fluid) {
    const CellBox box = fluid.owned();
    std::size_t cells = 1;
    for (int a = 0; a < 3; ++a) cells *= box.hi[a] - box.lo[a];
    std::vector<float> u(3 * cells), density(cells);
    fluid.macroscopic(u, density);
    double largest = 0;
    for (const float rho : density) largest = std::max(largest, std::abs(rho - 1.0));
    return largest;
}

class Outlet : public testing::TestWithParam<Case> {};

TEST_P(Outlet, ReflectsLessThanFivePercent) {
    const auto [inlet, speed, relaxation_time] = GetParam();
    const int axis = inlet / 2;
    std::array<int, 3> cells{3, 3, 3};
    cells[axis] = length;
    FluidConfig config =
        channel(cells, relaxation_time, inlet, speed, BoundaryKind::free_slip);
    // Simple wave: everything travels to the outlet.
    const double sign = inlet % 2 == 0 ? 1 : -1;
    const auto at = [=](const Vec3& x) {
        return inlet % 2 == 0 ? x[axis] : length - x[axis];
    };
    const double cs = 1 / std::sqrt(3.0);
    config.initial_pressure = [=](const Vec3& x) { return pulse(at(x)) / 3; };
    config.initial_velocity = [=](const Vec3& x) {
        Vec3 u{};
        u[axis] = sign * (speed + cs * pulse(at(x)));
        return u;
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    const double before = largest_excess(fluid);
    // The pulse has passed the outlet by four widths, and its echo is still in the box.
    advance(fluid, static_cast<int>((length - middle + 6 * width) / (cs + speed)));
    const double after = largest_excess(fluid);
    std::printf("side %d, speed %.3f, tau %.3f: %.2f %% comes back\n", inlet, speed,
                relaxation_time, 100 * after / before);
    EXPECT_LT(after, 0.05 * before);
}

INSTANTIATE_TEST_SUITE_P(Sides, Outlet,
                         testing::Values(Case{0, 0, 0.6}, Case{1, 0, 0.6},
                                         Case{2, 0, 0.6}, Case{3, 0, 0.6},
                                         Case{4, 0, 0.6}, Case{5, 0, 0.6},
                                         Case{0, 0.1, 0.6}, Case{3, 0.1, 0.505},
                                         Case{4, 0.05, 0.9}));

}  // namespace
}  // namespace magfsi::fluid

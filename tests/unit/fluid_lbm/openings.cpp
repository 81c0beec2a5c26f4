// SPDX-License-Identifier: GPL-2.0-or-later
// Inlets, outlets and planes of symmetry.
#include <algorithm>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

// ---- A parabolic inlet and a pressure outlet carry Poiseuille flow: the profile between
// plates keeps its shape from end to end. For all six sides as inlets and both directions
// of the plates.

class Developed : public testing::TestWithParam<std::array<int, 2>> {};

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
                         testing::Values(std::array{0, 1}, std::array{0, 2},
                                         std::array{1, 1}, std::array{2, 0},
                                         std::array{2, 2}, std::array{3, 0},
                                         std::array{4, 0}, std::array{4, 1},
                                         std::array{5, 1}));

// ---- A pressure pulse that travels from inlet to outlet leaves the box: what comes back
// is below 5 % of what went out, by every side and with a mean flow, too.

constexpr int length = 128;
// The pull of the pressure to its target reflects about 0.25 sqrt(2 pi) width / (2
// length) = 2 % of a pulse.
constexpr double start = 50, width = 8, amplitude = 1e-4;  // of density

struct Pulse {
    int inlet;
    double speed;
    double relaxation_time;
};

double pulse(double distance) {
    const double s = (distance - start) / width;
    return amplitude * std::exp(-0.5 * s * s);
}

// Of the density over that at rest, in the whole box.
double largest_excess(const Fluid& fluid) {
    const CellBox box = fluid.owned();
    std::size_t cells = 1;
    for (int a = 0; a < 3; ++a) cells *= box.hi[a] - box.lo[a];
    std::vector<float> u(3 * cells), density(cells);
    fluid.macroscopic(u, density);
    double largest = 0;
    for (const float rho : density) largest = std::max(largest, std::abs(rho - 1.0));
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return largest;
}

class Outlet : public testing::TestWithParam<Pulse> {};

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
    advance(fluid, static_cast<int>((length - start + 6 * width) / (cs + speed)));
    const double after = largest_excess(fluid);
    std::printf("side %d, speed %.3f, tau %.3f: %.2f %% reflected\n", inlet, speed,
                relaxation_time, 100 * after / before);
    EXPECT_LT(after, 0.05 * before);
}

INSTANTIATE_TEST_SUITE_P(Sides, Outlet,
                         testing::Values(Pulse{0, 0, 0.6}, Pulse{1, 0, 0.6},
                                         Pulse{2, 0, 0.6}, Pulse{3, 0, 0.6},
                                         Pulse{4, 0, 0.6}, Pulse{5, 0, 0.6},
                                         Pulse{0, 0.1, 0.6}, Pulse{3, 0.1, 0.505},
                                         Pulse{4, 0.05, 0.9}));

// ---- Free slip keeps mass and tangential momentum: a uniform flow along the sides stays
// as it is, and a box with any flow in it loses no mass. A plane of symmetry halves a
// flow: the upper half of a channel is the same with free slip in place of its other
// half.

FluidConfig slip_box(int normal) {
    FluidConfig config = lattice_fluid({7, 6, 8}, 0.55, Collision::automatic);
    for (int side : {2 * normal, 2 * normal + 1}) {
        config.boundaries[side].kind = BoundaryKind::free_slip;
    }
    return config;
}

class FreeSlipSide : public testing::TestWithParam<int> {};

TEST_P(FreeSlipSide, LeavesUniformFlowAlone) {
    FluidConfig config = slip_box(GetParam());
    const int along = (GetParam() + 1) % 3;
    config.initial_velocity = [along](const Vec3&) {
        Vec3 u{};
        u[along] = 0.05;
        return u;
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    advance(fluid, 101);
    for_each_velocity(fluid, [&](const std::array<int, 3>&, const Vec3& u) {
        EXPECT_NEAR(u[along], 0.05, 1e-13);  // rounding of 101 steps
        EXPECT_NEAR(u[GetParam()], 0, 1e-13);
    });
}

TEST_P(FreeSlipSide, KeepsMassAndMomentumAlongTheSides) {
    FluidConfig config = slip_box(GetParam());
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.02 * std::sin(x[1] + x[2]), 0.03 * std::cos(x[0]), 0.01 * x[1] / 6};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    const Totals before = fluid.totals();
    advance(fluid, 200);
    const Totals after = fluid.totals();
    // Rounding: 200 steps, 336 cells, sums in the order of the cells.
    EXPECT_NEAR(after.mass_kg, before.mass_kg, 1e-11);
    for (int a = 0; a < 3; ++a) {
        if (a == GetParam()) continue;
        EXPECT_NEAR(after.momentum_kg_m_s[a], before.momentum_kg_m_s[a], 1e-11);
    }
}

// Walls at the high ends; at the low ends either free slip or the mirror image.
FluidConfig corner_flow(bool half) {
    const int n = 5, factor = half ? 1 : 2;
    FluidConfig config =
        lattice_fluid({factor * n, factor * n, factor * n}, 0.7, Collision::automatic);
    for (int side = 0; side < 6; ++side) {
        config.boundaries[side].kind =
            half && side % 2 == 0 ? BoundaryKind::free_slip : BoundaryKind::no_slip;
    }
    const double middle = half ? 0 : n;
    config.initial_velocity = [middle](const Vec3& x) {
        const double r[3] = {x[0] - middle, x[1] - middle, x[2] - middle};
        // Odd in its own coordinate, even in the others: symmetric about all planes.
        return Vec3{0.01 * std::sin(r[0]) * std::cos(0.5 * r[1]),
                    0.02 * std::sin(0.7 * r[1]) * std::cos(r[2]),
                    -0.01 * std::sin(r[2]) * std::cos(0.3 * r[0])};
    };
    return config;
}

TEST(PlaneOfSymmetry, HoldsUpToItsEdgesAndCorners) {
    const FluidConfig whole_box = corner_flow(false), eighth = corner_flow(true);
    Fluid whole(MPI_COMM_SELF, whole_box), part(MPI_COMM_SELF, eighth);
    advance(whole, 51);
    advance(part, 51);
    const std::vector<double> all = velocity(whole);
    double largest = 0;
    for_each_velocity(part, [&](const std::array<int, 3>& cell, const Vec3& u) {
        const std::size_t at = ((cell[2] + 5) * 10 + cell[1] + 5) * 10 + cell[0] + 5;
        for (int a = 0; a < 3; ++a) {
            largest = std::max(largest, std::abs(u[a]));
            // Rounding of 51 steps: the mirror images add up in another order.
            EXPECT_NEAR(u[a], all[3 * at + a], 1e-14);
        }
    });
    EXPECT_GT(largest, 1e-4);  // the flow has not died before the comparison
}

INSTANTIATE_TEST_SUITE_P(Normal, FreeSlipSide, testing::Values(0, 1, 2));

}  // namespace
}  // namespace magfsi::fluid

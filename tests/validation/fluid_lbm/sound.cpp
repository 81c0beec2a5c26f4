// SPDX-License-Identifier: GPL-2.0-or-later
// A bulk viscosity of the fluid's own: sound decays by its formula, shear does not see
// it, levels of a refined grid share it, and no wave grows in a stream down to the least
// rate.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "base/fitted/constants.h"
#include "fluid_lbm/collision/bulk_viscosity.h"
#include "fluid_lbm/refinement/refined_fluid.h"
#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

using std::numbers::pi;

constexpr double height = 1e-5;  // of the waves; their steepening is of its order

// A standing wave of sound over `cells` cells in a period, at rest at step 0 and with the
// stress of rest.
FluidConfig wave(int cells, double tau, double bulk, Collision collision) {
    FluidConfig config = lattice_fluid({cells, 1, 1}, tau, collision);
    config.bulk_viscosity_m2_s = bulk;
    // Odd rates near 1: slow odd modes lag behind short waves by an error of their own.
    config.magic_number = 0.1;
    config.initial_pressure = [=](const Vec3& x) {
        return height / 3 * std::cos(2 * pi * x[0] / cells);
    };
    return config;
}

// Amplitude of the density of the wave.
template <class AnyFluid>
double amplitude(const AnyFluid& fluid, int cells) {
    std::vector<double> u(3 * static_cast<std::size_t>(cells)), density(u.size() / 3);
    fluid.velocity(std::vector{CellRow{0, 0, 0, cells}}, u, density);
    double sum = 0;
    for (int x = 0; x < cells; ++x)
        sum +=
            density[static_cast<std::size_t>(x)] * std::cos(2 * pi * (x + 0.5) / cells);
    return 2 * sum / cells / height;
}

// Amplitude at a time [steps] of a wave that starts at rest: density, flow and
// isotropic viscous stress p of a wave number,
//   rho' = -k j,  j' = k (rho / 3 + p) - 4/3 nu k^2 j,  t_b p' = -nu_b k j - p,
// by Runge and Kutta with small steps.
double exact(double k, double nu, double bulk, double time) {
    const double t_b = 4.5 * bulk;
    struct Wave {
        double density, flow, stress;
    };
    const auto rate = [&](const Wave& w) {
        return Wave{-k * w.flow,
                    k * (w.density / 3 + w.stress) - 4.0 / 3 * nu * k * k * w.flow,
                    (-bulk * k * w.flow - w.stress) / t_b};
    };
    Wave w{1, 0, 0};
    const int steps = static_cast<int>(std::ceil(20 * time / std::min(1.0, t_b)));
    const double h = time / steps;
    const auto plus = [](const Wave& a, double s, const Wave& b) {
        return Wave{a.density + s * b.density, a.flow + s * b.flow,
                    a.stress + s * b.stress};
    };
    for (int i = 0; i < steps; ++i) {
        const Wave a = rate(w), b = rate(plus(w, h / 2, a)), c = rate(plus(w, h / 2, b)),
                   d = rate(plus(w, h, c));
        w = plus(plus(plus(plus(w, h / 6, a), h / 3, b), h / 3, c), h / 6, d);
    }
    return w.density;
}

// Decay rate of the density of a standing wave: samples of a single damped oscillation
// obey a(i + 2) = p a(i + 1) - q a(i) with q = exp(-2 rate apart); least squares.
double decay_rate(int cells, double tau, double bulk, Collision collision) {
    Fluid fluid(MPI_COMM_WORLD, wave(cells, tau, bulk, collision));
    const int apart = cells / 4;
    std::vector<double> a;
    for (int i = 1; i <= 8 * cells; ++i) {
        fluid.step();
        // The first period leaves room for what the start from rest has beside the wave.
        if (i > 2 * cells && i % apart == 0) a.push_back(amplitude(fluid, cells));
    }
    double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
    for (std::size_t i = 0; i + 2 < a.size(); ++i) {
        xx += a[i + 1] * a[i + 1];
        xy -= a[i + 1] * a[i];
        yy += a[i] * a[i];
        xz += a[i + 1] * a[i + 2];
        yz -= a[i] * a[i + 2];
    }
    const double q = (xx * yz - xy * xz) / (xx * yy - xy * xy);
    return -std::log(q) / (2 * apart);
}

class Sound : public testing::TestWithParam<Collision> {};

// exp(-k^2/2 (4/3 nu + nu_b) t), the limit of long waves: the same fluid with twice as
// many cells a wave has a quarter of the error.
TEST_P(Sound, DecaysByTheFormulaWithSecondOrder) {
    constexpr double tau = 0.6, bulk = 0.3;
    double last = 0;
    for (const int cells : {32, 64, 128}) {
        const double k = 2 * pi / cells;
        const double wanted = k * k / 2 * (4.0 / 3 * (tau - 0.5) / 3 + bulk);
        const double found = decay_rate(cells, tau, bulk, GetParam());
        const double error = std::abs(found / wanted - 1);
        std::printf("%3d cells: decay %.4e, formula %.4e, error %.2e\n", cells, found,
                    wanted, error);
        if (last > 0) {
            EXPECT_GT(last / error, 3.5) << cells;
        }
        last = error;
    }
    EXPECT_LT(last, 0.001);  // seen: 0.0006
}

// The most useful bulk viscosity, c k t_b = 1/2: the course of the density over three
// periods is that of the trace with its memory. On 64 cells the lattice is 0.3 % of the
// height off, with a bulk viscosity 2 % off it would be twice as much.
TEST_P(Sound, FollowsTheMemoryOfTheTrace) {
    constexpr int cells = 64;
    constexpr double tau = 0.6, k = 2 * pi / cells;
    const double bulk = useful_bulk_viscosity_m2_s(1 / std::sqrt(3.0), k);
    Fluid fluid(MPI_COMM_WORLD, wave(cells, tau, bulk, GetParam()));
    double worst = 0;
    for (int i = 1; i <= 5 * cells; ++i) {
        fluid.step();
        if (i % 16 != 0) continue;
        const double wanted = exact(k, (tau - 0.5) / 3, bulk, i);
        worst = std::max(worst, std::abs(amplitude(fluid, cells) - wanted));
    }
    std::printf("worst difference %.2e of the height\n", worst);
    EXPECT_LT(worst, 0.005);
}

// A shear wave: its decay with and without the bulk viscosity differs by what its own
// pressure makes, (u / c)^2 = 3e-6 of it at most.
TEST_P(Sound, LeavesShearAlone) {
    constexpr int cells = 32;
    double left[2];
    for (const bool own : {false, true}) {
        FluidConfig config = lattice_fluid({cells, 2, 1}, 0.52, GetParam());
        config.initial_velocity = [](const Vec3& x) {
            return Vec3{0, 0.001 * std::sin(2 * pi * x[0] / cells), 0};
        };
        if (own) config.bulk_viscosity_m2_s = 5;
        Fluid fluid(MPI_COMM_WORLD, config);
        for (int i = 0; i < 1000; ++i) fluid.step();
        left[own] = 0;
        for_each_velocity(fluid, [&](const std::array<int, 3>& cell, const Vec3& u) {
            left[own] += u[1] * std::sin(2 * pi * (cell[0] + 0.5) / cells);
        });
    }
    EXPECT_GT(left[0], 0.001);
    EXPECT_NEAR(left[1] / left[0], 1, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Collisions, Sound,
                         testing::Values(Collision::trt, Collision::recursive_regularized,
                                         Collision::recursive_mrt),
                         [](const testing::TestParamInfo<Collision>& of) {
                             return std::string(name_of(of.param));
                         });

// A standing wave through a patch decays as on the coarse grid alone: within 1 % of the
// first height, as the pulse that goes through a patch (refinement.cpp).
TEST(Sound, DecaysAlikeThroughARefinedPatch) {
    constexpr int cells = 96;
    const double bulk = useful_bulk_viscosity_m2_s(1 / std::sqrt(3.0), 2 * pi / cells);
    const FluidConfig config = wave(cells, 0.51, bulk, Collision::recursive_regularized);
    Fluid uniform(MPI_COMM_WORLD, config);
    RefinedFluid refined(MPI_COMM_WORLD, {.coarse = config, .rule = {}},
                         {{Vec3{30, 0.1, 0.1}, Vec3{66, 0.9, 0.9}}});
    for (int i = 1; i <= 2 * cells; ++i) {
        uniform.step();
        refined.step();
        refined.step();
        if (i % 8 != 0) continue;
        ASSERT_NEAR(amplitude(refined.level(0), cells), amplitude(uniform, cells), 0.01)
            << i;
    }
}

// Noise in a stream of 0.1 cells a step dies out with the least rate of the trace.
TEST(Sound, IsStableAtTheLeastRate) {
    constexpr double stream = 0.1, noise = 1e-3;
    const double bulk = largest_bulk_viscosity_m2_s(1, 1);
    EXPECT_NEAR(1 / trace_relaxation_time(bulk, 1, 1), fitted::least_trace_rate, 1e-12);
    for (const Collision collision :
         {Collision::recursive_regularized, Collision::trt, Collision::recursive_mrt}) {
        // recursive_mrt and trt are stable from relaxation times of about 0.52 on.
        const double tau = collision == Collision::recursive_regularized ? 0.5015 : 0.52;
        FluidConfig config = lattice_fluid({24, 24, 24}, tau, collision);
        config.bulk_viscosity_m2_s = bulk;
        config.initial_velocity = [=](const Vec3& x) {
            const double phase = 12.9898 * x[0] + 78.233 * x[1] + 37.719 * x[2];
            const double r = std::sin(phase) * 43758.5453;
            return Vec3{stream * 0.8, stream * 0.5 + noise * (r - std::floor(r) - 0.5),
                        stream * 0.33 + noise * std::sin(7 * phase)};
        };
        Fluid fluid(MPI_COMM_WORLD, config);
        const auto deviation = [&] {
            double most = 0;
            for_each_velocity(fluid, [&](const std::array<int, 3>&, const Vec3& u) {
                most = std::max(most, norm(u - Vec3{0.08, 0.05, 0.033}));
            });
            return most;
        };
        const double before = deviation();
        for (int i = 0; i < 3000; ++i) fluid.step();
        std::printf("%s: %.2e, then %.2e\n", std::string(name_of(collision)).c_str(),
                    before, deviation());
        EXPECT_LT(deviation(), before) << name_of(collision);
    }
}

}  // namespace
}  // namespace magfsi::fluid

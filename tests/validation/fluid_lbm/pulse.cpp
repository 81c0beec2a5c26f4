// SPDX-License-Identifier: GPL-2.0-or-later
// Pulsing flow between plates through an inlet whose velocity follows a course of time.
#include <complex>
#include <numbers>

#include "tests/unit/fluid_lbm/lattice_fluid.h"
#include "tests/validation/fluid_lbm/references.h"

namespace magfsi::fluid {
namespace {

constexpr double height_m = 1e-3, half_m = height_m / 2;
constexpr double fluid_viscosity = 1e-6;  // m2/s
constexpr double mean_speed_m_s = 1e-3;  // Reynolds number 1: no inertia but that of time
constexpr double womersley = 2;          // half_m sqrt(omega / nu)
constexpr double omega = womersley * womersley * fluid_viscosity / (half_m * half_m);

// Womersley, J. Physiol. 127 (1955) 553, between plates: the flow of a harmonic pressure
// gradient, given by the mean speed U sin(omega t) over the gap,
//   u = Im U e^(i omega t) (1 - cosh(k y) / cosh(k h)) / (1 - tanh(k h) / (k h)),
// k^2 = i omega / nu, y from the middle, h half the gap.
double exact(double y_m, double time_s) {
    using Complex = std::complex<double>;
    const Complex k = std::sqrt(Complex(0, omega / fluid_viscosity));
    const Complex shape = (1.0 - std::cosh(k * y_m) / std::cosh(k * half_m)) /
                          (1.0 - std::tanh(k * half_m) / (k * half_m));
    return mean_speed_m_s * std::imag(std::polar(1.0, omega * time_s) * shape);
}

// Root mean square error of u over its amplitude, over the gap and eight instants of the
// second half of the first period, in the middle of a channel two heights long. What the
// start leaves has died out by e^(-15) then (its slowest mode, tan(lambda) = lambda,
// falls at 20 nu / h^2); what the inlet's parabola differs from the flow falls by
// e^(-4.2) a height. The lattice's sound takes (omega L / c)^2 of the flow, which falls
// as the square of the spacing, too.
double error(int n) {
    constexpr double relaxation_time = 0.55;
    FluidConfig config;
    config.cells = {2 * n, 2, n};
    config.spacing_m = height_m / n;
    config.time_step_s = (relaxation_time - 0.5) / 3 * config.spacing_m *
                         config.spacing_m / fluid_viscosity;
    config.density_kg_m3 = 1000;
    config.viscosity_m2_s = fluid_viscosity;
    config.collision = Collision::trt;
    set_walls(config, 2);
    config.boundaries[0].kind = BoundaryKind::velocity_inlet;
    config.boundaries[0].inlet = {.velocity_m_s = {mean_speed_m_s, 0, 0},
                                  .profile = InletProfile::parabolic,
                                  .factor = [](double t) { return std::sin(omega * t); }};
    config.boundaries[1].kind = BoundaryKind::pressure_outlet;
    Fluid fluid(MPI_COMM_WORLD, config);
    const double period_s = 2 * std::numbers::pi / omega;
    double sum = 0;
    int step = 0;
    for (int instant = 0; instant < 8; ++instant) {
        const double until_s = (0.5 + instant / 16.0) * period_s;
        for (; step * config.time_step_s < until_s; ++step) fluid.step();
        const std::vector<double> u = velocity(fluid);
        for (int z = 0; z < n; ++z) {
            // Between the two cells on either side of the middle.
            const std::size_t cell = static_cast<std::size_t>(z) * 2 * 2 * n + n;
            const double here = 0.5 * (u[3 * cell] + u[3 * (cell - 1)]);
            const double y = (z + 0.5) * config.spacing_m - half_m;
            sum += std::pow(here - exact(y, step * config.time_step_s), 2);
        }
    }
    return std::sqrt(sum / (8 * n)) / mean_speed_m_s;
}

TEST(PulsingInlet, GivesWomersleysFlowAtSecondOrder) {
    std::vector<Refinement> grids;
    for (int n : {6, 12, 24}) grids.push_back({n, error(n)});
    EXPECT_GE(observed_order("Womersley between plates", grids), 1.9);
    EXPECT_LT(grids.back().error, 0.003);
}

}  // namespace
}  // namespace magfsi::fluid

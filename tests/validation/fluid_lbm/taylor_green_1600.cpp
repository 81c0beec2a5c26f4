// Taylor-Green vortex at Reynolds number 1600 on 128^3 cells, a quarter of what resolves
// it (relaxation time 0.5035): both collisions for low relaxation times stay stable
// through the breakdown into turbulence, and the peak of dissipation is near the spectral
// one (0.01286 at t = 8.97). Writes the curve as taylor_green_1600_NAME.csv. Takes a
// minute.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "tests/support/taylor_green_vortex.h"
#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

constexpr int n = 128;
constexpr double viscosity = 1.0 / 1600;  // speed, wave number and density are 1
constexpr double interval = 0.25;         // between samples
constexpr int steps_a_sample = 56;        // lattice speed 0.09
constexpr int samples = 41;               // to t = 10

FluidConfig vortex(Collision collision) {
    FluidConfig config;
    config.cells = {n, n, n};
    config.spacing_m = 2 * std::numbers::pi / n;
    config.time_step_s = interval / steps_a_sample;
    config.density_kg_m3 = 1;
    config.viscosity_m2_s = viscosity;
    config.collision = collision;
    start_as_taylor_green_vortex(config);
    return config;
}

class TaylorGreen1600 : public testing::TestWithParam<Collision> {};

TEST_P(TaylorGreen1600, StaysStableThroughItsPeak) {
    Fluid fluid(MPI_COMM_WORLD, vortex(GetParam()));
    std::vector<double> energy, enstrophy;
    for (int i = 0; i < samples; ++i) {
        const Totals totals = fluid.totals();
        energy.push_back(totals.kinetic_energy_j / totals.mass_kg);
        enstrophy.push_back(fluid.enstrophy_1_s2());
        for (int step = 0; step < steps_a_sample; ++step) fluid.step();
        int bad = fluid.diverged().has_value();
        MPI_Allreduce(MPI_IN_PLACE, &bad, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
        ASSERT_EQ(bad, 0) << "after t = " << (i + 1) * interval;
    }
    std::ofstream csv("taylor_green_1600_" + std::string(name_of(GetParam())) + ".csv");
    csv << "t,energy,minus_dE_dt,two_nu_enstrophy\n";
    double peak = 0, when = 0;
    for (int i = 1; i + 1 < samples; ++i) {
        const double loss = (energy[i - 1] - energy[i + 1]) / (2 * interval);
        csv << i * interval << ',' << energy[i] << ',' << loss << ','
            << 2 * viscosity * enstrophy[i] << '\n';
        if (loss > peak) {
            peak = loss;
            when = i * interval;
        }
    }
    std::printf("%s: peak of -dE/dt %.5f at t = %.2f; spectral 0.01286 at 8.97\n",
                name_of(GetParam()).data(), peak, when);
    // Not resolved: the grid ends at wave number 64, the flow's dissipation well beyond.
    // The bounds only tell the right course from a wrong one.
    EXPECT_NEAR(peak, 0.01286, 0.15 * 0.01286);
    EXPECT_NEAR(when, 8.97, 0.75);
}

INSTANTIATE_TEST_SUITE_P(Collisions, TaylorGreen1600,
                         testing::Values(Collision::trt,
                                         Collision::recursive_regularized));

}  // namespace
}  // namespace magfsi::fluid

// A plate set in motion at t = 0 over fluid at rest, the other plate at rest:
// u / U = z/H + sum 2 (-1)^n / (n pi) exp(-n^2 pi^2 nu t / H^2) sin(n pi z / H).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/fluid_lbm/lattice_fluid.h"
#include "tests/validation/fluid_lbm/observed_order.h"

namespace magfsi::fluid {
namespace {

constexpr double height_m = 1e-3;
constexpr double viscosity_m2_s = 1e-6;
constexpr double wall_speed_m_s = 1e-3;
constexpr double diffusion_times = 0.05;  // of the run: the layer fills half the gap

double exact(double z) {
    double u = z;
    for (int n = 1; n < 40; ++n) {
        const double k = n * std::numbers::pi;
        u += 2 * (n % 2 == 0 ? 1 : -1) / k * std::exp(-k * k * diffusion_times) *
             std::sin(k * z);
    }
    return u;
}

double error(int n, Collision collision) {
    FluidConfig config;
    config.cells = {4, 2, n};
    config.spacing_m = height_m / n;
    // tau is 0.8, so that a run has n^2 / 2 steps.
    config.time_step_s = 0.1 * config.spacing_m * config.spacing_m / viscosity_m2_s;
    config.density_kg_m3 = 1000;
    config.viscosity_m2_s = viscosity_m2_s;
    config.collision = collision;
    set_walls(config, 2);
    config.boundaries[5].wall_velocity_m_s = {wall_speed_m_s, 0, 0};
    Fluid fluid(MPI_COMM_WORLD, config);
    for (int i = 0; i < n * n / 2; ++i) fluid.step();
    const std::vector<double> u = velocity(fluid);
    double sum = 0;
    for (int z = 0; z < n; ++z) {
        sum += std::pow(u[3 * 8 * z] / wall_speed_m_s - exact((z + 0.5) / n), 2);
    }
    return std::sqrt(sum / n);
}

class StartingCouette : public testing::TestWithParam<Collision> {};

TEST_P(StartingCouette, IsSecondOrder) {
    std::vector<Refinement> grids;
    for (int n : {16, 32, 64}) grids.push_back({n, error(n, GetParam())});
    EXPECT_GE(observed_order(to_string(GetParam()).c_str(), grids), 1.9);
    EXPECT_LT(grids.back().error, 1e-3);  // of order 1/n^2
}

INSTANTIATE_TEST_SUITE_P(Collisions, StartingCouette,
                         testing::Values(Collision::bgk,
                                         Collision::recursive_regularized));

}  // namespace
}  // namespace magfsi::fluid

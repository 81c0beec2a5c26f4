// A shear wave u_x = U cos(k z) decays as exp(-nu k^2 t): measures the viscosity.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/fluid_lbm/lattice_fluid.h"
#include "tests/validation/fluid_lbm/observed_order.h"

namespace magfsi::fluid {
namespace {

// Relative error of the viscosity on n cells a wave length.
double viscosity_error(int n, double relaxation_time, Collision collision) {
    const double k = 2 * std::numbers::pi / n;
    constexpr double amplitude = 1e-4;
    FluidConfig config = lattice_fluid({4, 2, n}, relaxation_time, collision);
    config.initial_velocity = [&](const Vec3& x) {
        return Vec3{amplitude * std::cos(k * x[2]), 0, 0};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    const int steps = static_cast<int>(1 / (config.viscosity_m2_s * k * k));
    for (int i = 0; i < steps; ++i) fluid.step();
    const std::vector<double> u = velocity(fluid);
    double wave = 0;
    for (int z = 0; z < n; ++z) wave += 2.0 / n * u[3 * 8 * z] * std::cos(k * (z + 0.5));
    const double measured = -std::log(wave / amplitude) / (k * k * steps);
    return std::abs(measured / config.viscosity_m2_s - 1);
}

class ShearWave : public testing::TestWithParam<Collision> {};

TEST_P(ShearWave, DecaysWithTheGivenViscosity) {
    for (double tau : {0.51, 0.55, 0.8}) {
        std::vector<Refinement> grids;
        for (int n : {16, 32, 64})
            grids.push_back({n, viscosity_error(n, tau, GetParam())});
        const auto name = to_string(GetParam()) + " tau " + std::to_string(tau);
        EXPECT_GE(observed_order(name.c_str(), grids), 1.9);
        EXPECT_LT(grids.back().error, 2e-3);  // (k dx)^2 / 12 = 8e-4 and a factor of tau
    }
}

INSTANTIATE_TEST_SUITE_P(Collisions, ShearWave,
                         testing::Values(Collision::bgk,
                                         Collision::recursive_regularized));

}  // namespace
}  // namespace magfsi::fluid

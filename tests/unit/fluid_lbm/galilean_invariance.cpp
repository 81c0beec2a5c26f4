// A shear wave carried by a uniform wind decays and keeps its shape as at rest. The wind
// is n cells over the run, so that the wave returns to its place.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

constexpr int n = 32;
constexpr int steps = 640;
constexpr double wind = static_cast<double>(n) / steps;  // 0.05
constexpr double amplitude = 1e-3;

// Transverse velocity after the run over the initial amplitude: cosine and sine part.
std::array<double, 2> final_wave(Collision collision, double speed) {
    constexpr double k = 2 * std::numbers::pi / n;
    FluidConfig config = lattice_fluid({n, 4, 4}, 0.6, collision);
    config.initial_velocity = [speed](const Vec3& x) {
        return Vec3{speed, amplitude * std::cos(k * x[0]), 0};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    for (int i = 0; i < steps; ++i) fluid.step();
    const std::vector<double> u = velocity(fluid);
    std::array<double, 2> wave{};
    for (int x = 0; x < n; ++x) {
        wave[0] += 2.0 / n * u[3 * x + 1] * std::cos(k * (x + 0.5)) / amplitude;
        wave[1] += 2.0 / n * u[3 * x + 1] * std::sin(k * (x + 0.5)) / amplitude;
    }
    return wave;
}

class GalileanInvariance : public testing::TestWithParam<Collision> {};

TEST_P(GalileanInvariance, OfAShearWave) {
    const auto rest = final_wave(GetParam(), 0);
    const auto carried = final_wave(GetParam(), wind);
    std::printf("amplitude at rest %.5f, carried %.5f, out of phase %.5f\n", rest[0],
                carried[0], carried[1]);
    // The second-order equilibrium of BGK and TRT lacks the third moment: its viscosity
    // falls by 3 U^2 = 0.75 %, times an exponent of 0.83. The recursive third order
    // restores it for this flow up to dispersion, of order (k dx)^4.
    const bool recursive = GetParam() == Collision::recursive_regularized;
    EXPECT_NEAR(carried[0] / rest[0], 1, recursive ? 1e-3 : 0.008);
    // Two relaxation times: advection is exact to third order only for Lambda = 1/12; at
    // 3/16 the wave is shifted by (3/16 - 1/12) k^3 a cell and terms of higher order:
    // 0.025 over 32 cells in the lowest.
    const bool trt = GetParam() == Collision::trt;
    EXPECT_NEAR(carried[1] / rest[0], 0, trt ? 0.03 : 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Collisions, GalileanInvariance,
                         testing::Values(Collision::bgk, Collision::trt,
                                         Collision::recursive_regularized));

}  // namespace
}  // namespace magfsi::fluid

// Flow between plates at rest under a body force: u = G/(2 nu) z (H - z). Half-way
// bounce-back leaves a slip that depends on tau and falls with the square of the spacing,
// so tau is fixed (time step over spacing squared is constant).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fluid_lbm/lattice_fluid.h"
#include "tests/validation/fluid_lbm/observed_order.h"

namespace magfsi::fluid {
namespace {

constexpr double height_m = 1e-3;
constexpr double viscosity_m2_s = 1e-6;
constexpr double density_kg_m3 = 1000;
constexpr double top_speed_m_s = 1e-3;
constexpr double acceleration =
    8 * viscosity_m2_s * top_speed_m_s / (height_m * height_m);

double exact(double z) {
    return acceleration / (2 * viscosity_m2_s) * z * (height_m - z);
}

// Root mean square error over the top speed, of the steady flow.
double error(int n, double relaxation_time, Collision collision, int normal) {
    const int along = (normal + 1) % 3;
    FluidConfig config;
    config.cells = {2, 2, 2};
    config.cells[normal] = n;
    config.spacing_m = height_m / n;
    config.time_step_s = (relaxation_time - 0.5) / 3 * config.spacing_m *
                         config.spacing_m / viscosity_m2_s;
    config.density_kg_m3 = density_kg_m3;
    config.viscosity_m2_s = viscosity_m2_s;
    config.collision = collision;
    config.body_force_n_m3.emplace(Vec3{});
    (*config.body_force_n_m3)[along] = density_kg_m3 * acceleration;
    config.initial_velocity = [&](const Vec3& x) {
        Vec3 u{};
        u[along] = exact(x[normal]);
        return u;
    };
    set_walls(config, normal);
    Fluid fluid(MPI_COMM_WORLD, config);
    // Starting from the parabola, what is left of the difference to the discrete steady
    // state is exp(-pi^2) of it after a diffusion time.
    const double diffusion_time = height_m * height_m / viscosity_m2_s;
    const int steps = static_cast<int>(diffusion_time / config.time_step_s);
    for (int i = 0; i < steps; ++i) fluid.step();
    const std::vector<double> u = velocity(fluid);
    double sum = 0;
    const int stride = normal == 0 ? 1 : normal == 1 ? 2 : 4;  // cells
    for (int z = 0; z < n; ++z) {
        // The physical velocity includes half of the force of the step.
        const double here =
            u[3 * stride * z + along] + 0.5 * acceleration * config.time_step_s;
        sum += std::pow(here - exact((z + 0.5) * config.spacing_m), 2);
    }
    return std::sqrt(sum / n) / top_speed_m_s;
}

struct Case {
    Collision collision;
    int normal;
};

class Poiseuille : public testing::TestWithParam<Case> {};

TEST_P(Poiseuille, IsSecondOrder) {
    const auto [collision, normal] = GetParam();
    for (double tau : {0.55, 0.8}) {
        std::vector<Refinement> grids;
        for (int n : {8, 16, 32}) grids.push_back({n, error(n, tau, collision, normal)});
        const auto name = to_string(collision) + " across " + "xyz"[normal] + " tau " +
                          std::to_string(tau);
        EXPECT_GE(observed_order(name.c_str(), grids), 1.9);
        EXPECT_LT(grids.back().error, 1e-3);  // a slip of order 1/n^2
    }
}

INSTANTIATE_TEST_SUITE_P(Collisions, Poiseuille,
                         testing::Values(Case{Collision::bgk, 2}, Case{Collision::trt, 2},
                                         Case{Collision::recursive_regularized, 0},
                                         Case{Collision::recursive_regularized, 1},
                                         Case{Collision::recursive_regularized, 2}));

}  // namespace
}  // namespace magfsi::fluid

// SPDX-License-Identifier: GPL-2.0-or-later
// Orders of convergence of flows between plates and of a shear wave.
#include <numbers>
#include <tuple>

#include "tests/unit/fluid_lbm/lattice_fluid.h"
#include "tests/validation/fluid_lbm/references.h"

namespace magfsi::fluid {
namespace {

constexpr double height_m = 1e-3;
constexpr double fluid_viscosity = 1e-6;  // m2/s
constexpr double density_kg_m3 = 1000;

// n cells across the gap; the time step falls with the square of the spacing.
FluidConfig gap(const std::array<int, 3>& cells, int n, double relaxation_time,
                Collision collision) {
    FluidConfig config;
    config.cells = cells;
    config.spacing_m = height_m / n;
    config.time_step_s = (relaxation_time - 0.5) / 3 * config.spacing_m *
                         config.spacing_m / fluid_viscosity;
    config.density_kg_m3 = density_kg_m3;
    config.viscosity_m2_s = fluid_viscosity;
    config.collision = collision;
    return config;
}

// ---- Flow between plates at rest under a body force: u = G/(2 nu) z (H - z). Half-way
// bounce-back leaves a slip that depends on tau and falls with the square of the spacing,
// so tau is fixed.

constexpr double top_speed_m_s = 1e-3;
constexpr double acceleration =
    8 * fluid_viscosity * top_speed_m_s / (height_m * height_m);

double parabola(double z) {
    return acceleration / (2 * fluid_viscosity) * z * (height_m - z);
}

// Root mean square error over the top speed, of the steady flow.
double poiseuille_error(int n, double relaxation_time, Collision collision, int normal) {
    const int along = (normal + 1) % 3;
    std::array<int, 3> cells{2, 2, 2};
    cells[normal] = n;
    FluidConfig config = gap(cells, n, relaxation_time, collision);
    config.body_force_n_m3.emplace(Vec3{});
    (*config.body_force_n_m3)[along] = density_kg_m3 * acceleration;
    config.initial_velocity = [&](const Vec3& x) {
        Vec3 u{};
        u[along] = parabola(x[normal]);
        return u;
    };
    set_walls(config, normal);
    Fluid fluid(MPI_COMM_WORLD, config);
    // Starting from the parabola, what is left of the difference to the discrete steady
    // state is exp(-pi^2) of it after a diffusion time.
    const double diffusion_time = height_m * height_m / fluid_viscosity;
    const int steps = static_cast<int>(diffusion_time / config.time_step_s);
    for (int i = 0; i < steps; ++i) fluid.step();
    const std::vector<double> u = velocity(fluid);
    double sum = 0;
    const int stride = normal == 0 ? 1 : normal == 1 ? 2 : 4;  // cells
    for (int z = 0; z < n; ++z) {
        // The physical velocity includes half of the force of the step.
        const double here =
            u[3 * stride * z + along] + 0.5 * acceleration * config.time_step_s;
        sum += std::pow(here - parabola((z + 0.5) * config.spacing_m), 2);
    }
    return std::sqrt(sum / n) / top_speed_m_s;
}

class Poiseuille : public testing::TestWithParam<std::tuple<Collision, int>> {};

TEST_P(Poiseuille, IsSecondOrder) {
    const auto [collision, normal] = GetParam();
    for (double tau : {0.55, 0.8}) {
        std::vector<Refinement> grids;
        for (int n : {8, 16, 32})
            grids.push_back({n, poiseuille_error(n, tau, collision, normal)});
        const auto name = std::string(name_of(collision)) + " across " + "xyz"[normal] +
                          " tau " + std::to_string(tau);
        EXPECT_GE(observed_order(name.c_str(), grids), 1.9);
        EXPECT_LT(grids.back().error, 1e-3);  // a slip of order 1/n^2
    }
}

INSTANTIATE_TEST_SUITE_P(Collisions, Poiseuille,
                         testing::Values(std::tuple{Collision::bgk, 2},
                                         std::tuple{Collision::trt, 2},
                                         std::tuple{Collision::recursive_regularized, 0},
                                         std::tuple{Collision::recursive_regularized, 1},
                                         std::tuple{Collision::recursive_regularized, 2},
                                         std::tuple{Collision::recursive_mrt, 0},
                                         std::tuple{Collision::recursive_mrt, 1},
                                         std::tuple{Collision::recursive_mrt, 2}));

// ---- The same flow of fluids whose viscosity depends on the rate of shear: the stress
// is rho g |z - H/2| whatever the fluid, which gives the rate, and its integral the
// speed.

// The rate at which the law has this stress by density.
double shear_rate(const Rheology& rheology, double stress_m2_s2) {
    double low = 0, high = 1e7;
    while (high - low > 1e-14 * high) {
        const double middle = 0.5 * (low + high);
        (viscosity_m2_s(rheology, fluid_viscosity, middle) * middle < stress_m2_s2
             ? low
             : high) = middle;
    }
    return high;
}

constexpr double driving = 0.02;  // m/s2

std::vector<double> profile(const Rheology& rheology, int n) {
    constexpr int parts = 64;  // of half a cell; Simpson
    const double cell = height_m / n;
    std::vector<double> u(n);
    for (int z = 0; z < n; ++z) {
        const double to = std::abs((z + 0.5) * cell - height_m / 2);
        const int intervals = parts * (1 + static_cast<int>((height_m / 2 - to) / cell));
        const double step = (height_m / 2 - to) / intervals;
        for (int i = 0; i <= intervals; ++i) {
            const double weight = i == 0 || i == intervals ? 1 : i % 2 == 1 ? 4 : 2;
            u[z] += weight * step / 3 * shear_rate(rheology, driving * (to + i * step));
        }
    }
    return u;
}

// Root mean square error over the largest speed.
double profile_error(int n, double relaxation_time, Collision collision,
                     const Rheology& rheology) {
    FluidConfig config = gap({2, 2, n}, n, relaxation_time, collision);
    config.rheology = rheology;
    if (collision == Collision::trt) config.magic_number = 3.0 / 16;
    config.body_force_n_m3 = Vec3{density_kg_m3 * driving, 0, 0};
    const std::vector<double> exact = profile(rheology, n);
    config.initial_velocity = [&](const Vec3& x) {
        return Vec3{exact[static_cast<int>(x[2] / config.spacing_m)], 0, 0};
    };
    set_walls(config, 2);
    Fluid fluid(MPI_COMM_WORLD, config);
    // The slowest decay is that of the thickest fluid; see Poiseuille.
    const int steps =
        static_cast<int>(height_m * height_m / fluid_viscosity / config.time_step_s);
    for (int i = 0; i < steps; ++i) fluid.step();
    const std::vector<double> u = velocity(fluid);
    double sum = 0;
    for (int z = 0; z < n; ++z)
        sum += std::pow(u[12 * z] + 0.5 * driving * config.time_step_s - exact[z], 2);
    return std::sqrt(sum / n) / *std::ranges::max_element(exact);
}

class ShearDependentFlow : public testing::TestWithParam<Collision> {};

TEST_P(ShearDependentFlow, IsSecondOrder) {
    // At the walls the rate is 20 to 40 1/s, from which on Carreau's law is half way
    // down.
    const std::pair<const char*, Rheology> laws[] = {
        {"Carreau, thinning to a tenth", {Carreau{0.1e-6, 0.2, 0.4, 2}}},
        {"Carreau, Yasuda", {Carreau{0.3e-6, 0.5, 0.6, 1.2}}},
        {"Carreau, thickening", {Carreau{3e-6, 0.1, 0.5, 2}}},
        {"power law", {PowerLaw{0.6, 10, 0.05e-6, 4e-6}}}};
    for (const auto& [name, law] : laws) {
        std::vector<Refinement> grids;
        for (int n : {8, 16, 32})
            grids.push_back({n, profile_error(n, 0.8, GetParam(), law)});
        EXPECT_GE(
            observed_order(
                (std::string(name) + ", " + std::string(name_of(GetParam()))).c_str(),
                grids),
            1.8);
        EXPECT_LT(grids[1].error, 0.01);
    }
}

TEST_P(ShearDependentFlow, OfOneViscosityIsThatOfTheFluid) {
    std::vector<double> speeds[2];
    for (const bool by_law : {false, true}) {
        FluidConfig config = gap({2, 2, 16}, 16, 0.6, GetParam());
        config.body_force_n_m3 = Vec3{density_kg_m3 * driving, 0, 0};
        if (by_law) config.rheology = Rheology{Carreau{0.1e-6, 0.2, 1, 2}};
        set_walls(config, 2);
        Fluid fluid(MPI_COMM_WORLD, config);
        for (int i = 0; i < 200; ++i) fluid.step();
        speeds[by_law] = velocity(fluid);
    }
    const double most = *std::ranges::max_element(speeds[0]);
    for (std::size_t i = 0; i < speeds[0].size(); ++i)
        EXPECT_NEAR(speeds[0][i], speeds[1][i], 1e-12 * most);
}

INSTANTIATE_TEST_SUITE_P(Collisions, ShearDependentFlow,
                         testing::Values(Collision::trt, Collision::recursive_regularized,
                                         Collision::recursive_mrt));

// ---- A shear wave u_x = U cos(k z) decays as exp(-nu k^2 t): measures the viscosity.

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
        const auto name =
            std::string(name_of(GetParam())) + " tau " + std::to_string(tau);
        EXPECT_GE(observed_order(name.c_str(), grids), 1.9);
        EXPECT_LT(grids.back().error, 2e-3);  // (k dx)^2 / 12 = 8e-4 and a factor of tau
    }
}

INSTANTIATE_TEST_SUITE_P(Collisions, ShearWave,
                         testing::Values(Collision::bgk, Collision::recursive_regularized,
                                         Collision::recursive_mrt));

// ---- A plate set in motion at t = 0 over fluid at rest, the other plate at rest:
// u / U = z/H + sum 2 (-1)^n / (n pi) exp(-n^2 pi^2 nu t / H^2) sin(n pi z / H).

constexpr double wall_speed_m_s = 1e-3;
constexpr double diffusion_times = 0.05;  // of the run: the layer fills half the gap

double starting_profile(double z) {
    double u = z;
    for (int n = 1; n < 40; ++n) {
        const double k = n * std::numbers::pi;
        u += 2 * (n % 2 == 0 ? 1 : -1) / k * std::exp(-k * k * diffusion_times) *
             std::sin(k * z);
    }
    return u;
}

double couette_error(int n, Collision collision) {
    // At this relaxation time a run has n^2 / 2 steps.
    FluidConfig config = gap({4, 2, n}, n, 0.8, collision);
    set_walls(config, 2);
    config.boundaries[5].wall_velocity_m_s = {wall_speed_m_s, 0, 0};
    Fluid fluid(MPI_COMM_WORLD, config);
    for (int i = 0; i < n * n / 2; ++i) fluid.step();
    const std::vector<double> u = velocity(fluid);
    double sum = 0;
    for (int z = 0; z < n; ++z) {
        sum +=
            std::pow(u[3 * 8 * z] / wall_speed_m_s - starting_profile((z + 0.5) / n), 2);
    }
    return std::sqrt(sum / n);
}

class StartingCouette : public testing::TestWithParam<Collision> {};

TEST_P(StartingCouette, IsSecondOrder) {
    std::vector<Refinement> grids;
    for (int n : {16, 32, 64}) grids.push_back({n, couette_error(n, GetParam())});
    EXPECT_GE(observed_order(name_of(GetParam()).data(), grids), 1.9);
    EXPECT_LT(grids.back().error, 1e-3);  // of order 1/n^2
}

INSTANTIATE_TEST_SUITE_P(Collisions, StartingCouette,
                         testing::Values(Collision::bgk, Collision::recursive_regularized,
                                         Collision::recursive_mrt));

}  // namespace
}  // namespace magfsi::fluid

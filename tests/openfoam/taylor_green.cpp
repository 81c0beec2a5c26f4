// The two-dimensional Taylor-Green vortex decays as exp(-2 nu k^2 t), on one OpenFOAM
// rank and on several, across periodic sides that are cut between ranks; and beside our
// lattice on the same grid.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "adapters/openfoam/foam_fluid.h"
#include "fluid_lbm/fluid.h"

namespace magfsi {
namespace {

constexpr double length_m = 1, speed_m_s = 1, reynolds = 100;
constexpr double wave_number = 2 * std::numbers::pi / length_m;
constexpr double viscosity = speed_m_s / wave_number / reynolds;
constexpr double end_s = 0.5;  // half a turn

std::array<double, 3> flow(const std::array<double, 3>& x) {
    return {speed_m_s * std::cos(wave_number * x[0]) * std::sin(wave_number * x[2]), 0,
            -speed_m_s * std::sin(wave_number * x[0]) * std::cos(wave_number * x[2])};
}

double exact() {
    return std::exp(-4 * viscosity * wave_number * wave_number * end_s);
}

scene::Fluid box(int cells) {
    scene::Fluid fluid;
    fluid.solver = scene::FluidSolver::openfoam;
    fluid.spacing_m = length_m / cells;
    fluid.box_m = {length_m, 4 * fluid.spacing_m, length_m};
    fluid.density_kg_m3 = 1;
    fluid.viscosity_m2_s = viscosity;
    for (auto& side : fluid.boundaries) side.kind = fluid::BoundaryKind::periodic;
    return fluid;
}

// Energy left at the end over that at the start.
double openfoam_energy(int cells) {
    const double step_s = 0.2 * length_m / cells / speed_m_s;
    const auto folder = std::filesystem::current_path() / "taylor_green_case";
    openfoam::FoamFluid fluid(MPI_COMM_WORLD, box(cells), step_s, folder);
    fluid.start_from(&flow);
    const double start = fluid.totals().kinetic_energy_j;
    for (int step = 0; step < std::lround(end_s / step_s); ++step) fluid.advance();
    return fluid.totals().kinetic_energy_j / start;
}

double lattice_energy(int cells) {
    fluid::FluidConfig config;
    config.cells = {cells, 4, cells};
    config.spacing_m = length_m / cells;
    config.time_step_s = 0.02 * config.spacing_m / speed_m_s;
    config.density_kg_m3 = 1;
    config.viscosity_m2_s = viscosity;
    config.initial_velocity = &flow;
    fluid::Fluid fluid(MPI_COMM_WORLD, config);
    const double start = fluid.totals().kinetic_energy_j;
    for (int step = 0; step < std::lround(end_s / config.time_step_s); ++step)
        fluid.step();
    return fluid.totals().kinetic_energy_j / start;
}

TEST(OpenFoam, TaylorGreenVortexDecaysAtSecondOrder) {
    const double coarse = openfoam_energy(12) / exact() - 1;
    const double fine = openfoam_energy(24) / exact() - 1;
    RecordProperty("coarse", std::to_string(coarse));
    std::printf("openfoam, 12 and 24 cells: %+.4f %%, %+.4f %%\n", 100 * coarse,
                100 * fine);
    // Seen: 0.64 %. OpenFOAM's default correction of old fluxes would make it 8 %.
    EXPECT_LT(std::abs(fine), 0.01);
    // Order 2 is a factor of 4; the error of coupling pressure and velocity on one grid
    // is of higher order and still large on 12 cells.
    EXPECT_GT(std::abs(coarse / fine), 3.5);
}

TEST(OpenFoam, TaylorGreenVortexDecaysAsOnTheLattice) {
    const double foam = openfoam_energy(24) / exact() - 1;
    const double lattice = lattice_energy(24) / exact() - 1;
    std::printf("24 cells: openfoam %+.4f %%, lattice %+.4f %%\n", 100 * foam,
                100 * lattice);
    // Each within its own error of the exact law: 0.64 and 0.05 %.
    EXPECT_NEAR(foam, lattice, 0.01);
}

}  // namespace
}  // namespace magfsi

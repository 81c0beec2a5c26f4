// SPDX-License-Identifier: GPL-2.0-or-later
// The two-dimensional Taylor-Green vortex decays as exp(-2 nu k^2 t), on one OpenFOAM
// rank and on several, across periodic sides that are cut between ranks; and beside our
// lattice on the same grid.
#include <gtest/gtest.h>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include "adapters/solvers/openfoam/foam_fluid.h"
#include "fluid_lbm/fluid.h"

namespace magfsi {
namespace {

constexpr double length_m = 1, speed_m_s = 1, reynolds = 100;
constexpr double wave_number = 2 * std::numbers::pi / length_m;
constexpr double viscosity = speed_m_s / wave_number / reynolds;
constexpr double end_s = 0.5;  // half a turn

Vec3 flow(const Vec3& x) {
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

// Folder of a case. The tests of other numbers of ranks may run at the same time.
std::filesystem::path case_folder(const std::string& name) {
    int ranks = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    return std::filesystem::current_path() / (name + "_on_" + std::to_string(ranks));
}

// Energy left at the end over that at the start.
double openfoam_energy(int cells) {
    const double step_s = 0.2 * length_m / cells / speed_m_s;
    const auto folder = case_folder("taylor_green");
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

// A layer of force along its normal, across a closed box, is held by pressure: the fluid
// rests. Without balance between force and pressure the cells of the layer move, although
// nothing flows, and a sheet's markers take that for the fluid's motion.
constexpr int cells = 8;
constexpr double spacing_m = 1e-3, step_s = 1e-4, force_n_m3 = 100, density_kg_m3 = 1000;

scene::Fluid closed_box() {
    scene::Fluid fluid;
    fluid.solver = scene::FluidSolver::openfoam;
    fluid.spacing_m = spacing_m;
    fluid.box_m = {cells * spacing_m, cells * spacing_m, cells * spacing_m};
    fluid.density_kg_m3 = density_kg_m3;
    fluid.viscosity_m2_s = 1e-6;
    for (auto& side : fluid.boundaries) side.kind = fluid::BoundaryKind::no_slip;
    return fluid;
}

// The 3-point kernel's share of a marker in the middle of a cell, by distance in cells.
double share(int distance) {
    if (distance == 0) return 2.0 / 3;
    return std::abs(distance) == 1 ? 1.0 / 6 : 0;
}

// Largest speed after ten steps, over what the force would give a free fluid.
double speed_across(std::size_t axis) {
    const auto folder = case_folder("layer_of_force");
    openfoam::FoamFluid fluid(MPI_COMM_WORLD, closed_box(), step_s, folder);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const coupler::CellBox& own =
        fluid.grid().owned_by_rank[static_cast<std::size_t>(rank)].front();
    std::vector<coupler::GridRow> rows;
    std::vector<double> force;
    for (int z = own.lo[2]; z < own.hi[2]; ++z)
        for (int y = own.lo[1]; y < own.hi[1]; ++y) {
            rows.push_back({y, z, own.lo[0], own.hi[0]});
            for (int x = own.lo[0]; x < own.hi[0]; ++x) {
                const std::array<int, 3> at{x, y, z};
                for (std::size_t d = 0; d < 3; ++d)
                    force.push_back(d == axis ? force_n_m3 * share(at[d] - 3) : 0);
            }
        }
    for (int step = 0; step < 10; ++step) {
        fluid.set_force(rows, force);
        fluid.advance();
    }
    return fluid.totals().max_speed_m_s / (force_n_m3 / density_kg_m3 * 10 * step_s);
}

TEST(OpenFoam, PressureHoldsALayerOfForce) {
    // The pressure is solved to a residual of 1e-6. Without the balance it is 0.09.
    for (const std::size_t axis : {0U, 1U, 2U}) EXPECT_LT(speed_across(axis), 1e-4);
}

}  // namespace
}  // namespace magfsi

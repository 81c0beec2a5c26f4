// A layer of force along its normal, across a closed box, is held by pressure: the fluid
// rests. Without balance between force and pressure the cells of the layer move, although
// nothing flows, and a sheet's markers take that for the fluid's motion.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "adapters/openfoam/foam_fluid.h"

namespace magfsi {
namespace {

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
    const auto folder = std::filesystem::current_path() / "layer_of_force_case";
    openfoam::FoamFluid fluid(MPI_COMM_WORLD, closed_box(), step_s, folder);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const coupler::CellBox& own =
        fluid.grid().owned_by_rank[static_cast<std::size_t>(rank)];
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

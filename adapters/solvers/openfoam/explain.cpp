// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/openfoam/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "adapters/scene/effective.h"
#include "adapters/solvers/openfoam/inlet.h"
#include "adapters/solvers/openfoam/mesh.h"
#include "adapters/solvers/openfoam/obstacles.h"
#include "adapters/solvers/openfoam/user_files.h"
#include "base/fitted/constants.h"

namespace magfsi::openfoam {

namespace {

// Limit above which explain warns: the scheme of second order in time needs at least two
// steps per cell at the fastest place.
constexpr double max_courant = 0.5;
// Advice has three digits; whoever follows it may be beyond a limit by their rounding.
constexpr double rounded = 1.005;

// A line of the table: name and SI value.
std::string row(const char* name, const std::string& si) {
    return fmt::format("  {:<34} {:>14}\n", name, si);
}

// The user's dictionaries and the time folders.
std::string own_rows(const scene::OpenFoam& own) {
    std::string text;
    for (const auto& [into, file] :
         {std::pair{"fvSchemes", own.schemes}, std::pair{"fvSolution", own.solution},
          std::pair{"functions of controlDict", own.functions}})
        if (file) text += fmt::format("  {} merged into {}\n", *file, into);
    if (own.write)
        text +=
            row("time folders every", fmt::format("{:.4g} ms", own.write->every_s * 1e3));
    return text;
}

// How each obstacle is cut out of the mesh.
std::string obstacle_rows(const scene::Fluid& fluid, const BoxMesh& mesh) {
    const ObstaclePlan plan = plan_obstacles(fluid, mesh);
    std::string text;
    for (const CutBox& box : plan.cut)
        text += row(fluid.obstacles[box.obstacle].name.c_str(), "by the blocks");
    for (const std::size_t i : plan.snapped)
        text += row(fluid.obstacles[i].name.c_str(), "snappyHexMesh");
    if (!plan.snapped.empty()) point_in_fluid(fluid);  // refuses a box without fluid
    return text;
}

// Longest edge of any cell [m].
double largest_cell_m(const BoxMesh& mesh) {
    double largest = 0;
    for (const auto& planes : mesh.planes_m) {
        for (std::size_t i = 1; i < planes.size(); ++i)
            largest = std::max(largest, planes[i] - planes[i - 1]);
    }
    return largest;
}

}  // namespace

int most_ranks(const scene::Scene& scene) {
    return scene.fluid->obstacles.empty() ? std::numeric_limits<int>::max() : 1;
}

// The Reynolds number of a cell is U h / nu, its Courant number U dt / h.
std::string explain(const scene::Scene& scene, const bodies::Solids& /*solids*/,
                    int /*ranks*/) {
    const scene::Fluid& fluid = *scene.fluid;
    read_user_files(fluid);  // refuses entries that break the coupling
    const double step_s = *scene::coupled_step_s(scene);
    const BoxMesh mesh = to_mesh(fluid, 0, 1);
    for (int side = 0; side < 6; ++side)
        if (fluid.boundaries[side].kind == fluid::BoundaryKind::velocity_inlet)
            slab_shape(fluid, mesh, side);  // refuses an opening without a face
    refuse_inlets_behind_obstacles(fluid, mesh);
    const auto n = mesh_cells(mesh);
    const double cells = 1.0 * n[0] * n[1] * n[2];
    std::string text = "\nfluid (OpenFOAM, pimpleFoam)                     SI\n";
    text += row("spacing", fmt::format("{:.4g} mm", fluid.spacing_m * 1e3));
    if (fluid.grading)
        text += row("largest cell", fmt::format("{:.4g} mm", largest_cell_m(mesh) * 1e3));
    text += row("time step", fmt::format("{:.4g} us", step_s * 1e6));
    text += row("density", fmt::format("{:.5g} kg/m3", fluid.density_kg_m3));
    text += row("viscosity", fmt::format("{:.4g} mm2/s", fluid.viscosity_m2_s * 1e6));
    const double speed = fluid.expected_speed_m_s;
    const double courant = speed * step_s / fluid.spacing_m;
    const double grid_reynolds = speed * fluid.spacing_m / fluid.viscosity_m2_s;
    if (speed > 0) {
        text += row("expected speed", fmt::format("{:.4g} m/s", speed));
        text += row("Courant number", fmt::format("{:.4g}", courant));
        text += row("Reynolds number of a cell", fmt::format("{:.4g}", grid_reynolds));
    }
    text += fmt::format("  {} x {} x {} = {:.0f} cells, about {:.0f} MB\n", n[0], n[1],
                        n[2], cells, cells * fitted::openfoam_bytes_per_cell / 1e6);
    text += obstacle_rows(fluid, mesh);
    if (fluid.openfoam) text += own_rows(*fluid.openfoam);
    if (courant > max_courant * rounded) {
        text += fmt::format(
            "  warning: a Courant number of {:.3g} is inaccurate: take a time.step of "
            "{:.3g} us\n",
            courant, step_s * max_courant / courant * 1e6);
    }
    if (grid_reynolds > fitted::max_cell_reynolds * rounded) {
        text += fmt::format(
            "  warning: at a cell's Reynolds number of {:.3g} shear layers are not "
            "resolved: take a spacing of {:.3g} mm\n",
            grid_reynolds,
            fluid.spacing_m * fitted::max_cell_reynolds / grid_reynolds * 1e3);
    }
    if (const std::string fault = missing(); !fault.empty())
        text += fmt::format("  warning: {}\n", fault);
    return text;
}

}  // namespace magfsi::openfoam

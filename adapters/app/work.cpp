// SPDX-License-Identifier: GPL-2.0-or-later
// The work of a run, counted from the scene without running it. prediction.cpp multiplies
// it by the calibration.
#include "adapters/app/cost.h"

#include <algorithm>
#include <cmath>

#include "adapters/scene/effective.h"
#include "adapters/solvers/bodies/marker_placement.h"
#include "adapters/solvers/fluids/fluid_probes.h"
#include "adapters/solvers/lammps/substeps.h"
#include "adapters/solvers/lbm/scene_to_fluid.h"
#include "base/fitted/constants.h"
#include "fluid_lbm/config.h"

namespace magfsi::launch {

namespace {

// Number of outputs from time 0 to end_s, both included.
double rows(double end_s, double every_s) {
    return std::floor(end_s / every_s * (1 + 1e-9)) + 1;
}

// Bytes per cell of a field file, which stores single-precision numbers.
double bytes_per_cell(const std::vector<scene::FluidField>& fields) {
    double bytes = 0;
    for (const scene::FluidField field : fields) bytes += 4 * scene::components_of(field);
    return bytes;
}

// The obstacle force comes out of the bounce-back of each step and needs no pass over the
// cells.
void add_probes(const scene::Probes& probes, double end_s, FluidWork& work) {
    using Quantity = scene::FluidQuantity;
    work.probe_rows = rows(end_s, probes.every_s);
    for (const Quantity quantity : probes.fluid) {
        if (quantity == Quantity::enstrophy)
            work.enstrophy_rows = work.probe_rows;
        else if (quantity != Quantity::obstacle_force)
            work.sum_rows = work.probe_rows;
    }
    if (probes.energy_audit) work.sum_rows = work.probe_rows;
}

// Number of cells next to non-periodic sides; a cell in an edge counts for each of its
// sides.
double wall_cells(const fluid::FluidConfig& config) {
    double cells = 0;
    for (std::size_t side = 0; side < config.boundaries.size(); ++side) {
        if (config.boundaries[side].kind == fluid::BoundaryKind::periodic) continue;
        const std::size_t across = side / 2;
        cells += static_cast<double>(config.cells[(across + 1) % 3]) *
                 config.cells[(across + 2) % 3];
    }
    return cells;
}

// Adds the cell updates per step. A refined grid counts per step of its finest level,
// hence the factor for the coarse one.
void add_lattice(const scene::Scene& scene, const bodies::Solids& solids,
                 FluidWork& work) {
    const auto levels = lbm::level_configs(scene, solids);
    const fluid::FluidConfig& config = levels.front().front();
    const double coarse =
        std::ldexp(lbm::cells_of(levels.front()), 1 - static_cast<int>(levels.size()));
    work.cells = coarse + fitted::finer_cell_cost * (lbm::updated_cells(levels) - coarse);
    work.wall_cells = wall_cells(config);
    const fluid::Collision collision = fluid::choose_collision(config);
    work.recursive_collision = collision == fluid::Collision::recursive_regularized ||
                               collision == fluid::Collision::recursive_mrt;
    work.single_precision = scene.fluid->precision != fluid::Precision::double_;
}

// Work of the lattice, of probes and of field files.
FluidWork fluid_work(const scene::Scene& scene, const bodies::Solids& solids, int ranks) {
    FluidWork work;
    add_lattice(scene, solids, work);
    if (scene.probes && !fluids::fluid_columns(scene).empty())
        add_probes(*scene.probes, scene.time.end_s, work);
    if (scene.output.fluid) {
        work.files = rows(scene.time.end_s, scene.output.fluid->every_s);
        const auto& fields = scene.output.fluid->fields;
        work.bytes_per_cell = bytes_per_cell(fields);
        work.vorticity_files =
            std::ranges::find(fields, scene::FluidField::vorticity) != fields.end();
        if (work.vorticity_files) work.enstrophy_rows += work.files;
    }
    work.ranks = ranks;
    return work;
}

// Counts elements, markers and dipole pairs over all bodies.
StructureWork structure_work(const scene::Scene& scene, const bodies::Solids& solids,
                             int ranks) {
    StructureWork work;
    double magnets = 0, within = 0;
    for (std::size_t b = 0; b < solids.size(); ++b) {
        const structure::Body& solid = solids[b];
        work.elements += solid.mesh.elements.size();
        work.nodes += solid.mesh.nodes.size();
        const double magnetized = solid.magnetization_a_m.size();
        magnets += magnetized;
        within += magnetized * magnetized;
        if (scene.coupling)
            work.markers += bodies::place_markers(scene, b, solid.mesh).size();
    }
    if (scene.dipoles)
        work.dipoles = magnets * magnets - (scene.dipoles->within_bodies ? 0 : within);
    if (scene.probes) work.probe_rows = rows(scene.time.end_s, scene.probes->every_s);
    if (scene.output.structure)
        work.files = rows(scene.time.end_s, scene.output.structure->every_s);
    work.ranks = ranks;
    return work;
}

// Number of equilibria of a path.
PathWork path_work(const scene::Scene& scene) {
    PathWork work;
    work.points = std::round(scene.time.end_s / scene::path_step_s(scene));
    work.newton = by_newton(scene);
    return work;
}

}  // namespace

// The number of steps follows the structure's choice of the coupled step if there are
// bodies.
Work work_of(const scene::Scene& scene, const bodies::Solids& solids,
             const Ranks& ranks) {
    Work work;
    if (scene.fluid) work.fluid = fluid_work(scene, solids, ranks.at("fluid"));
    if (!scene.bodies.empty())
        work.structure = structure_work(scene, solids, ranks.at("structure"));
    if (scene.time.equilibrium) {
        work.path = path_work(scene);
        return work;
    }
    double step_s = scene.fluid ? *scene::coupled_step_s(scene) : 0;
    if (work.structure) {
        const lammps::Substeps substeps = lammps::choose_substeps(scene, solids);
        work.structure->substeps = substeps.count;
        step_s = substeps.coupled_step_s;
    }
    work.steps = std::round(scene.time.end_s / step_s);
    if (scene.coupling && scene.coupling->scheme == coupler::Scheme::implicit)
        work.iterations = fitted::usual_iterations;
    return work;
}

}  // namespace magfsi::launch

#include "adapters/magfsi/cost/prediction.h"

#include <algorithm>
#include <cmath>

#include "adapters/magfsi/mpi_job.h"

namespace magfsi::launch {

namespace {

// Files of elements: 8 corners and 9 + 4 numbers around them, as counted on a strip.
constexpr double bytes_per_element_file = 280;
constexpr double bytes_per_probe_row = 600;

// y over x on a line through the logarithms of two points; beyond them, held.
double between(double x, double x1, double y1, double x2, double y2) {
    if (x <= x1 || x1 == x2) return y1;
    if (x >= x2) return y2;
    const double part = std::log(x / x1) / std::log(x2 / x1);
    return y1 * std::pow(y2 / y1, part);
}

// Wall time of a cell's step: caches hold small lattices, memory bounds large ones.
double cell_step_s(const FluidWork& work, const Calibration& c) {
    const FluidSpeed *below = nullptr, *above = nullptr;
    int most_ranks = 1;
    for (const FluidSpeed& s : c.fluid) most_ranks = std::max(most_ranks, s.ranks);
    const int ranks = std::min(work.ranks, most_ranks);
    for (const FluidSpeed& s : c.fluid) {
        if (s.single_precision != work.single_precision) continue;
        if (s.ranks != (ranks > 1 ? most_ranks : 1)) continue;
        if (!below || s.cells < below->cells) below = &s;
        if (!above || s.cells > above->cells) above = &s;
    }
    if (!below) return 0;
    return between(work.cells, below->cells, below->s_per_cell_step, above->cells,
                   above->s_per_cell_step);
}

double fluid_s(const Work& work, const Calibration& c) {
    const FluidWork& f = *work.fluid;
    const double markers = work.structure ? work.structure->markers : 0;
    const double a_step =
        f.cells * cell_step_s(f, c) + markers * c.s_per_marker_step +
        ((f.recursive_regularized ? f.cells * c.s_per_cell_regularized : 0) +
         f.wall_cells * c.s_per_wall_cell) /
            f.ranks;
    return work.steps * work.iterations * a_step +
           f.sum_rows * f.cells * c.s_per_cell_row / f.ranks +
           f.enstrophy_rows * f.cells * c.s_per_cell_enstrophy / f.ranks +
           f.files * f.cells * f.bytes_a_cell * c.s_per_cell_byte;
}

// Of a coupled step, what neither side's work explains.
double exchange_s(const Work& work, const Calibration& c) {
    const bool shared = work.fluid->ranks + work.structure->ranks > available_cores();
    return shared ? c.s_per_coupled_step_shared +
                        work.fluid->cells * c.s_per_coupled_cell_shared
                  : c.s_per_coupled_step + work.fluid->cells * c.s_per_coupled_cell;
}

// Ranks share elements and markers, and exchange the nodes between them.
double substep_s(const StructureWork& s, const Calibration& c) {
    return c.s_per_substep + (s.ranks > 1 ? c.s_per_substep_exchange : 0) +
           (s.elements * c.s_per_element_substep + s.markers * c.s_per_marker_substep) /
               s.ranks;
}

double structure_s(const Work& work, const Calibration& c) {
    const StructureWork& s = *work.structure;
    return work.steps * work.iterations * s.substeps * substep_s(s, c) +
           s.probe_rows * c.s_per_probe_row + s.files * s.elements * c.s_per_element_file;
}

// The cost of a point grows as a power of the nodes, through the two that were measured.
double newton_s(const Work& work, const Calibration& c) {
    const StructureWork& s = *work.structure;
    if (c.newton.size() < 2) return 0;
    const NewtonSpeed &a = c.newton.front(), &b = c.newton.back();
    const double power =
        std::log(b.s_per_point / a.s_per_point) / std::log(b.nodes / a.nodes);
    return work.path->points * a.s_per_point * std::pow(s.nodes / a.nodes, power) +
           s.files * s.elements * c.s_per_element_file;
}

// Passing: what a cell takes while it is probed or written.
double passing_bytes(const FluidWork& f, const Calibration& c) {
    const double curl = f.enstrophy_rows > 0 ? c.bytes_per_cell_curl : 0;
    if (f.files == 0) return curl;
    return std::max(
        curl, c.bytes_per_cell_file + (f.vorticity_files ? c.bytes_per_cell_curl : 0));
}

void add_memory(const Work& work, const Calibration& c, Prediction& p) {
    if (work.structure) {
        const StructureWork& s = *work.structure;
        const bool newton = work.path && work.path->newton;
        p.structure_bytes =
            s.ranks * (newton ? c.newton_bytes : c.lammps_bytes) +
            (s.files > 0 ? c.structure_file_bytes : 0) +
            s.elements * (newton ? c.newton_bytes_per_element : c.bytes_per_element) +
            s.markers * c.bytes_per_marker;
        p.disk_bytes += s.files * s.elements * bytes_per_element_file +
                        s.probe_rows * bytes_per_probe_row;
    }
    if (!work.fluid) return;
    const FluidWork& f = *work.fluid;
    p.fluid_bytes = f.ranks * (work.structure ? c.coupled_fluid_bytes : c.fluid_bytes) +
                    f.cells * c.bytes_per_cell * (f.single_precision ? 0.5 : 1) +
                    f.cells * passing_bytes(f, c);
    p.disk_bytes += f.files * f.cells * f.bytes_a_cell;
    if (!work.structure) p.disk_bytes += f.probe_rows * bytes_per_probe_row;
}

}  // namespace

Prediction predict(const Work& work, const Calibration& c) {
    Prediction p;
    add_memory(work, c, p);
    if (work.path) {
        if (work.path->newton) p.wall_s = p.structure_s = newton_s(work, c);
        return p;
    }
    if (work.structure) p.structure_s = structure_s(work, c);
    if (work.fluid) p.fluid_s = fluid_s(work, c);
    if (work.fluid && work.structure)
        p.exchange_s = work.steps * work.iterations * exchange_s(work, c);
    const double structure = p.structure_s.value_or(0), fluid = p.fluid_s.value_or(0);
    p.wall_s = (work.at_once ? std::max(structure, fluid) : structure + fluid) +
               p.exchange_s.value_or(0);
    return p;
}

Work on_ranks(Work work, const Ranks& ranks) {
    if (work.fluid) work.fluid->ranks = ranks.at("fluid");
    if (work.structure) work.structure->ranks = ranks.at("structure");
    return work;
}

namespace {

// Those worth a look: one rank a core at most, and Newton's method has one.
std::vector<Ranks> other_ranks(const Work& work, const Ranks& ranks) {
    std::vector<Ranks> all;
    if (work.path && work.path->newton) return all;
    const std::string role = work.fluid ? "fluid" : "structure";
    for (int n = 1; n <= available_cores(); ++n) {
        all.push_back(ranks);
        if (work.structure) all.back()["structure"] = 1;
        all.back()[role] = n;
    }
    return all;
}

}  // namespace

std::optional<Prediction> prediction(const scene::Scene& scene, const Ranks& ranks) {
    if (scene.fluid && scene.fluid->solver == scene::FluidSolver::openfoam)
        return std::nullopt;
    const auto calibration = read_calibration();
    if (!calibration) return std::nullopt;
    return predict(work_of(scene, ranks), *calibration);
}

std::optional<std::pair<Ranks, Prediction>> faster_ranks(const scene::Scene& scene,
                                                         const Ranks& ranks) {
    const auto now = prediction(scene, ranks);
    if (!now || !now->wall_s) return std::nullopt;
    constexpr double worth_it =
        0.85;  // of the time: less is within the prediction's error
    double least_s = worth_it * *now->wall_s;
    const Work work = work_of(scene, ranks);
    const Calibration calibration = *read_calibration();
    std::optional<std::pair<Ranks, Prediction>> best;
    for (const Ranks& other : other_ranks(work, ranks)) {
        const Prediction p = predict(on_ranks(work, other), calibration);
        if (!p.wall_s || *p.wall_s >= least_s) continue;
        least_s = *p.wall_s;
        best = {other, p};
    }
    return best;
}

}  // namespace magfsi::launch

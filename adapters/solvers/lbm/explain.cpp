// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lbm/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "adapters/scene/effective.h"
#include "adapters/solvers/bodies/marker_placement.h"
#include "adapters/solvers/bodies/scene_to_body.h"
#include "adapters/solvers/lbm/lattice_values.h"
#include "adapters/solvers/lbm/scene_to_fluid.h"
#include "base/fitted/constants.h"
#include "coupler/exchange/exchange.h"
#include "coupler/immersed_boundary/conditioning.h"
#include "coupler/immersed_boundary/marker_stencil.h"
#include "fluid_lbm/boundary/sides.h"
#include "fluid_lbm/config.h"
#include "fluid_lbm/obstacle/obstacles.h"
#include "fluid_lbm/parallel/decomposition.h"
#include "fluid_lbm/streaming/kernel_choice.h"
#include "structure/lammps/placement.h"

namespace magfsi::lbm {

namespace {

// Positions [m] and fluid volumes [m3] of the markers of all bodies, by marker.
struct Markers {
    std::vector<fluid::Vec3> at_m;
    std::vector<double> volume_m3;
};

// The markers at the start of the run. A body that starts bent (initial.relaxed) is taken
// in its flat shape, which needs no equilibrium to be computed.
Markers markers_of(const scene::Scene& scene, const bodies::Solids& solids) {
    Markers all;
    for (std::size_t b = 0; scene.coupling && b < solids.size(); ++b) {
        structure::Body placed = solids[b];
        structure::Placement placement = scene.bodies[b].initial;
        placement.relaxed.reset();
        placed.mesh.nodes = structure::placed_nodes(placed, placement, {0, 2});
        for (const bodies::PlacedMarker& marker :
             bodies::place_markers(scene, b, solids[b].mesh)) {
            const structure::Vec3 at = structure::position(placed.mesh, marker.point);
            // A marker on the border of several elements is listed once for each of them;
            // its parts are joined.
            const double same_m = 1e-9 * scene.fluid->spacing_m;
            if (!all.at_m.empty() &&
                structure::distance_m(all.at_m.back(), at) < same_m) {
                all.volume_m3.back() += marker.volume_m3;
                continue;
            }
            all.at_m.push_back(at);
            all.volume_m3.push_back(marker.volume_m3);
        }
    }
    return all;
}

// Bytes per cell of the fields made from the populations: float in files, double in
// memory.
constexpr double file_vector = 12, file_scalar = 4, velocity_field = 24;

double field_bytes(scene::FluidField field) {
    return scene::components_of(field) == 1 ? file_scalar : file_vector;
}

// Bytes per cell needed beside the field itself while it is made: the other result of the
// sweep, or the velocities of which the curl is taken.
double while_made(scene::FluidField field) {
    switch (field) {
        case scene::FluidField::velocity:
            return file_scalar;
        case scene::FluidField::density:
            return file_vector;
        case scene::FluidField::vorticity:
            return velocity_field;
        case scene::FluidField::pressure:
        case scene::FluidField::obstacle:
            break;
    }
    return 0;
}

// Peak bytes per cell while the fields of one instant are made one after the other and
// held until they are written.
double output_bytes_per_cell(const scene::FluidOutput& output) {
    double held = 0, peak = 0;
    for (const scene::FluidField field : output.fields) {
        held += field_bytes(field);
        peak = std::max(peak, held + while_made(field));
    }
    return peak;
}

// True if the enstrophy is probed: the only sum that needs the velocity field, because it
// contains derivatives.
bool has_enstrophy(const scene::Scene& scene) {
    return scene.probes && std::ranges::any_of(scene.probes->fluid, [](auto quantity) {
               return quantity == scene::FluidQuantity::enstrophy;
           });
}

// True if the implicit scheme keeps a copy of the whole fluid, as it does where more than
// collision and streaming changes populations in a step.
bool keeps_all(const scene::Scene& scene, const fluid::FluidConfig& config) {
    const bool implicit =
        scene.coupling && scene.coupling->scheme == coupler::Scheme::implicit;
    return implicit && !fluid::sweep_is_all(config);
}

// Bytes per marker of a fluid rank: a stencil, a position, a share and a flag in both
// sets of touched rows; three vectors as received, three as used, the answer, a force and
// a velocity.
constexpr double marker_bytes =
    2 * (sizeof(coupler::MarkerStencil) + sizeof(coupler::Vec3) + sizeof(double) + 1) +
    9 * sizeof(coupler::Vec3);

// Bytes of the force rows: three numbers per cell, with the mean slack of half as many
// rows again that a growing array holds.
double forced_rows_bytes(double markers, int nx, bool single_precision) {
    return 1.5 * fitted::rows_per_marker * markers * 3 * nx *
           (single_precision ? sizeof(float) : sizeof(double));
}

// Number of markers that all fluid ranks hold together. Markers near a cut are known to
// the ranks on both of its sides and count for each.
double known_markers(const scene::Scene& scene, const fluid::Decomposition& parts,
                     std::span<const fluid::Vec3> markers_m) {
    const coupler::Grid grid{
        scene.fluid->finest_spacing_m(), parts.cells, parts.periodic, {}};
    const auto kernel = scene.coupling->immersed_boundary.kernel;
    std::int64_t known = 0;
    for (const fluid::CellBox& box : parts.boxes) {
        known += std::ranges::count_if(markers_m, [&](const fluid::Vec3& at) {
            return coupler::may_touch(grid, kernel, {box.lo, box.hi}, at);
        });
    }
    return known;
}

// Estimated memory [bytes] of the fluid participant, beside its program and libraries.
struct FluidMemory {
    double populations = 0;  // all ranks together
    // Memory of the effects that the scene names. That in `held` is kept for the whole
    // run; that in `passing` is needed for moments, one after the other, so that only the
    // largest counts.
    std::vector<std::pair<std::string, double>> held, passing;

    double peak() const {
        double all = populations, largest = 0;
        for (const auto& part : held) all += part.second;
        for (const auto& part : passing) largest = std::max(largest, part.second);
        return all + largest;
    }
};

// Bytes of the populations of one grid, summed over its ranks, as the solver allocates
// them.
double populations_bytes(const fluid::FluidConfig& config, int ranks) {
    const auto parts =
        fluid::decompose(config.cells, fluid::periodic_axes(config), ranks);
    double bytes = 0;
    for (int rank = 0; rank < ranks; ++rank) {
        const fluid::RowLayout rows = parts.layout(rank);
        bytes +=
            fluid::Populations::bytes_of(rows.nx, rows.row_count(), config.precision);
    }
    return bytes;
}

// Memory from the sizes that the solver will allocate; markers_m: positions of the
// markers at the start. The rows that bodies touch depend on their motion: the estimate
// is for a slightly bent sheet.
FluidMemory fluid_memory(const scene::Scene& scene, const LevelConfigs& levels, int ranks,
                         std::span<const fluid::Vec3> markers_m) {
    const auto& config = levels.front().front();
    const auto& n = config.cells;
    const double cells = 1.0 * n[0] * n[1] * n[2];
    const auto parts = fluid::decompose(n, fluid::periodic_axes(config), ranks);
    FluidMemory memory;
    for (std::size_t l = 1; l < levels.size(); ++l) {
        double bytes = 0;
        for (const fluid::FluidConfig& patch : levels[l])
            bytes += populations_bytes(patch, ranks);
        memory.held.emplace_back(fmt::format("level {}", l), bytes);
    }
    // Cells of a velocity field, which has a ghost layer in y and z.
    double ghosted_cells = 0;
    for (int rank = 0; rank < ranks; ++rank) {
        const fluid::RowLayout rows = parts.layout(rank);
        memory.populations +=
            fluid::Populations::bytes_of(rows.nx, rows.row_count(), config.precision);
        ghosted_cells += 1.0 * rows.nx * (rows.ny + 2) * (rows.nz + 2);
    }
    if (!config.obstacles.empty())
        memory.held.emplace_back("map of the obstacles", cells * sizeof(short));
    if (!markers_m.empty())
        memory.held.emplace_back(
            "markers and the rows that they push",
            known_markers(scene, parts, markers_m) * marker_bytes +
                forced_rows_bytes(static_cast<double>(markers_m.size()), n[0],
                                  config.precision == fluid::Precision::float_));
    if (keeps_all(scene, config))
        memory.held.emplace_back("the implicit scheme's copy", memory.populations);
    if (has_enstrophy(scene))
        memory.passing.emplace_back("the probe of the enstrophy",
                                    ghosted_cells * velocity_field);
    if (scene.output.fluid)
        memory.passing.emplace_back("fields in files",
                                    cells * output_bytes_per_cell(*scene.output.fluid));
    return memory;
}

// The condition number of the marker system, a measure of how far markers crowd; printed
// for forcing no_slip only.
std::string conditioning(const scene::Scene& scene, const fluid::FluidConfig& config,
                         const Markers& markers) {
    if (!config.holds_no_slip || markers.at_m.empty()) return "";
    std::array<int, 3> cells = config.cells;
    for (int& n : cells) n *= scene.fluid->coupled_steps_in_one();
    const coupler::Grid grid{
        scene.fluid->finest_spacing_m(), cells, fluid::periodic_axes(config), {}};
    return fmt::format(
        "  condition number of the marker system: about {:.2g}\n",
        coupler::condition_number(grid, scene.coupling->immersed_boundary.kernel,
                                  markers.at_m, markers.volume_m3));
}

std::string memory(const FluidMemory& m) {
    std::string text =
        fmt::format("  memory: {:.1f} MB of populations", m.populations / 1e6);
    for (const auto& [what, bytes] : m.held)
        text += fmt::format(", {:.1f} MB for {}", bytes / 1e6, what);
    for (const auto& [what, bytes] : m.passing)
        text += fmt::format(", {:.1f} MB at times for {}", bytes / 1e6, what);
    return text + fmt::format("; at most {:.1f} MB beside the program\n", m.peak() / 1e6);
}

// The finer levels: their patches, spacings, steps and relaxation times, and the number
// of cell updates saved against a uniform grid of the finest spacing.
std::string refinement(const LevelConfigs& levels) {
    std::string text;
    for (std::size_t l = 1; l < levels.size(); ++l) {
        const fluid::FluidConfig& c = levels[l].front();
        std::string patches;
        for (const fluid::FluidConfig& patch : levels[l])
            patches += fmt::format("{}{} x {} x {}", patches.empty() ? "" : " and ",
                                   patch.cells[0], patch.cells[1], patch.cells[2]);
        text += fmt::format(
            "  level {}: {} cells of {:.4g} mm, step {:.4g} us, relaxation time {:.5g}, "
            "{}\n",
            l, patches, c.spacing_m * 1e3, c.time_step_s * 1e6, fluid::relaxation_time(c),
            name_of(fluid::choose_collision(c)));
    }
    const double updated = updated_cells(levels);
    double uniform = 1;
    for (const int cells : levels.front().front().cells)
        uniform *= std::ldexp(cells, static_cast<int>(levels.size()) - 1);
    return text + fmt::format(
                      "  {:.0f} cells are updated in a coupled step; a grid as fine "
                      "everywhere has {:.0f}, {:.3g} times as many\n",
                      updated, uniform, uniform / updated);
}

// The flow [mm3/s] through each side with an inlet, after its ramp and without its
// variation in time.
std::string inlets(const fluid::FluidConfig& config) {
    std::optional<fluid::SolidMap> map;
    std::string text;
    for (int side = 0; side < 6; ++side) {
        const double flow_m3_s = fluid::inflow_m3_s(config, side);
        if (flow_m3_s == 0) continue;
        double share = 1;
        if (!config.obstacles.empty()) {
            if (!map)
                map.emplace(config, fluid::make_solids(config),
                            CellBox{{0, 0, 0}, config.cells});
            share = fluid::share_past_obstacles(config, *map, side);
        }
        text += fmt::format(
            "  flow {} by {}: {:.5g} mm3/s{}\n", flow_m3_s > 0 ? "in" : "out",
            scene::names<scene::Face>[static_cast<std::size_t>(side)],
            share * std::abs(flow_m3_s) * 1e9,
            share < 1 ? fmt::format("; obstacles keep {:.3g} % off", 100 * (1 - share))
                      : "");
    }
    return text;
}

// A warning for each plane of a probe that has no fluid cell.
std::string planes_in_obstacles(const scene::Scene& scene,
                                const fluid::FluidConfig& config) {
    if (!scene.probes || config.obstacles.empty()) return {};
    std::optional<fluid::SolidMap> map;
    std::string text;
    for (const scene::IntegralProbe& probe : scene.probes->integrals) {
        const auto* plane = std::get_if<scene::FluidPlane>(&probe.over);
        if (plane == nullptr) continue;
        CellBox layer{{0, 0, 0}, config.cells};
        if (!map) map.emplace(config, fluid::make_solids(config), layer);
        const auto a = static_cast<std::size_t>(plane->axis);
        layer.lo[a] = std::clamp(static_cast<int>(plane->at_m / config.spacing_m), 0,
                                 config.cells[a] - 1);
        layer.hi[a] = layer.lo[a] + 1;
        bool has_fluid = false;
        fluid::for_each_cell(layer, [&](const fluid::Cell& cell) {
            has_fluid = has_fluid || !map->solid(cell);
        });
        if (!has_fluid)
            text += fmt::format(
                "  warning: the plane of probes.integrals.{} lies within obstacles, and "
                "its flow and pressure are 0\n",
                probe.name);
    }
    return text;
}

}  // namespace

std::string explain(const scene::Scene& scene, const bodies::Solids& solids, int ranks) {
    const scene::Fluid& fluid = *scene.fluid;
    const auto config = to_config(scene, *scene::coupled_step_s(scene));
    fluid::check(config);
    fluid::check_obstacles(config);
    const LatticeValues v = lattice_values(fluid, config);
    const auto& n = config.cells;
    const double cells = 1.0 * n[0] * n[1] * n[2];
    std::string text = table(fluid, v);
    text += life_of_sound(fluid, v) + sound(fluid, v, scene.time.end_s);
    text += fmt::format("  collision {}\n", fluid::collision_reason(config));
    text += fmt::format("  {} x {} x {} = {:.0f} cells\n", n[0], n[1], n[2], cells);
    text += inlets(config) + planes_in_obstacles(scene, config);
    const auto levels = level_configs(scene, solids);
    if (fluid.refinement) text += refinement(levels);
    const Markers markers = markers_of(scene, solids);
    return text + memory(fluid_memory(scene, levels, ranks, markers.at_m)) +
           conditioning(scene, config, markers) + warnings(scene, v);
}

}  // namespace magfsi::lbm

#include "adapters/lbm/explain.h"

#include <fmt/format.h>

#include <cmath>

#include "adapters/bodies/marker_placement.h"
#include "adapters/bodies/scene_to_body.h"
#include "adapters/lbm/fluid_memory.h"
#include "adapters/lbm/scene_to_fluid.h"
#include "adapters/scene/effective.h"
#include "fluid_lbm/config.h"
#include "structure/lammps/placement.h"

namespace magfsi::lbm {

namespace {

// The lattice's compressibility error is of the order of the Mach number squared.
constexpr double most_mach = 0.17;  // 3 %
// Below, the viscous length is far below a cell: only regularised or filtered collisions
// stay stable. Above 1, the error at walls grows with (tau - 1/2)^2.
constexpr double least_tau = 0.501, most_tau = 1.0;
// Perturbations of odd modes then live for ten steps and grow in fast flows.
constexpr double least_odd_rate = 0.1;
// Velocity differences across a cell that viscosity can still even out.
constexpr double most_grid_reynolds = 50;

struct LatticeValues {
    double spacing_m, step_s, tau, mach = 0, grid_reynolds = 0, speed = 0;
    double odd_rate = 1;  // of trt
};

LatticeValues lattice_values(const scene::Fluid& fluid,
                             const fluid::FluidConfig& config) {
    LatticeValues v{fluid.spacing_m, config.time_step_s, fluid::relaxation_time(config)};
    if (fluid::choose_collision(config) == fluid::Collision::trt)
        v.odd_rate = fluid::odd_rate(config);
    v.speed = fluid.expected_speed_m_s * v.step_s / v.spacing_m;
    v.mach = v.speed * std::sqrt(3.0);
    v.grid_reynolds = fluid.expected_speed_m_s * fluid.spacing_m / fluid.viscosity_m2_s;
    return v;
}

std::string table(const scene::Fluid& fluid, const LatticeValues& v) {
    std::string text =
        "\nfluid (lattice-Boltzmann, D3Q19)           SI            lattice\n";
    const auto row = [&](const char* name, const std::string& si, double lattice) {
        text += fmt::format("  {:<34} {:>14} {:>12.5g}\n", name, si, lattice);
    };
    row("spacing", fmt::format("{:.4g} mm", v.spacing_m * 1e3), 1);
    row("time step", fmt::format("{:.4g} us", v.step_s * 1e6), 1);
    row("density", fmt::format("{:.5g} kg/m3", fluid.density_kg_m3), 1);
    row("viscosity", fmt::format("{:.4g} mm2/s", fluid.viscosity_m2_s * 1e6),
        (v.tau - 0.5) / 3);
    row("speed of sound",
        fmt::format("{:.4g} m/s", v.spacing_m / v.step_s / std::sqrt(3.0)),
        1 / std::sqrt(3.0));
    if (fluid.expected_speed_m_s > 0) {
        row("expected speed", fmt::format("{:.4g} m/s", fluid.expected_speed_m_s),
            v.speed);
        row("Mach number", "", v.mach);
        row("Reynolds number of a cell", "", v.grid_reynolds);
    }
    row("relaxation time", "", v.tau);
    return text;
}

// Where they start, but for a body that comes bent.
std::vector<fluid::Vec3> markers_m(const scene::Scene& scene) {
    std::vector<fluid::Vec3> all;
    for (std::size_t b = 0; scene.coupling && b < scene.bodies.size(); ++b) {
        const scene::Body& body = scene.bodies[b];
        structure::Body placed = bodies::to_body(body);
        structure::Placement placement = body.initial;
        placement.relaxed.reset();
        placed.mesh.nodes = structure::placed_nodes(placed, placement, {0, 2});
        for (const bodies::PlacedMarker& marker : bodies::place_markers(
                 body, scene.coupling->immersed_boundary, scene.fluid->spacing_m,
                 static_cast<int>(b), bodies::spans_fluid(*scene.fluid, body)))
            all.push_back(structure::position(placed.mesh, marker.point));
    }
    return all;
}

std::string memory(const scene::Scene& scene, int ranks) {
    const FluidMemory m = fluid_memory(scene, ranks, markers_m(scene));
    std::string text =
        fmt::format("  memory: {:.1f} MB of populations", m.populations / 1e6);
    for (const auto& [what, bytes] : m.held)
        text += fmt::format(", {:.1f} MB for {}", bytes / 1e6, what);
    for (const auto& [what, bytes] : m.passing)
        text += fmt::format(", {:.1f} MB at times for {}", bytes / 1e6, what);
    return text + fmt::format("; at most {:.1f} MB beside the program\n", m.peak() / 1e6);
}

std::string warnings(const scene::Scene& scene, const LatticeValues& v) {
    std::string text;
    const auto warn = [&](const std::string& line) {
        text += "  warning: " + line + "\n";
    };
    if (v.mach > most_mach) {
        const double factor = most_mach / v.mach;
        warn(
            fmt::format("a Mach number of {:.3g} makes an error of {:.2g} %: take {}",
                        v.mach, 100 * v.mach * v.mach,
                        scene.time.step_s
                            ? fmt::format("time.step: {:.3g} us", v.step_s * factor * 1e6)
                            : fmt::format("lattice_speed: {:.3g}",
                                          scene.fluid->lattice_speed * factor)));
    }
    if (v.tau > most_tau) {
        warn(
            fmt::format("a relaxation time of {:.3g} is inaccurate at walls: take a step "
                        "of {:.3g} us",
                        v.tau, v.step_s * (most_tau - 0.5) / (v.tau - 0.5) * 1e6));
    }
    if (v.odd_rate < least_odd_rate) {
        warn(fmt::format(
            "magic_number lets odd modes decay by {:.2g} a step only, and trt tends to "
            "diverge: leave it out, or take {:.2g}",
            v.odd_rate, (v.tau - 0.5) / 2));
    }
    if (v.tau < least_tau) {
        // With the step from the lattice speed, tau - 1/2 grows as 1 / spacing.
        warn(fmt::format(
            "a relaxation time of {:.5g} leaves little viscosity to the grid: "
            "take a spacing of {:.3g} mm or less",
            v.tau, v.spacing_m * (v.tau - 0.5) / (least_tau - 0.5) * 1e3));
    }
    if (v.grid_reynolds > most_grid_reynolds && scene.fluid->smagorinsky_constant == 0) {
        warn(fmt::format(
            "at a cell's Reynolds number of {:.3g} shear layers are not "
            "resolved: take a spacing of {:.3g} mm, or smagorinsky: "
            "{{constant: 0.1}}",
            v.grid_reynolds, v.spacing_m * most_grid_reynolds / v.grid_reynolds * 1e3));
    }
    return text;
}

}  // namespace

std::string explain(const scene::Scene& scene, int ranks) {
    const scene::Fluid& fluid = *scene.fluid;
    const auto config = to_config(fluid, *scene::coupled_step_s(scene));
    fluid::check(config);
    const LatticeValues v = lattice_values(fluid, config);
    const auto& n = config.cells;
    const double cells = static_cast<double>(n[0]) * n[1] * n[2];
    std::string text = table(fluid, v);
    text += fmt::format("  collision {}\n", fluid::collision_reason(config));
    text += fmt::format("  {} x {} x {} = {:.0f} cells\n", n[0], n[1], n[2], cells);
    return text + memory(scene, ranks) + warnings(scene, v);
}

}  // namespace magfsi::lbm

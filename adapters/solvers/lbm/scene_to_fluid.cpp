// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lbm/scene_to_fluid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "adapters/scene/effective.h"
#include "structure/lammps/placement.h"

namespace magfsi::lbm {

namespace {

// The vortex of Taylor and Green with the pressure of the incompressible flow, rho
// U^2 / 16 (cos 2kx + cos 2ky) (cos 2kz + 2).
void start_as_taylor_green(fluid::FluidConfig& config, const scene::Fluid& fluid) {
    const double speed_m_s = fluid.taylor_green->speed_m_s;
    const double k = 2 * std::numbers::pi / fluid.box_m[0];
    const double pressure_pa = fluid.density_kg_m3 * speed_m_s * speed_m_s / 16;
    config.initial_velocity = [=](const fluid::Vec3& x) {
        const double u = speed_m_s * std::cos(k * x[2]);
        return fluid::Vec3{u * std::sin(k * x[0]) * std::cos(k * x[1]),
                           -u * std::cos(k * x[0]) * std::sin(k * x[1]), 0};
    };
    config.initial_pressure = [=](const fluid::Vec3& x) {
        return pressure_pa * (std::cos(2 * k * x[0]) + std::cos(2 * k * x[1])) *
               (std::cos(2 * k * x[2]) + 2);
    };
}

}  // namespace

// A coarsest level takes coupled_steps_in_one() coupled steps at once.
fluid::FluidConfig to_config(const scene::Scene& scene, double coupled_step_s) {
    const scene::Fluid& fluid = *scene.fluid;
    fluid::FluidConfig config;
    static_cast<fluid::Options&>(config) = fluid;
    for (std::size_t d = 0; d < 3; ++d) {
        config.cells[d] = std::lround(fluid.box_m[d] / fluid.spacing_m);
    }
    config.spacing_m = fluid.spacing_m;
    config.time_step_s = coupled_step_s * fluid.coupled_steps_in_one();
    if (fluid.initial_velocity_m_s) {
        const auto velocity = *fluid.initial_velocity_m_s;
        config.initial_velocity = [velocity](const fluid::Vec3&) { return velocity; };
    }
    config.holds_no_slip = scene.coupling && scene.coupling->immersed_boundary.forcing ==
                                                 coupler::Forcing::no_slip;
    config.expected_speed_m_s = fluid.expected_speed_m_s;
    config.measures_planes =
        scene.probes && std::ranges::any_of(scene.probes->integrals, [](const auto& one) {
            return std::holds_alternative<scene::FluidPlane>(one.over);
        });
    if (fluid.taylor_green) start_as_taylor_green(config, fluid);
    return config;
}

// The margin around the bodies is in cells of the finest level but one, hence twice the
// finest spacing.
fluid::RefinedConfig to_refined_config(const scene::Scene& scene, double coupled_step_s) {
    const scene::Fluid& fluid = *scene.fluid;
    fluid::RefinedConfig config;
    config.coarse = to_config(scene, coupled_step_s);
    config.rule.levels = fluid.refinement->levels;
    config.least_margin_cells = scene::least_margin_cells(scene);
    config.obstacle_forces =
        scene.probes &&
        std::ranges::count(scene.probes->fluid, scene::FluidQuantity::obstacle_force) > 0;
    if (fluid.refinement->box_m) {
        config.rule = {.levels = config.rule.levels, .slack_cells = 0, .follows = false};
        return config;
    }
    const double cell_m = 2 * fluid.finest_spacing_m();
    config.rule.margin_cells =
        fluid.refinement->margin_m
            ? static_cast<int>(std::ceil(*fluid.refinement->margin_m / cell_m - 1e-9))
            : config.least_margin_cells;
    return config;
}

std::vector<fluid::BodyBox> refined_parts_m(const scene::Scene& scene,
                                            const bodies::Solids& solids) {
    if (scene.fluid->refinement->box_m) return {*scene.fluid->refinement->box_m};
    return boxes_of_bodies_m(scene, solids);
}

std::vector<fluid::BodyBox> boxes_of_bodies_m(const scene::Scene& scene,
                                              const bodies::Solids& solids) {
    constexpr double most = std::numeric_limits<double>::max();
    std::vector<fluid::BodyBox> parts;
    for (std::size_t b = 0; b < solids.size(); ++b) {
        fluid::BodyBox& part = parts.emplace_back(fluid::BodyBox{
            fluid::Vec3{most, most, most}, fluid::Vec3{-most, -most, -most}});
        structure::Placement placement = scene.bodies[b].initial;
        placement.relaxed.reset();
        for (const auto& node : structure::placed_nodes(solids[b], placement, {0, 2})) {
            part = {lower(part[0], node), higher(part[1], node)};
        }
    }
    return parts;
}

LevelConfigs level_configs(const scene::Scene& scene, const bodies::Solids& solids) {
    const double step_s = *scene::coupled_step_s(scene);
    LevelConfigs levels{{to_config(scene, step_s)}};
    if (!scene.fluid->refinement) return levels;
    const fluid::RefinedConfig config = to_refined_config(scene, step_s);
    levels.resize(1 + config.rule.levels);
    const auto nests = fluid::place_nests(config.coarse, config.rule,
                                          refined_parts_m(scene, solids), nullptr);
    if (!config.rule.follows && !solids.empty())
        fluid::refuse_bodies_at_sides(config.coarse, config.rule,
                                      config.least_margin_cells,
                                      boxes_of_bodies_m(scene, solids), *nests);
    for (const fluid::NestPlaces& nest : *nests) {
        for (std::size_t i = 0; i < nest.size(); ++i) {
            auto& level = levels[i + 1];
            level.push_back(
                fluid::config_at(config.coarse, nest[i], static_cast<int>(i) + 1));
            if (config.rule.follows && config.obstacle_forces)
                fluid::refuse_cut_obstacles(level.back(),
                                            fluid::make_solids(level.back()), nest[i]);
        }
    }
    return levels;
}

double cells_of(const std::vector<fluid::FluidConfig>& level) {
    double cells = 0;
    for (const fluid::FluidConfig& grid : level)
        cells += 1.0 * grid.cells[0] * grid.cells[1] * grid.cells[2];
    return cells;
}

double updated_cells(const LevelConfigs& levels) {
    double cells = 0, per_step = std::ldexp(2, -static_cast<int>(levels.size()));
    for (const auto& level : levels) {
        cells += per_step * cells_of(level);
        per_step *= 2;
    }
    return cells;
}

}  // namespace magfsi::lbm

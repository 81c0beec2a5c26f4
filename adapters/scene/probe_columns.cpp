#include "adapters/scene/probe_columns.h"

namespace magfsi::scene {

namespace {

void add_vector(std::vector<std::string>& columns, const std::string& name,
                const std::string& unit) {
    for (const char axis : {'x', 'y', 'z'}) {
        columns.push_back(name + "_" + axis + "[" + unit + "]");
    }
}

void add_plane(std::vector<std::string>& columns, const std::string& name) {
    columns.push_back(name + ".flow[m3/s]");
    add_vector(columns, name + ".momentum_flux", "N");
    columns.push_back(name + ".pressure[Pa]");
}

const char* column(FluidQuantity quantity) {
    switch (quantity) {
        case FluidQuantity::kinetic_energy:
            return "kinetic_energy[J]";
        case FluidQuantity::enstrophy:
            return "enstrophy[1/s^2]";
        case FluidQuantity::mass:
            return "mass[kg]";
        case FluidQuantity::max_speed:
            return "max_speed[m/s]";
        case FluidQuantity::obstacle_force:
            break;  // several columns an obstacle
    }
    return "";
}

}  // namespace

std::vector<std::string> fluid_columns(const Scene& scene) {
    std::vector<std::string> columns;
    if (!scene.probes) return columns;
    for (const auto quantity : scene.probes->fluid) {
        if (quantity != FluidQuantity::obstacle_force) {
            columns.emplace_back(column(quantity));
            continue;
        }
        for (const fluid::Obstacle& obstacle : scene.fluid->obstacles) {
            columns.push_back(obstacle.name + ".drag[N]");
            columns.push_back(obstacle.name + ".lift[N]");
            add_vector(columns, obstacle.name + ".force", "N");
        }
    }
    for (const IntegralProbe& integral : scene.probes->integrals) {
        if (std::holds_alternative<FluidPlane>(integral.over))
            add_plane(columns, integral.name);
    }
    if (scene.fluid && scene.probes->energy_audit)
        columns.emplace_back("audit.fluid_kinetic[J]");
    return columns;
}

std::vector<std::string> interface_columns(const Scene& scene) {
    if (!scene.probes || !scene.probes->interface_balance) return {};
    return {"interface.momentum_mismatch[1]", "interface.power_mismatch[1]"};
}

}  // namespace magfsi::scene

#include "adapters/scene/probe_columns.h"

namespace magfsi::scene {

namespace {

void add_vector(std::vector<std::string>& columns, const std::string& name,
                const std::string& unit) {
    for (const char axis : {'x', 'y', 'z'}) {
        columns.push_back(name + "_" + axis + "[" + unit + "]");
    }
}

void add_body(std::vector<std::string>& columns, const std::string& body,
              BodyQuantity quantity) {
    using Q = BodyQuantity;
    switch (quantity) {
        case Q::com:
            add_vector(columns, body + ".com", "m");
            break;
        case Q::speed:
            add_vector(columns, body + ".speed", "m/s");
            break;
        case Q::shape:
            columns.push_back(body + ".end_to_end[m]");
            columns.push_back(body + ".mid_rise[m]");
            columns.push_back(body + ".bend[rad]");
            break;
        case Q::max_displacement:
            columns.push_back(body + ".max_displacement[m]");
            break;
        case Q::fluid_force:
            add_vector(columns, body + ".fluid_force", "N");
            break;
        case Q::energy:
            columns.push_back(body + ".energy_elastic[J]");
            columns.push_back(body + ".energy_kinetic[J]");
            columns.push_back(body + ".work_magnetic[J]");
            break;
    }
}

void add_part(std::vector<std::string>& columns, const std::string& name, bool in_fluid) {
    for (const char axis : {'x', 'y', 'z'}) columns.push_back(name + ".u" + axis + "[m]");
    add_vector(columns, name + ".momentum", "kg m/s");
    if (in_fluid) add_vector(columns, name + ".fluid_force", "N");
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

std::vector<std::string> body_columns(const Scene& scene) {
    std::vector<std::string> columns;
    if (!scene.probes) return columns;
    if (scene.magnetic_field) columns.emplace_back("field[T]");
    for (const Body& body : scene.bodies) {
        for (const auto quantity : scene.probes->bodies)
            add_body(columns, body.name, quantity);
    }
    for (const PointProbe& point : scene.probes->points) {
        add_vector(columns, point.name, "m");
        for (const char axis : {'x', 'y', 'z'}) {
            columns.push_back(point.name + "_u" + axis + "[m]");
        }
    }
    for (const IntegralProbe& integral : scene.probes->integrals) {
        if (std::holds_alternative<BodyPart>(integral.over))
            add_part(columns, integral.name, scene.fluid.has_value());
    }
    return columns;
}

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

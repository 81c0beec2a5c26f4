#include "adapters/lbm/fluid_probes.h"

#include <algorithm>
#include <cmath>

namespace magfsi::lbm {

namespace {

std::size_t largest_axis(const scene::Vec3& v) {
    std::size_t axis = 0;
    for (std::size_t d = 1; d < 3; ++d) {
        if (std::abs(v[d]) > std::abs(v[axis])) axis = d;
    }
    return axis;
}

std::size_t flow_axis(const scene::Fluid& fluid) {
    for (const fluid::Boundary& side : fluid.boundaries) {
        if (side.kind == fluid::BoundaryKind::velocity_inlet)
            return largest_axis(side.inlet.velocity_m_s);
    }
    if (fluid.body_force_n_m3) return largest_axis(*fluid.body_force_n_m3);
    if (fluid.initial_velocity_m_s) return largest_axis(*fluid.initial_velocity_m_s);
    return 0;
}

void add_forces(std::vector<double>& values, const scene::Fluid& config,
                const fluid::Fluid& fluid) {
    const ForceAxes axes = force_axes(config);
    for (const fluid::Vec3& force : fluid.obstacle_forces()) {
        values.push_back(force[axes.drag]);
        values.push_back(force[axes.lift]);
        values.insert(values.end(), force.begin(), force.end());
    }
}

void add_plane(std::vector<double>& values, const fluid::PlaneFlow& through) {
    values.push_back(through.flow_m3_s);
    values.insert(values.end(), through.momentum_flux_n.begin(),
                  through.momentum_flux_n.end());
    values.push_back(through.pressure_pa);
}

}  // namespace

ForceAxes force_axes(const scene::Fluid& fluid) {
    ForceAxes axes;
    axes.drag = flow_axis(fluid);
    const std::size_t first = axes.drag == 2 ? 1 : 2;
    const std::size_t second = 3 - axes.drag - first;
    const auto periodic = [&](std::size_t axis) {
        return fluid.boundaries[2 * axis].kind == fluid::BoundaryKind::periodic;
    };
    axes.lift = periodic(first) && !periodic(second) ? second : first;
    return axes;
}

std::vector<double> probe_values(const scene::Scene& scene, const fluid::Fluid& fluid) {
    // A sweep over all cells: only for what is summed over them.
    const auto is_sum = [](auto quantity) {
        return quantity != scene::FluidQuantity::obstacle_force &&
               quantity != scene::FluidQuantity::enstrophy;
    };
    const bool sums =
        scene.probes->energy_audit || std::ranges::any_of(scene.probes->fluid, is_sum);
    const fluid::Totals totals = sums ? fluid.totals() : fluid::Totals{};
    std::vector<double> values;
    for (const auto quantity : scene.probes->fluid) {
        switch (quantity) {
            case scene::FluidQuantity::kinetic_energy:
                values.push_back(totals.kinetic_energy_j);
                break;
            case scene::FluidQuantity::enstrophy:
                values.push_back(fluid.enstrophy_1_s2());
                break;
            case scene::FluidQuantity::mass:
                values.push_back(totals.mass_kg);
                break;
            case scene::FluidQuantity::max_speed:
                values.push_back(totals.max_speed_m_s);
                break;
            case scene::FluidQuantity::obstacle_force:
                add_forces(values, *scene.fluid, fluid);
                break;
        }
    }
    for (const scene::IntegralProbe& integral : scene.probes->integrals) {
        if (const auto* plane = std::get_if<scene::FluidPlane>(&integral.over))
            add_plane(values, fluid.plane_flow(plane->axis, plane->at_m));
    }
    if (scene.probes->energy_audit) values.push_back(totals.kinetic_energy_j);
    return values;
}

}  // namespace magfsi::lbm

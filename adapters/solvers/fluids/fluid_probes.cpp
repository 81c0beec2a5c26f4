// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/fluids/fluid_probes.h"

#include <cmath>
#include <functional>
#include <map>
#include <optional>

namespace magfsi::fluids {

namespace {

using scene::FluidQuantity;

// The quantities that the columns of one row share. Each is computed when the first
// column asks for it. Computing is collective, so all ranks must ask in the same order.
class Sample {
  public:
    explicit Sample(FluidSolver& fluid) : fluid_(fluid) {}

    const FluidTotals& totals() {
        if (!totals_) totals_ = fluid_.totals();
        return *totals_;
    }
    // A quantity that is none of the totals.
    double of_solver(FluidQuantity quantity) { return fluid_.quantity(quantity); }
    // Force of the fluid on an obstacle [N], by its index in the scene.
    const scene::Vec3& force_on(std::size_t obstacle) {
        if (!forces_) forces_ = fluid_.obstacle_forces();
        return forces_->at(obstacle);
    }
    // Flow through a plane of the scene, which is also the key of the map.
    const PlaneFlow& through(const scene::FluidPlane& plane) {
        const auto [at, first] = planes_.try_emplace(&plane);
        if (first) at->second = fluid_.plane_flow(plane.axis, plane.at_m);
        return at->second;
    }

  private:
    FluidSolver& fluid_;
    std::optional<FluidTotals> totals_;
    std::optional<std::vector<scene::Vec3>> forces_;
    std::map<const scene::FluidPlane*, PlaneFlow> planes_;
};

// A column of probes.csv: its name with the unit, and the function that takes its value
// from a sample.
struct Column {
    std::string name;
    std::function<double(Sample&)> value;
};
using Columns = std::vector<Column>;

// A scalar of the whole fluid. A new scalar is an entry in the table below (a new vector
// is a line in columns_of), a word of scene::FluidQuantity and, if it is none of the
// totals, a case in quantity() of the solvers that compute it.
struct Quantity {
    FluidQuantity quantity;
    const char* column;
    double (*value)(Sample&);
};
constexpr Quantity quantities[] = {
    {FluidQuantity::kinetic_energy, "kinetic_energy[J]",
     [](Sample& s) { return s.totals().kinetic_energy_j; }},
    {FluidQuantity::enstrophy, "enstrophy[1/s^2]",
     [](Sample& s) { return s.of_solver(FluidQuantity::enstrophy); }},
    {FluidQuantity::mass, "mass[kg]", [](Sample& s) { return s.totals().mass_kg; }},
    {FluidQuantity::max_speed, "max_speed[m/s]",
     [](Sample& s) { return s.totals().max_speed_m_s; }},
};

// Index of the component with the largest magnitude.
std::size_t largest_axis(const scene::Vec3& v) {
    std::size_t axis = 0;
    for (std::size_t d = 1; d < 3; ++d) {
        if (std::abs(v[d]) > std::abs(v[axis])) axis = d;
    }
    return axis;
}

// The direction of drag: the axis along which the first inlet's velocity, the body force
// or the initial velocity is largest, in this order of preference; x if there is none.
std::size_t drag_axis(const scene::Fluid& fluid) {
    for (const auto& side : fluid.boundaries) {
        if (side.kind == fluid::BoundaryKind::velocity_inlet)
            return largest_axis(side.inlet.velocity_m_s);
    }
    if (fluid.body_force_n_m3) return largest_axis(*fluid.body_force_n_m3);
    if (fluid.initial_velocity_m_s) return largest_axis(*fluid.initial_velocity_m_s);
    return 0;
}

// The direction of lift: of the two axes normal to the drag, the one whose sides are not
// periodic. If both or neither are periodic it is the one that comes first in the order
// z, y, x.
std::size_t lift_axis(const scene::Fluid& fluid, std::size_t drag) {
    const std::size_t first = drag == 2 ? 1 : 2;
    const std::size_t second = 3 - drag - first;
    const auto periodic = [&](std::size_t axis) {
        return fluid.boundaries[2 * axis].kind == fluid::BoundaryKind::periodic;
    };
    return periodic(first) && !periodic(second) ? second : first;
}

// Adds the three components of a vector as columns NAME_x[UNIT], NAME_y, NAME_z;
// value(sample) returns the vector.
template <class Value>
void add_vector(Columns& columns, const std::string& name, const char* unit,
                Value value) {
    for (std::size_t d = 0; d < 3; ++d) {
        columns.push_back({name + '_' + "xyz"[d] + '[' + unit + ']',
                           [value, d](Sample& s) { return value(s)[d]; }});
    }
}

// Drag, lift and the force vector of each obstacle [N]: drag and lift are its components
// along the flow and across it.
void add_forces(Columns& columns, const scene::Fluid& fluid) {
    const std::size_t drag = drag_axis(fluid);
    const std::size_t lift = lift_axis(fluid, drag);
    for (std::size_t i = 0; i < fluid.obstacles.size(); ++i) {
        const std::string& name = fluid.obstacles[i].name;
        const auto force = [i](Sample& s) { return s.force_on(i); };
        columns.push_back({name + ".drag[N]", [=](Sample& s) { return force(s)[drag]; }});
        columns.push_back({name + ".lift[N]", [=](Sample& s) { return force(s)[lift]; }});
        add_vector(columns, name + ".force", "N", force);
    }
}

// Flow, momentum flux and mean pressure through a plane. The columns keep a
// reference to the plane.
void add_plane(Columns& columns, const std::string& name,
               const scene::FluidPlane& plane) {
    columns.push_back(
        {name + ".flow[m3/s]", [&](Sample& s) { return s.through(plane).flow_m3_s; }});
    add_vector(columns, name + ".momentum_flux", "N",
               [&](Sample& s) { return s.through(plane).momentum_flux_n; });
    columns.push_back({name + ".pressure[Pa]",
                       [&](Sample& s) { return s.through(plane).pressure_pa; }});
}

// The columns that the scene asks for, in their order in the file. They refer to the
// scene, which must outlive them.
Columns columns_of(const scene::Scene& scene) {
    Columns columns;
    if (!scene.probes) return columns;
    for (const FluidQuantity wanted : scene.probes->fluid) {
        if (wanted == FluidQuantity::obstacle_force) add_forces(columns, *scene.fluid);
        if (wanted == FluidQuantity::momentum)
            add_vector(columns, "momentum", "kg m/s",
                       [](Sample& s) { return s.totals().momentum_kg_m_s; });
        for (const Quantity& q : quantities)
            if (q.quantity == wanted) columns.push_back({q.column, q.value});
    }
    for (const scene::IntegralProbe& integral : scene.probes->integrals) {
        if (const auto* plane = std::get_if<scene::FluidPlane>(&integral.over))
            add_plane(columns, integral.name, *plane);
    }
    if (scene.fluid && scene.probes->energy_audit) {
        columns.push_back({"audit.fluid_sound[J]",
                           [](Sample& s) { return s.totals().sound_energy_j; }});
        columns.push_back({"audit.fluid_kinetic[J]",
                           [](Sample& s) { return s.totals().kinetic_energy_j; }});
    }
    return columns;
}

}  // namespace

std::vector<std::string> fluid_columns(const scene::Scene& scene) {
    std::vector<std::string> names;
    for (const Column& column : columns_of(scene)) names.push_back(column.name);
    return names;
}

std::vector<double> fluid_values(const scene::Scene& scene, FluidSolver& fluid) {
    Sample sample(fluid);
    std::vector<double> values;
    for (const Column& column : columns_of(scene)) values.push_back(column.value(sample));
    return values;
}

std::vector<std::string> interface_columns(const scene::Scene& scene) {
    if (!scene.probes || !scene.probes->interface_balance) return {};
    return {"interface.momentum_mismatch[1]", "interface.power_mismatch[1]",
            "interface.impulse_x[N s]", "interface.impulse_y[N s]",
            "interface.impulse_z[N s]"};
}

}  // namespace magfsi::fluids

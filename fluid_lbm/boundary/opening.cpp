#include "fluid_lbm/boundary/opening.h"

#include <cmath>
#include <numbers>

#include "fluid_lbm/units.h"

namespace magfsi::fluid {

namespace {

std::array<int, 2> in_plane(int side) {
    const int axis = axis_of(side);
    return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
}

double falloff(InletProfile profile, double s) {
    if (profile == InletProfile::uniform) return 1;
    return std::max(0.0, 1 - std::pow(s, profile == InletProfile::parabolic ? 2 : 8));
}

bool is_wall(const FluidConfig& config, int side) {
    return config.boundaries[side].kind == BoundaryKind::no_slip;
}

// Profile of an opening that is the whole side, along one axis of it. A plane of symmetry
// at one end doubles the width.
double falloff_between_sides(const FluidConfig& config, InletProfile profile, int axis,
                             double at) {
    const bool low = is_wall(config, 2 * axis), high = is_wall(config, 2 * axis + 1);
    if (!low && !high) return 1;
    const double width = config.cells[axis];
    if (low && high) return falloff(profile, std::abs(2 * at / width - 1));
    return falloff(profile, low ? 1 - at / width : at / width);
}

// Of the cell whose face lies at `at`, in-plane coordinates in cells; not yet scaled.
double shape_of(const FluidConfig& config, int side, const std::array<double, 2>& at) {
    const Boundary& boundary = config.boundaries[side];
    const InletProfile profile = boundary.inlet.profile;
    const std::array<int, 2> axes = in_plane(side);
    if (!boundary.patch) {
        return falloff_between_sides(config, profile, axes[0], at[0]) *
               falloff_between_sides(config, profile, axes[1], at[1]);
    }
    const double dx = config.spacing_m;
    if (const auto* disc = std::get_if<Disc>(&*boundary.patch)) {
        return falloff(profile, 2 *
                                    std::hypot(at[0] * dx - disc->centre_m[0],
                                               at[1] * dx - disc->centre_m[1]) /
                                    disc->diameter_m);
    }
    const Rectangle& r = std::get<Rectangle>(*boundary.patch);
    double product = 1;
    for (int i = 0; i < 2; ++i) {
        product *=
            falloff(profile, std::abs(at[i] * dx - r.centre_m[i]) * 2 / r.size_m[i]);
    }
    return product;
}

std::array<double, 2> face_centre(int side, const Cell& cell) {
    const std::array<int, 2> axes = in_plane(side);
    return {cell[axes[0]] + 0.5, cell[axes[1]] + 0.5};
}

CellBox whole_side(const FluidConfig& config, int side) {
    return *cells_at_side({{0, 0, 0}, config.cells}, config.cells, side);
}

std::function<Vec3(const Cell&)> steady_velocity(const FluidConfig& config, int side) {
    double sum = 0;
    int count = 0;
    for_each_cell(whole_side(config, side), [&](const Cell& cell) {
        if (!is_open(config, side, cell)) return;
        sum += shape_of(config, side, face_centre(side, cell));
        ++count;
    });
    Vec3 peak = config.boundaries[side].inlet.velocity_m_s;
    for (double& u : peak) u *= count / sum / units(config).velocity_m_s();
    return [config, side, peak](const Cell& cell) {
        const double shape = shape_of(config, side, face_centre(side, cell));
        return Vec3{peak[0] * shape, peak[1] * shape, peak[2] * shape};
    };
}

void describe_inlet(const FluidConfig& config, int side, LatticeSide& lattice) {
    const Inlet& inlet = config.boundaries[side].inlet;
    const Units unit = units(config);
    if (inlet.course) {
        lattice.course = [course = inlet.course, unit, side, end = config.cells](
                             const Cell& cell, double time) {
            Vec3 at;
            for (int a = 0; a < 3; ++a) at[a] = (cell[a] + 0.5) * unit.spacing_m;
            const int axis = axis_of(side);
            at[axis] = side % 2 == 0 ? 0 : end[axis] * unit.spacing_m;
            Vec3 u = course(at, time * unit.time_step_s);
            for (double& component : u) component /= unit.velocity_m_s();
            return u;
        };
        return;
    }
    lattice.velocity = steady_velocity(config, side);
    if (inlet.ramp_s > 0) {
        lattice.factor = [ramp = inlet.ramp_s / unit.time_step_s](double time) {
            return time >= ramp ? 1
                                : 0.5 * (1 - std::cos(std::numbers::pi * time / ramp));
        };
    }
}

}  // namespace

bool is_open(const FluidConfig& config, int side, const Cell& cell) {
    const auto& patch = config.boundaries[side].patch;
    if (!patch) return true;
    const std::array<double, 2> at = face_centre(side, cell);
    const double dx = config.spacing_m;
    if (const auto* disc = std::get_if<Disc>(&*patch)) {
        return std::hypot(at[0] * dx - disc->centre_m[0],
                          at[1] * dx - disc->centre_m[1]) < disc->diameter_m / 2;
    }
    const Rectangle& r = std::get<Rectangle>(*patch);
    return std::abs(at[0] * dx - r.centre_m[0]) < r.size_m[0] / 2 &&
           std::abs(at[1] * dx - r.centre_m[1]) < r.size_m[1] / 2;
}

LatticeSide lattice_side(const FluidConfig& config, int side) {
    const Boundary& boundary = config.boundaries[side];
    LatticeSide lattice;
    lattice.kind = boundary.kind;
    if (boundary.patch) {
        lattice.open = [config, side](const Cell& cell) {
            return is_open(config, side, cell);
        };
    }
    if (boundary.kind == BoundaryKind::velocity_inlet) {
        describe_inlet(config, side, lattice);
    }
    if (boundary.kind == BoundaryKind::pressure_outlet) {
        lattice.density_excess =
            boundary.outlet_pressure_pa / units(config).pressure_pa();
    }
    return lattice;
}

}  // namespace magfsi::fluid

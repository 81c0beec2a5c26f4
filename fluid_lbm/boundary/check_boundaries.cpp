#include <algorithm>
#include <cmath>

#include "fluid_lbm/boundary/opening.h"
#include "fluid_lbm/boundary/refuse.h"
#include "fluid_lbm/units.h"

namespace magfsi::fluid {

namespace {

bool is(const FluidConfig& config, int side, BoundaryKind kind) {
    return config.boundaries[side].kind == kind;
}

double length(const Vec3& v) {
    return std::hypot(v[0], v[1], v[2]);
}

void check_periodic_pairs(const FluidConfig& config) {
    for (int axis = 0; axis < 3; ++axis) {
        const bool low = is(config, 2 * axis, BoundaryKind::periodic);
        const bool high = is(config, 2 * axis + 1, BoundaryKind::periodic);
        if (low != high) {
            refuse("fluid side ", side_name[2 * axis + (low ? 0 : 1)],
                   " is periodic and the opposite side is not; both must be, or none");
        }
    }
}

void check_lattice_speed(const FluidConfig& config, double speed_m_s, const char* what,
                         int side) {
    const double lattice_speed = speed_m_s / units(config).velocity_m_s();
    if (lattice_speed > lattice_speed_limit) {
        refuse("fluid ", what, " at ", side_name[side], " is ", lattice_speed,
               " cells a step; it must stay below ", lattice_speed_limit,
               ": use a shorter time step");
    }
}

void check_wall_velocity(const FluidConfig& config, int side) {
    const Boundary& boundary = config.boundaries[side];
    const Vec3& u = boundary.wall_velocity_m_s;
    const double speed = length(u);
    if (!(speed >= 0) || !std::isfinite(speed)) {
        refuse("fluid wall velocity at ", side_name[side], " is not finite");
    }
    if (speed > 0 && boundary.kind != BoundaryKind::no_slip) {
        refuse("fluid side ", side_name[side], " is ", name_of(boundary.kind),
               " and has a wall velocity; only no_slip sides may have one");
    }
    if (u[side / 2] != 0) {
        refuse("fluid wall velocity at ", side_name[side], " has the component ",
               u[side / 2], " m/s along ", axis_name[side / 2],
               "; a wall may move only along itself");
    }
    check_lattice_speed(config, speed, "wall speed", side);
}

void check_patch(const FluidConfig& config, int side) {
    const Boundary& boundary = config.boundaries[side];
    if (!boundary.patch) return;
    if (boundary.kind != BoundaryKind::velocity_inlet &&
        boundary.kind != BoundaryKind::pressure_outlet) {
        refuse("fluid side ", side_name[side], " is ", name_of(boundary.kind),
               " and has a patch; only inlets and outlets may have one");
    }
    const auto* disc = std::get_if<Disc>(&*boundary.patch);
    const auto* rectangle = std::get_if<Rectangle>(&*boundary.patch);
    const auto centre = disc ? disc->centre_m : rectangle->centre_m;
    const int axes[2] = {side / 2 == 0 ? 1 : 0, side / 2 == 2 ? 1 : 2};
    for (int i = 0; i < 2; ++i) {
        const double width = disc ? disc->diameter_m : rectangle->size_m[i];
        const double end = config.cells[axes[i]] * config.spacing_m;
        const double low = centre[i] - width / 2, high = centre[i] + width / 2;
        const double slack = 1e-9 * end;  // a patch up to the edge, typed in decimals
        if (!(width > 0) || !(low >= -slack) || !(high <= end + slack)) {
            refuse("fluid patch on ", side_name[side], " reaches from ", low, " to ",
                   high, " m along ", axis_name[axes[i]], "; the side reaches from 0 to ",
                   end, " m");
        }
    }
    const CellBox cells = *cells_at_side({{0, 0, 0}, config.cells}, config.cells, side);
    bool any = false;
    for_each_cell(cells, [&](const Cell& c) { any = any || is_open(config, side, c); });
    if (!any) {
        refuse("fluid patch on ", side_name[side],
               " holds the centre of no cell; make it larger or the spacing finer");
    }
}

void check_inlet(const FluidConfig& config, int side) {
    const Inlet& inlet = config.boundaries[side].inlet;
    if (!is(config, side, BoundaryKind::velocity_inlet)) return;
    if (!std::isfinite(length(inlet.velocity_m_s))) {
        refuse("fluid inlet velocity at ", side_name[side], " is not finite");
    }
    if (!(inlet.ramp_s >= 0)) {
        refuse("fluid inlet ramp at ", side_name[side], " is ", inlet.ramp_s,
               " s; it must be at least 0");
    }
    if (inlet.course) return;
    const LatticeSide lattice = lattice_side(config, side);
    double peak = 0;
    const CellBox cells = *cells_at_side({{0, 0, 0}, config.cells}, config.cells, side);
    for_each_cell(cells, [&](const Cell& c) {
        if (is_open(config, side, c)) peak = std::max(peak, length(lattice.velocity(c)));
    });
    check_lattice_speed(config, peak * units(config).velocity_m_s(), "inlet speed", side);
}

// Volume per time into the box; none if a course decides.
std::optional<double> inflow_m3_s(const FluidConfig& config, int side) {
    const Boundary& boundary = config.boundaries[side];
    if (boundary.kind != BoundaryKind::velocity_inlet) return 0;
    if (boundary.inlet.course) return {};
    int open = 0;
    const CellBox cells = *cells_at_side({{0, 0, 0}, config.cells}, config.cells, side);
    for_each_cell(cells, [&](const Cell& c) { open += is_open(config, side, c); });
    return inward(side) * boundary.inlet.velocity_m_s[side / 2] * open *
           config.spacing_m * config.spacing_m;
}

// Without an outlet the pressure grows without limit unless the inlets balance.
void check_balance(const FluidConfig& config) {
    double sum = 0, largest = 0;
    for (int side = 0; side < 6; ++side) {
        if (is(config, side, BoundaryKind::pressure_outlet)) return;
        const auto flow = inflow_m3_s(config, side);
        if (!flow) return;
        sum += *flow;
        largest = std::max(largest, std::abs(*flow));
    }
    if (std::abs(sum) > 1e-9 * largest) {
        refuse("fluid inlets bring ", sum,
               " m3/s and there is no pressure outlet; make a side an outlet or let the "
               "inlets balance");
    }
}

void check_outlets(const FluidConfig& config) {
    for (int side = 0; side < 6; ++side) {
        if (!is(config, side, BoundaryKind::pressure_outlet)) continue;
        if (!std::isfinite(config.boundaries[side].outlet_pressure_pa)) {
            refuse("fluid outlet pressure at ", side_name[side], " is not finite");
        }
        for (int other = 0; other < side; ++other) {
            const bool meet = axis_of(other) != axis_of(side) &&
                              is(config, other, BoundaryKind::pressure_outlet) &&
                              !config.boundaries[side].patch &&
                              !config.boundaries[other].patch;
            if (!meet) continue;
            refuse("fluid sides ", side_name[other], " and ", side_name[side],
                   " are pressure outlets that share an edge, where neither knows what "
                   "enters; only opposite sides may both be, or make one a patch");
        }
    }
}

}  // namespace

void check_boundaries(const FluidConfig& config) {
    check_periodic_pairs(config);
    for (int side = 0; side < 6; ++side) {
        check_wall_velocity(config, side);
        check_patch(config, side);
        check_inlet(config, side);
    }
    check_balance(config);
    check_outlets(config);
}

}  // namespace magfsi::fluid

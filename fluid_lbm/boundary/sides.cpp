// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/boundary/sides.h"

#include <algorithm>
#include <cmath>

#include "fluid_lbm/collision/cells.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

bool is(const FluidConfig& config, int side, BoundaryKind kind) {
    return config.boundaries[side].kind == kind;
}

// Profile over s, the distance from the middle over half the width.
double falloff(InletProfile profile, double s) {
    if (profile == InletProfile::uniform) return 1;
    return std::max(0.0, 1 - std::pow(s, profile == InletProfile::parabolic ? 2 : 8));
}

bool is_wall(const FluidConfig& config, int side) {
    return config.boundaries[side].kind == BoundaryKind::no_slip;
}

// Profile of an opening that is the whole side, along one axis of it; at: place along
// that axis, in cells. A plane of symmetry at one end doubles the width.
double falloff_between_sides(const FluidConfig& config, InletProfile profile, int axis,
                             double at) {
    const bool low = is_wall(config, 2 * axis), high = is_wall(config, 2 * axis + 1);
    if (!low && !high) return 1;
    const double width = config.cells[axis];
    if (low && high) return falloff(profile, std::abs(2 * at / width - 1));
    return falloff(profile, low ? 1 - at / width : at / width);
}

// Length of the part of [low, high] that [from, to] covers.
double overlap(double low, double high, double from, double to) {
    return std::max(0.0, std::min(high, to) - std::max(low, from));
}

// Part of the unit square around `at` that a disc covers. It is summed over strips across
// the disc and along it, each with its exact chord: the result changes evenly with the
// disc's place and does not depend on which axis is which.
double share_of_disc(const std::array<double, 2>& at, const std::array<double, 2>& centre,
                     double radius) {
    constexpr int strips = 16;
    double sum = 0;
    for (std::size_t along = 0; along < 2; ++along) {
        const std::size_t across = 1 - along;
        for (int i = 0; i < strips; ++i) {
            const double x = at[along] - 0.5 + (i + 0.5) / strips - centre[along];
            const double chord = std::sqrt(std::max(0.0, radius * radius - x * x));
            sum += overlap(at[across] - 0.5, at[across] + 0.5, centre[across] - chord,
                           centre[across] + chord);
        }
    }
    return sum / (2 * strips);
}

// Mean velocity on the face around `at` (in-plane coordinates in cells), of a profile
// whose peak is 1. A cell that the edge of an opening cuts has its share of the face,
// wherever the opening lies on the grid.
double shape_of(const FluidConfig& config, int side, const std::array<double, 2>& at) {
    const Boundary& boundary = config.boundaries[side];
    const InletProfile profile = boundary.inlet.profile;
    const std::array<int, 2> axes = in_plane(side);
    if (!boundary.patch) {
        return falloff_between_sides(config, profile, axes[0], at[0]) *
               falloff_between_sides(config, profile, axes[1], at[1]);
    }
    const double dx = config.spacing_m;
    const Disc* disc = opening<Disc>(boundary);
    const Rectangle* r = opening<Rectangle>(boundary);
    const auto& centre_m = disc ? disc->centre_m : r->centre_m;
    const std::array<double, 2> centre{centre_m[0] / dx, centre_m[1] / dx};
    const std::array<double, 2> half =
        disc ? std::array{disc->diameter_m / (2 * dx), disc->diameter_m / (2 * dx)}
             : std::array{r->size_m[0] / (2 * dx), r->size_m[1] / (2 * dx)};
    if (profile == InletProfile::uniform) {
        if (disc) return share_of_disc(at, centre, half[0]);
        double share = 1;
        for (std::size_t i = 0; i < 2; ++i)
            share *= overlap(at[i] - 0.5, at[i] + 0.5, centre[i] - half[i],
                             centre[i] + half[i]);
        return share;
    }
    constexpr int points = 8;  // points of the mean along each axis
    double sum = 0;
    for (int j = 0; j < points; ++j) {
        for (int i = 0; i < points; ++i) {
            const double s = (at[0] - 0.5 + (i + 0.5) / points - centre[0]) / half[0];
            const double t = (at[1] - 0.5 + (j + 0.5) / points - centre[1]) / half[1];
            sum += disc ? falloff(profile, std::hypot(s, t))
                        : falloff(profile, std::abs(s)) * falloff(profile, std::abs(t));
        }
    }
    return sum / (points * points);
}

// Centre of a cell's face on the side, in-plane coordinates in cells.
std::array<double, 2> face_centre(int side, const Cell& cell) {
    const std::array<int, 2> axes = in_plane(side);
    return {cell[axes[0]] + 0.5, cell[axes[1]] + 0.5};
}

// The cells at a side over the whole box.
CellBox whole_side(const FluidConfig& config, int side) {
    return *cells_at_side({{0, 0, 0}, config.cells}, config.cells, side);
}

// Number of cells in the opening of a side.
int open_cells(const FluidConfig& config, int side) {
    int open = 0;
    for_each_cell(whole_side(config, side),
                  [&](const Cell& c) { open += is_open(config, side, c); });
    return open;
}

// Throws std::invalid_argument if a speed at a side is above the lattice's limit.
void check_lattice_speed(const FluidConfig& config, double speed_m_s, const char* what,
                         int side) {
    const double lattice_speed = speed_m_s / units(config).velocity_m_s();
    if (lattice_speed > lattice_speed_limit) {
        refuse("fluid ", what, " at ", side_name[side], " is ", lattice_speed,
               " cells a step; it must stay below ", lattice_speed_limit,
               ": use a shorter time step");
    }
}

// Throws std::invalid_argument if a side's opening leaves the side or holds no cell.
void check_patch(const FluidConfig& config, int side) {
    const Boundary& boundary = config.boundaries[side];
    if (!boundary.patch) return;
    const Disc* disc = opening<Disc>(boundary);
    const Rectangle* rectangle = opening<Rectangle>(boundary);
    const auto centre = disc ? disc->centre_m : rectangle->centre_m;
    const std::array<int, 2> axes = in_plane(side);
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
    if (open_cells(config, side) == 0) {
        refuse("fluid patch on ", side_name[side],
               " holds the centre of no cell; make it larger or the spacing finer");
    }
}

void check_inlet(const FluidConfig& config, int side) {
    if (!is(config, side, BoundaryKind::velocity_inlet)) return;
    const auto velocity = inlet_velocity(config, side);
    double peak = 0;
    for_each_cell(whole_side(config, side), [&](const Cell& c) {
        if (is_open(config, side, c)) peak = std::max(peak, norm(velocity(c)));
    });
    peak *= config.boundaries[side].inlet.peak_factor;
    check_lattice_speed(config, peak * units(config).velocity_m_s(), "inlet speed", side);
}

// Throws std::invalid_argument if there is no outlet and the inlets do not balance at all
// times: the pressure would grow without limit.
void check_balance(const FluidConfig& config) {
    double sum = 0, largest = 0;
    for (int side = 0; side < 6; ++side) {
        if (is(config, side, BoundaryKind::pressure_outlet)) return;
    }
    for (int side = 0; side < 6; ++side) {
        const double flow = inflow_m3_s(config, side);
        if (config.boundaries[side].inlet.factor)
            refuse(
                "fluid inlet at ", side_name[side],
                " has a course of time and there is no pressure outlet to let flow out; "
                "make a side an outlet");
        sum += flow;
        largest = std::max(largest, std::abs(flow));
    }
    if (std::abs(sum) > 1e-9 * largest) {
        refuse("fluid inlets bring ", sum,
               " m3/s and there is no pressure outlet; make a side an outlet or let the "
               "inlets balance");
    }
}

// Throws std::invalid_argument if two outlets share an edge: in its cells neither knows
// the populations that enter.
void check_outlets(const FluidConfig& config) {
    for (int side = 0; side < 6; ++side) {
        if (!is(config, side, BoundaryKind::pressure_outlet)) continue;
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

bool is_open(const FluidConfig& config, int side, const Cell& cell) {
    // A cell at an inlet is open if a part of its face is, except for rounding.
    if (config.boundaries[side].patch && is(config, side, BoundaryKind::velocity_inlet))
        return shape_of(config, side, face_centre(side, cell)) > 1e-9;
    return holds_centre(config, side, cell);
}

bool holds_centre(const FluidConfig& config, int side, const Cell& cell) {
    const Boundary& boundary = config.boundaries[side];
    if (!boundary.patch) return true;
    const std::array<double, 2> at = face_centre(side, cell);
    const double dx = config.spacing_m;
    if (const Disc* disc = opening<Disc>(boundary)) {
        return std::hypot(at[0] * dx - disc->centre_m[0],
                          at[1] * dx - disc->centre_m[1]) < disc->diameter_m / 2;
    }
    const Rectangle& r = *opening<Rectangle>(boundary);
    return std::abs(at[0] * dx - r.centre_m[0]) < r.size_m[0] / 2 &&
           std::abs(at[1] * dx - r.centre_m[1]) < r.size_m[1] / 2;
}

double opening_area_m2(const FluidConfig& config, int side) {
    const Boundary& boundary = config.boundaries[side];
    if (boundary.patch) return area_m2(*boundary.patch);
    const std::array<int, 2> axes = in_plane(side);
    return config.spacing_m * config.spacing_m * config.cells[axes[0]] *
           config.cells[axes[1]];
}

double inflow_m3_s(const FluidConfig& config, int side) {
    const Boundary& boundary = config.boundaries[side];
    if (boundary.kind != BoundaryKind::velocity_inlet) return 0;
    return inward(side) * boundary.inlet.velocity_m_s[side / 2] *
           opening_area_m2(config, side);
}

std::function<Vec3(const Cell&)> inlet_velocity(const FluidConfig& config, int side) {
    double sum = 0;
    for_each_cell(whole_side(config, side), [&](const Cell& cell) {
        if (is_open(config, side, cell))
            sum += shape_of(config, side, face_centre(side, cell));
    });
    const double faces =
        opening_area_m2(config, side) / (config.spacing_m * config.spacing_m);
    Vec3 peak = config.boundaries[side].inlet.velocity_m_s;
    peak *= faces / sum / units(config).velocity_m_s();
    return [&config, side, peak](const Cell& cell) {
        return peak * shape_of(config, side, face_centre(side, cell));
    };
}

void check_sides(const FluidConfig& config) {
    for (int side = 0; side < 6; ++side) {
        check_lattice_speed(config, norm(config.boundaries[side].wall_velocity_m_s),
                            "wall speed", side);
        check_patch(config, side);
        check_inlet(config, side);
    }
    check_balance(config);
    check_outlets(config);
}

}  // namespace magfsi::fluid

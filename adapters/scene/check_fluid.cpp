// SPDX-License-Identifier: GPL-2.0-or-later
// Checks of the fluid: its box, sides and grid, and options that openfoam lacks.
#include "adapters/scene/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/scene/effective.h"

namespace magfsi::scene {

namespace {

// Relative tolerance of a side's length, far below what a cell resolves.
constexpr double divides_within = 1e-6;
// The widest delta kernel spans 4 cells. Across periodic sides it wraps around, and fewer
// cells are allowed.
constexpr int min_cells = 4;
// 8 TB of populations in single precision.
constexpr double max_cells = 1e11;
// Numbers of cells along an axis are ints.
constexpr double max_cells_along = 2e9;

bool divides(double side, double spacing) {
    const double cells = std::round(side / spacing);
    return cells >= 1 && std::abs(cells * spacing / side - 1) <= divides_within;
}

bool divides_all(const Vec3& box, double spacing) {
    return std::ranges::all_of(box, [=](double side) { return divides(side, spacing); });
}

// Least number of cells along an axis.
int least_cells(const Fluid& fluid, std::size_t d) {
    return fluid.boundaries[2 * d].kind == BoundaryKind::periodic ? 1 : min_cells;
}

bool has_cells(const Fluid& fluid, std::size_t d, double spacing) {
    return fluid.box_m[d] / spacing >= least_cells(fluid, d) * (1 - divides_within);
}

// Advice for a spacing that does not divide the box: the nearest one that divides all
// sides and leaves cells enough, else the nearest box of whole cells. Candidates are
// taken from the shortest side, which has the fewest cells.
std::string advice(const Fluid& fluid) {
    const double wanted = fluid.spacing_m;
    const double shortest = std::ranges::min(fluid.box_m);
    const long cells = std::max(1L, std::lround(shortest / wanted));
    for (long away = 0; 2 * away <= cells; ++away) {
        double best = 0;
        for (const long n : {cells - away, cells + away}) {
            const double spacing = shortest / static_cast<double>(n);
            if (divides_all(fluid.box_m, spacing) && has_cells(fluid, 0, spacing) &&
                has_cells(fluid, 1, spacing) && has_cells(fluid, 2, spacing) &&
                (best == 0 || std::abs(spacing - wanted) < std::abs(best - wanted)))
                best = spacing;
        }
        // Nine digits pass the tolerance divides_within when typed in again.
        if (best > 0) return fmt::format("the nearest is {:.9g} mm", 1e3 * best);
    }
    Vec3 box{};
    for (std::size_t i = 0; i < 3; ++i)
        box[i] = wanted * std::max<double>(least_cells(fluid, i),
                                           std::round(fluid.box_m[i] / wanted));
    return fmt::format("the nearest box is [{}, {}, {}]", metres(box[0]), metres(box[1]),
                       metres(box[2]));
}

// Refuses numbers of cells beyond any machine, mostly caused by a wrong unit.
void check_cells(const Fluid& fluid, const Marks& marks) {
    double all = 1, along = 0;
    for (const double side : fluid.box_m) {
        const double cells = std::max(1.0, side / fluid.spacing_m);
        all *= cells;
        along = std::max(along, cells);
    }
    const double coarser = std::max(std::cbrt(all / max_cells), along / max_cells_along);
    require(all <= max_cells && along <= max_cells_along,
            marks.value({"fluid", "spacing"}),
            fmt::format("{:.3g} cells, {:.3g} along the longest side", all, along),
            fmt::format("at most {:.0e} cells, {:.0e} along a side", max_cells,
                        max_cells_along),
            fmt::format("take a spacing above {}, or a smaller box",
                        metres(coarser * fluid.spacing_m)));
}

void check_spacing(const Fluid& fluid, const Marks& marks) {
    const Origin& here = marks.value({"fluid", "spacing"});
    for (std::size_t d = 0; d < 3; ++d) {
        const double side = fluid.box_m[d], cells = side / fluid.spacing_m;
        require(has_cells(fluid, d, fluid.spacing_m), here,
                fmt::format("{:.3g} cells along {}", cells, axis_names[d]),
                fmt::format("at least {} cells between walls", min_cells),
                fmt::format("take a spacing of at most {}", metres(side / min_cells)));
        if (!divides(side, fluid.spacing_m))
            refuse(
                here,
                fmt::format("the spacing {}, which does not divide the box's {} along {}",
                            metres(fluid.spacing_m), metres(side), axis_names[d]),
                "a spacing that divides every side", advice(fluid));
    }
}

void check_periodic_pairs(const Fluid& fluid, const Marks& marks) {
    for (std::size_t face = 0; face < 6; ++face) {
        const std::string name(names<Face>[face]), other(names<Face>[face ^ 1]);
        require(fluid.boundaries[face].kind != BoundaryKind::periodic ||
                    fluid.boundaries[face ^ 1].kind == BoundaryKind::periodic,
                marks.value({"fluid", "boundaries", name}),
                fmt::format("{} periodic but {} not", name, other), "periodic in pairs",
                fmt::format("make {} periodic as well", other));
    }
}

// Walls may move only along themselves, inlets need a velocity, and an opening smaller
// than a cell is none.
void check_sides(const Fluid& fluid, const Marks& marks) {
    for (std::size_t face = 0; face < 6; ++face) {
        const Boundary& side = fluid.boundaries[face];
        const std::string name(names<Face>[face]);
        const double normal = side.wall_velocity_m_s[face / 2];
        require(side.kind != BoundaryKind::no_slip || normal == 0,
                marks.value({"fluid", "boundaries", name, "no_slip", "velocity"}),
                fmt::format("the wall {} moving along its normal at {:.6g} m/s", name,
                            normal),
                "velocities along the wall",
                fmt::format("set the {} component to 0 m/s", axis_names[face / 2]));
        require(side.kind != BoundaryKind::velocity_inlet ||
                    side.inlet.velocity_m_s != Vec3{},
                marks.value({"fluid", "boundaries", name}),
                fmt::format("the inlet {} without a velocity", name),
                "velocity_inlet: {velocity: [x, y, z]}, not zero",
                "give it a velocity, or leave the side out: a wall");
        const double faces =
            side.patch ? fluid::area_m2(*side.patch) / (fluid.spacing_m * fluid.spacing_m)
                       : 1;
        require(faces >= 1 - divides_within, marks.value({"fluid", "boundaries", name}),
                fmt::format("an opening of {:.3g} of a cell's face", faces),
                "at least one face", "make the opening larger, or fluid.spacing finer");
    }
}

void check_taylor_green(const Fluid& fluid, const Marks& marks) {
    const Origin& where = marks.key({"fluid", "taylor_green"});
    require(!fluid.initial_velocity_m_s, where,
            "the Taylor-Green vortex and an initial velocity", "one of the two",
            "leave initial_velocity out");
    const auto periodic = [](const Boundary& side) {
        return side.kind == BoundaryKind::periodic;
    };
    const Vec3& box = fluid.box_m;
    require(std::ranges::all_of(fluid.boundaries, periodic) && box[0] == box[1] &&
                box[0] == box[2],
            where, "the Taylor-Green vortex in a box that is no periodic cube",
            "a cube whose six boundaries are periodic");
}

void check_grading(const Fluid& fluid, const Marks& marks) {
    const auto& [lower, upper] = fluid.grading->uniform_m;
    for (std::size_t d = 0; d < 3; ++d) {
        require(lower[d] >= 0 && lower[d] < upper[d] && upper[d] <= fluid.box_m[d],
                marks.value({"fluid", "grading", "uniform"}),
                fmt::format("a uniform part from {} to {} along {}", metres(lower[d]),
                            metres(upper[d]), axis_names[d]),
                fmt::format("from 0 to the box's {}, in ascending order",
                            metres(fluid.box_m[d])));
    }
}

// Refuses what OpenFOAM's adapter does not have.
void check_openfoam(const Fluid& fluid, const Marks& marks) {
    const auto not_there = [&](bool present, const Origin& where, const char* what) {
        require(!present, where, fmt::format("{} with fluid.solver openfoam", what),
                "only with the solver lbm", "set solver: lbm, or leave it out");
    };
    not_there(fluid.smagorinsky_constant > 0, marks.key({"fluid", "smagorinsky"}),
              "smagorinsky");
    not_there(fluid.rheology.has_value(), marks.key({"fluid", "rheology"}), "a rheology");
    not_there(fluid.bulk_viscosity_m2_s.has_value(),
              marks.key({"fluid", "bulk_viscosity"}), "a bulk viscosity");
    not_there(fluid.taylor_green.has_value(), marks.key({"fluid", "taylor_green"}),
              "the Taylor-Green vortex");
    for (std::size_t face = 0; face < 6; ++face) {
        const Boundary& side = fluid.boundaries[face];
        not_there(side.kind == BoundaryKind::pressure_outlet && side.patch,
                  marks.value({"fluid", "boundaries", std::string(names<Face>[face])}),
                  "an outlet over a part of its side");
        not_there(side.inlet.course.has_value(),
                  marks.value({"fluid", "boundaries", std::string(names<Face>[face])}),
                  "an inlet with a course");
    }
}

void check_rheology(const Fluid& fluid, const Marks& marks) {
    const Path here{"fluid", "rheology"};
    require(fluid.smagorinsky_constant == 0, marks.key(here),
            "a rheology and an eddy viscosity", "one of the two",
            "leave smagorinsky out");
    require(!fluid.refinement, marks.key(here), "a rheology on a refined grid",
            "one of the two: what levels tell each other takes one viscosity",
            "leave refinement out");
    if (const auto* law = std::get_if<fluid::PowerLaw>(&fluid.rheology->law)) {
        require(law->least_m2_s < law->most_m2_s,
                marks.value({"fluid", "rheology", "power_law", "most"}),
                fmt::format("limits of {:.4g} and {:.4g} m2/s", law->least_m2_s,
                            law->most_m2_s),
                "least below most");
    }
}

// Collisions with a single rate have the bulk viscosity that this rate gives.
void check_bulk_viscosity(const Fluid& fluid, const Marks& marks) {
    require(
        fluid.collision != Collision::bgk, marks.key({"fluid", "bulk_viscosity"}),
        "a bulk viscosity with collision: bgk, which has one rate for all of the stress",
        "it with another collision", "leave collision out, or bulk_viscosity");
}

// The margin must leave room for the kernel and for the motion of bodies until the patch
// follows.
void check_refinement(const Scene& scene, const Marks& marks) {
    const Fluid& fluid = *scene.fluid;
    const Refinement& refinement = *fluid.refinement;
    const Path here{"fluid", "refinement"};
    require(fluid.solver == FluidSolver::lbm, marks.key(here),
            "a refined grid for openfoam", "it with fluid.solver: lbm",
            "take fluid.grading");
    require(!scene.bodies.empty() || refinement.box_m, marks.key(here),
            "a refined grid without bodies and without a box",
            "bodies that it follows, or box: [lower corner, upper corner]");
    require(!(refinement.margin_m && refinement.box_m),
            marks.key({"fluid", "refinement", "margin"}),
            "a margin around bodies beside a box", "one of the two");
    for (std::size_t d = 0; refinement.box_m && d < 3; ++d) {
        const double low = (*refinement.box_m)[0][d], high = (*refinement.box_m)[1][d];
        require(low >= 0 && low < high && high <= fluid.box_m[d] * (1 + 1e-9),
                marks.value({"fluid", "refinement", "box"}),
                fmt::format("a patch from {} to {} along {}", metres(low), metres(high),
                            axis_names[d]),
                fmt::format("within the fluid's box, from 0 m to {}",
                            metres(fluid.box_m[d])));
    }
    const double least_m = least_margin_cells(scene) * 2 * fluid.finest_spacing_m();
    require(
        !refinement.margin_m || *refinement.margin_m >= least_m * (1 - 1e-9),
        marks.value({"fluid", "refinement", "margin"}),
        fmt::format("a margin of {}", metres(refinement.margin_m.value_or(0))),
        fmt::format("at least {}: what the kernel and the fastest body reach before the "
                    "patch follows",
                    metres(least_m)));
}

}  // namespace

void check_fluid(const Scene& scene, const Marks& marks) {
    const Fluid& fluid = *scene.fluid;
    check_cells(fluid, marks);
    check_spacing(fluid, marks);
    check_periodic_pairs(fluid, marks);
    check_sides(fluid, marks);
    if (fluid.taylor_green) check_taylor_green(fluid, marks);
    if (fluid.rheology) check_rheology(fluid, marks);
    if (fluid.bulk_viscosity_m2_s) check_bulk_viscosity(fluid, marks);
    if (fluid.grading) check_grading(fluid, marks);
    if (fluid.refinement) check_refinement(scene, marks);
    if (fluid.solver == FluidSolver::openfoam) check_openfoam(fluid, marks);
}

}  // namespace magfsi::scene

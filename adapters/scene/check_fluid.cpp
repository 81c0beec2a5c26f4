// SPDX-License-Identifier: GPL-2.0-or-later
// Checks of the fluid: its box, options that openfoam lacks, the coupled step and its
// halving.
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
    not_there(!fluid.obstacles.empty(), marks.key({"fluid", "obstacles"}), "obstacles");
    not_there(fluid.smagorinsky_constant > 0, marks.key({"fluid", "smagorinsky"}),
              "smagorinsky");
    not_there(fluid.rheology.has_value(), marks.key({"fluid", "rheology"}), "a rheology");
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

// The compressibility error of the lattice grows with the square of the speed; above a
// quarter of a cell a step (Mach 0.43) the fluid is no longer weakly compressible.
constexpr double max_lattice_speed = 0.25;
// OpenFOAM's implicit step is stable at much larger Courant numbers, but the explicit
// coupling is of first order in time.
constexpr double max_courant = 1;
// Above this relaxation time the fluid slips along bounce-back walls.
constexpr double max_tau = 2;

void check_speed(double speed, std::string_view what, const Origin& where,
                 const Fluid& fluid, double dt_s) {
    const double limit =
        fluid.solver == FluidSolver::lbm ? max_lattice_speed : max_courant;
    const double cells = speed * dt_s / fluid.finest_spacing_m();
    if (cells <= limit * (1 + 1e-9)) return;  // admits rounding
    refuse(
        where,
        fmt::format("{} {:.6g} m/s, which is {:.3g} cells per step", what, speed, cells),
        fmt::format("at most {}", limit),
        fmt::format("take a time.step of at most {}",
                    seconds(limit * fluid.finest_spacing_m() / speed)));
}

void check_speeds(const Scene& scene, const Marks& marks, double dt_s) {
    const Fluid& fluid = *scene.fluid;
    check_speed(fluid.expected_speed_m_s, "the expected speed",
                marks.value({"fluid", "expected_speed"}), fluid, dt_s);
    if (fluid.initial_velocity_m_s)
        check_speed(norm(*fluid.initial_velocity_m_s), "the initial velocity",
                    marks.value({"fluid", "initial_velocity"}), fluid, dt_s);
    if (fluid.taylor_green)
        check_speed(fluid.taylor_green->speed_m_s, "the vortex's speed",
                    marks.value({"fluid", "taylor_green", "speed"}), fluid, dt_s);
    for (std::size_t face = 0; face < 6; ++face) {
        const std::string name(names<Face>[face]);
        const Boundary& side = fluid.boundaries[face];
        const std::string kind(name_of(side.kind));
        const bool inlet = side.kind == BoundaryKind::velocity_inlet;
        const double speed_m_s =
            inlet ? side.inlet.peak_factor * norm(side.inlet.velocity_m_s)
                  : norm(side.wall_velocity_m_s);
        check_speed(speed_m_s,
                    !inlet              ? "the wall velocity"
                    : side.inlet.course ? "the largest velocity of the inlet's course"
                                        : "the inlet's velocity",
                    marks.value({"fluid", "boundaries", name, kind, "velocity"}), fluid,
                    dt_s);
    }
    for (const Body& body : scene.bodies) {
        for (std::size_t i = 0; i < body.prescribed_motion.size(); ++i)
            check_speed(largest_speed_m_s(body.prescribed_motion[i], scene.time.end_s),
                        "the prescribed motion's largest speed",
                        marks.item({"bodies", body.name, "prescribed_motion"}, i), fluid,
                        dt_s);
    }
}

// Advice on which key to change so that 3 nu dt / dx^2 (= tau - 1/2) becomes `wanted` in
// place of `now`.
std::string advice(const Scene& scene, double dt_s, double now, double wanted) {
    const Fluid& fluid = *scene.fluid;
    const double factor = wanted / now;
    if (scene.time.step_s)
        return fmt::format("take time.step {} {}, or spacing {} {}",
                           factor > 1 ? "above" : "below", seconds(dt_s * factor),
                           factor > 1 ? "below" : "above",
                           metres(fluid.spacing_m / std::sqrt(factor)));
    // A step from the lattice speed gives 3 nu dt / dx^2 = 3 nu u_lattice / (U dx), which
    // scales with 1 / dx.
    const double lattice_speed = fluid.lattice_speed * factor;
    const std::string spacing =
        fmt::format("spacing {} {}", factor > 1 ? "below" : "above",
                    metres(fluid.spacing_m / factor));
    if (lattice_speed > max_lattice_speed) return "take " + spacing;
    return fmt::format("take lattice_speed {} {:.3g}, or {}",
                       factor > 1 ? "above" : "below", lattice_speed, spacing);
}

void check_relaxation(const Scene& scene, const Marks& marks, double dt_s) {
    const Fluid& fluid = *scene.fluid;
    const double tau = relaxation_time(scene).value_or(max_tau);
    const double wanted = std::clamp(tau, min_relaxation_time, max_tau);
    if (tau == wanted) return;
    refuse(marks.value({"fluid", "viscosity"}),
           fmt::format(
               "a relaxation time of {:.6g} (viscosity {:.6g} m2/s, step {}, spacing "
               "{})",
               tau, fluid.viscosity_m2_s, seconds(dt_s), metres(fluid.spacing_m)),
           fmt::format("{} to {}", min_relaxation_time, max_tau),
           advice(scene, dt_s, tau - 0.5, wanted - 0.5));
}

void check_step(const Scene& scene, const Marks& marks) {
    const std::optional<double> dt_s = coupled_step_s(scene);
    require(!scene.fluid || dt_s, marks.value({"fluid"}),
            "neither time.step nor fluid.expected_speed",
            "one of them, to set the coupled step",
            "add expected_speed, the largest speed that the run should resolve");
    if (!dt_s) return;
    // The tolerance admits rounding of lattice_speed * spacing / expected_speed.
    require(*dt_s <= scene.time.end_s * (1 + 1e-9), marks.value({"time", "end"}),
            fmt::format("the end {} before the first step of {}",
                        seconds(scene.time.end_s), seconds(*dt_s)),
            "at least one step", "take a later end, or a smaller time.step");
    if (!scene.fluid) return;
    check_speeds(scene, marks, *dt_s);
    check_relaxation(scene, marks, *dt_s);
}

}  // namespace

void check_fluid(const Scene& scene, const Marks& marks) {
    if (scene.fluid) {
        const Fluid& fluid = *scene.fluid;
        check_cells(fluid, marks);
        check_spacing(fluid, marks);
        check_periodic_pairs(fluid, marks);
        check_sides(fluid, marks);
        if (fluid.taylor_green) check_taylor_green(fluid, marks);
        if (fluid.rheology) check_rheology(fluid, marks);
        if (fluid.grading) check_grading(fluid, marks);
        if (fluid.refinement) check_refinement(scene, marks);
        if (fluid.solver == FluidSolver::openfoam) check_openfoam(fluid, marks);
    }
    check_step(scene, marks);
}

std::string fault_of_half_step(const Scene& scene) {
    Scene half = scene;
    ++half.time.halvings;
    const auto tau = relaxation_time(half);
    if (!tau || *tau >= min_relaxation_time) return {};
    return fmt::format("half of the step {} has a relaxation time of {:.6g}, below {}",
                       seconds(*coupled_step_s(scene)), *tau, min_relaxation_time);
}

void check_retry(const Scene& scene, const Marks& marks) {
    const Origin& here = marks.value({"checkpoint", "on_divergence"});
    const std::string without = "take checkpoint.on_divergence: stop";
    const char* const smaller_step = ", and a smaller time.step";
    require(!scene.fluid || scene.fluid->solver == FluidSolver::lbm, here,
            "a retry with fluid.solver openfoam",
            "it with the lattice-Boltzmann fluid, or bodies alone",
            without + smaller_step);
    // The least-squares model of the implicit scheme belongs to a step of the old length.
    require(
        !scene.fluid || scene.bodies.empty() || scene.coupling->scheme == Scheme::serial,
        here, "a retry in the implicit scheme", "it with coupling.scheme serial",
        without + smaller_step);
    const std::string fault = fault_of_half_step(scene);
    require(fault.empty(), here, "a retry though " + fault,
            "room for at least one half step", without + ", or a smaller fluid.spacing");
}

}  // namespace magfsi::scene

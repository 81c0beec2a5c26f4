// SPDX-License-Identifier: GPL-2.0-or-later
// Checks of the coupled step: speeds in cells per step, the relaxation time, and what is
// left of both when a retry halves the step.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/scene/checks.h"
#include "adapters/scene/effective.h"
#include "fluid_lbm/collision/bulk_viscosity.h"

namespace magfsi::scene {

namespace {

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
            check_speed(largest_speed_m_s(body, body.prescribed_motion[i].course,
                                          scene.time.end_s),
                        "the prescribed motion's largest speed",
                        marks.item({"bodies", body.name, "prescribed_motion"}, i), fluid,
                        dt_s);
        if (!body.moved()) continue;
        double largest = 0;
        for (const MotionCourse& course : body.moved()->courses())
            largest += largest_speed_m_s(body, course, scene.time.end_s);
        check_speed(largest, "the prescribed motion's largest speed",
                    marks.key({"bodies", body.name, "moved"}), fluid, dt_s);
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

// The bound is that of the finest level, whose relaxation times are the longest.
void check_bulk_viscosity(const Scene& scene, const Marks& marks, double dt_s) {
    const Fluid& fluid = *scene.fluid;
    const double most_m2_s =
        fluid::largest_bulk_viscosity_m2_s(dt_s, fluid.finest_spacing_m());
    require(*fluid.bulk_viscosity_m2_s <= most_m2_s,
            marks.value({"fluid", "bulk_viscosity"}),
            fmt::format("a bulk viscosity of {:.4g} mm2/s at steps of {}",
                        *fluid.bulk_viscosity_m2_s * 1e6, seconds(dt_s)),
            fmt::format("at most {:.4g} mm2/s, up to which the lattice is stable",
                        most_m2_s * 1e6),
            "take less: explain tells the most useful value");
}

}  // namespace

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
    if (scene.fluid->bulk_viscosity_m2_s) check_bulk_viscosity(scene, marks, *dt_s);
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

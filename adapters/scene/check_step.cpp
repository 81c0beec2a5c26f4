// Limits of the coupled step: lattice speed and relaxation time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/scene/check_motion.h"
#include "adapters/scene/checks.h"
#include "adapters/scene/effective.h"
#include "adapters/scene/names.h"
#include "adapters/scene/unit.h"

namespace magfsi::scene {

namespace {

// The lattice's error grows with the square of the speed; beyond a quarter of a cell a
// step (Mach 0.43) it is no longer a weakly compressible fluid.
constexpr double most_lattice_speed = 0.25;
// OpenFOAM's implicit step is stable far beyond, but its explicit coupling is of first
// order.
constexpr double most_courant = 1;
// Above it walls slip.
constexpr double most_tau = 2;

void check_speed(double speed, std::string_view what, const Origin& where,
                 const Fluid& fluid, double dt_s) {
    const double most =
        fluid.solver == FluidSolver::lbm ? most_lattice_speed : most_courant;
    const double cells = speed * dt_s / fluid.spacing_m;
    if (cells <= most * (1 + 1e-9)) return;  // rounding is no fault
    refuse(where,
           fmt::format("{} {:.6g} m/s, which is {:.3g} cells a step", what, speed, cells),
           fmt::format("at most {}", most),
           fmt::format("take a step of at most {}",
                       format_si(most * fluid.spacing_m / speed, "s")));
}

double length(const Vec3& v) {
    return std::hypot(v[0], v[1], v[2]);
}

void check_speeds(const Scene& scene, const Marks& marks, double dt_s) {
    const Fluid& fluid = *scene.fluid;
    check_speed(fluid.expected_speed_m_s, "the expected speed",
                marks.value({"fluid", "expected_speed"}), fluid, dt_s);
    if (fluid.initial_velocity_m_s)
        check_speed(length(*fluid.initial_velocity_m_s), "the initial velocity",
                    marks.value({"fluid", "initial_velocity"}), fluid, dt_s);
    if (fluid.taylor_green)
        check_speed(fluid.taylor_green->speed_m_s, "the vortex's speed",
                    marks.value({"fluid", "taylor_green", "speed"}), fluid, dt_s);
    for (std::size_t face = 0; face < 6; ++face) {
        const std::string name(names<Face>[face]);
        const Boundary& side = fluid.boundaries[face];
        const std::string kind(name_of(side.kind));
        const bool inlet = side.kind == BoundaryKind::velocity_inlet;
        check_speed(length(inlet ? side.inlet.velocity_m_s : side.wall_velocity_m_s),
                    !inlet ? "the wall velocity" : "the inlet's velocity",
                    marks.value({"fluid", "boundaries", name, kind, "velocity"}), fluid,
                    dt_s);
    }
    for (const Body& body : scene.bodies) {
        for (std::size_t i = 0; i < body.prescribed_motion.size(); ++i)
            check_speed(largest_speed_m_s(body.prescribed_motion[i]),
                        "the prescribed motion's largest speed",
                        marks.item({"bodies", body.name, "prescribed_motion"}, i), fluid,
                        dt_s);
    }
}

// What to change so that 3 nu dt / dx^2 becomes `wanted`; its present value is `now`.
std::string advice(const Scene& scene, double dt_s, double now, double wanted) {
    const Fluid& fluid = *scene.fluid;
    const double factor = wanted / now;
    if (scene.time.step_s)
        return fmt::format("take time.step {} {}, or spacing {} {}",
                           factor > 1 ? "above" : "below", format_si(dt_s * factor, "s"),
                           factor > 1 ? "below" : "above",
                           format_si(fluid.spacing_m / std::sqrt(factor), "m"));
    // With the step from the lattice speed, 3 nu dt / dx^2 = 3 nu u_lattice / (U dx).
    const double lattice_speed = fluid.lattice_speed * factor;
    const std::string spacing =
        fmt::format("spacing {} {}", factor > 1 ? "below" : "above",
                    format_si(fluid.spacing_m / factor, "m"));
    if (lattice_speed > most_lattice_speed) return "take " + spacing;
    return fmt::format("take lattice_speed {} {:.3g}, or {}",
                       factor > 1 ? "above" : "below", lattice_speed, spacing);
}

void check_relaxation(const Scene& scene, const Marks& marks, double dt_s) {
    const auto relaxation = relaxation_time(scene);
    if (!relaxation) return;
    const Fluid& fluid = *scene.fluid;
    const double tau = *relaxation;
    if (tau >= least_relaxation_time && tau <= most_tau) return;
    const double wanted = tau < least_relaxation_time ? least_relaxation_time : most_tau;
    refuse(marks.value({"fluid", "viscosity"}),
           fmt::format(
               "a relaxation time of {:.6g} (viscosity {:.6g} m2/s, step {}, spacing "
               "{})",
               tau, fluid.viscosity_m2_s, format_si(dt_s, "s"),
               format_si(fluid.spacing_m, "m")),
           fmt::format("{} to {}", least_relaxation_time, most_tau),
           advice(scene, dt_s, tau - 0.5, wanted - 0.5));
}

}  // namespace

void check_step(const Scene& scene, const Marks& marks) {
    const std::optional<double> dt_s = coupled_step_s(scene);
    if (scene.fluid && !dt_s)
        refuse(marks.value({"fluid"}), "neither time.step nor fluid.expected_speed",
               "one of them, to set the coupled step",
               "add expected_speed, the largest speed that the run should resolve");
    if (!dt_s) return;
    // Rounding in lattice_speed * spacing / expected_speed is no fault.
    if (*dt_s > scene.time.end_s * (1 + 1e-9))
        refuse(marks.value({"time", "end"}),
               fmt::format("the end {} before the first step of {}",
                           format_si(scene.time.end_s, "s"), format_si(*dt_s, "s")),
               "at least one step");
    if (!scene.fluid) return;
    check_speeds(scene, marks, *dt_s);
    check_relaxation(scene, marks, *dt_s);
}

}  // namespace magfsi::scene

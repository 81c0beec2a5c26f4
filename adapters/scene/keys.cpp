// SPDX-License-Identifier: GPL-2.0-or-later
// The keys of the scene itself and of the options in scene.h. A comment before each
// function names the place of its group in the scene file.
#include "adapters/scene/keys.h"

#include <fmt/format.h>

// The layout below follows the nesting of the scene file.
// clang-format off

namespace magfsi::scene {

// Keys of `time.equilibrium`.
template <class Io>
void keys(Io& io, Equilibrium& equilibrium) {
    io(key("method", "newton: Newton's method on the sparse tangent, also with prescribed "
           "motion, without friction and contact; dynamics: damped motion in LAMMPS, without "
           "prescribed motion.").by_default(),
       equilibrium.method);
    io(key("tolerance", "Largest nodal force over the largest nodal load of the same "
           "moment; newton holds the displacements to it, too.").above(0)
           .at_most(0.01).by_default(),
       equilibrium.tolerance);
}

// Keys of `time`.
template <class Io>
void keys(Io& io, Time& time) {
    io(quantity("end", "s", "End of the run; it starts at 0.").above(0), time.end_s);
    io(quantity("step", "s", "Coupled step; without it, from the fluid's lattice speed, or "
                "without a fluid from the bodies' stable step.").above(0),
       time.step_s);
    io(key("equilibrium", "No motion: time is the parameter of a path of loads, and each "
           "probe row an equilibrium on it."), time.equilibrium);
}

// Keys of `control`.
template <class Io>
void keys(Io& io, Control& control) {
    io(key("script",
           "Name of a Python file with a class Controller (docs/control.md). It runs "
           "with the rights of the user who starts the run."), control.script);
    io(quantity("every", "s",
           "Time between two calls, a whole number of probes.every. The first call is at "
           "time 0.").above(0), control.every_s);
    io(key("probes",
           "Columns of probes.csv that the controller sees, with or without their unit.").optional(),
       control.probes);
    io(quantity("timeout", "s", "Longest time that an answer may take.").above(0).by_default(),
       control.timeout_s);
}

// Keys of `gravity`.
template <class Io>
void keys(Io& io, Gravity& gravity) {
    io(quantity("acceleration", "m/s2", "Strength of the acceleration.").at_least(0),
       gravity.acceleration_m_s2);
    io(key("direction",
           "Direction in which gravity pulls. Its length does not matter.").by_default(),
       gravity.direction);
}

// Keys of `damping`.
template <class Io>
void keys(Io& io, Damping& damping) {
    io(quantity("rate", "1/s",
           "Rate of the damping: each node feels the force -rate * mass * velocity.").at_least(0),
       damping.rate_1_s);
}

// Keys of `probes.points.NAME`.
template <class Io>
void keys(Io& io, PointProbe& point) {
    io(key("body", "Name of the body.").identifier(), point.body);
    io(quantity("at", "m",
           "Position of the point in the undeformed body, in its frame."), point.at_m);
}

// Keys of `probes.integrals.NAME.plane`.
template <class Io>
void keys(Io& io, FluidPlane& plane) {
    io(key("axis", "Normal of the plane. Flow along it is positive."), AxisRef{plane.axis});
    io(quantity("at", "m", "Coordinate at which the plane cuts the axis."), plane.at_m);
}

// Keys of `probes.integrals.NAME.part`.
template <class Io>
void keys(Io& io, BodyPart& part) {
    io(key("body", "Name of the body.").identifier(), part.body);
    io(quantity("box", "m",
           "Lower and upper corner of a box in the body's frame. Elements whose centre "
           "lies there belong to the part; without it, all do."), part.box_m);
}

// Keys of `probes.integrals.NAME`.
template <class Io>
void keys(Io& io, IntegralProbe& integral) {
    io.alternatives(integral.over,
        key("plane",
           "Integrals over a plane across the box, outside obstacles: volume flow, flux "
           "of momentum (of density times velocity), mean gauge pressure."),
        key("part",
           "Integrals over a part of a body: mean displacement by mass, momentum and, in "
           "a fluid, the fluid's force on it."));
}

// Keys of `probes`.
template <class Io>
void keys(Io& io, Probes& probes) {
    io(quantity("every", "s", "Time between rows.").above(0), probes.every_s);
    io(key("bodies", "Columns for each body; reaction_force: for each of its faces that is held or "
           "moved, what does that, by its clamps, rollers or motion. Nodes of two faces count "
           "in the first one; magnetic_load: force of all of the field, and its torque about the "
           "centre of mass; contact_load: the same of contact, platform and walls; rigid_motion: "
           "place, orientation and velocities of each rigid part.").optional(), probes.bodies);
    io(key("points",
           "Material points by name, of which position and displacement are written.").optional(),
       probes.points);
    io(key("integrals", "Integrals by name, over a plane of the fluid or a part of a body.")
           .optional(), probes.integrals);
    io(key("fluid", "Columns for the fluid.").optional(), probes.fluid);
    io(key("mean_forces",
           "If true, the fluid's force on bodies and parts of them is the mean since the last "
           "row, in columns mean_fluid_force_x[N] and so on; else that over the last step.")
           .by_default(), probes.mean_forces);
    io(key("interface_balance",
           "If true, columns tell momentum and power given and received at the bodies, "
           "and the impulse to the fluid.").by_default(), probes.interface_balance);
    io(key("energy_audit",
           "If true, columns tell energies, works and losses of all bodies, what the "
           "fluid has of them, and the residual.").by_default(), probes.energy_audit);
}

// Keys of `output.structure`.
template <class Io>
void keys(Io& io, StructureOutput& output) {
    io(quantity("every", "s", "Time between files.").above(0), output.every_s);
    io(key("fields", "What is written. Of nodes: displacement, velocity, magnetic_force, "
           "elastic_force; of elements: magnetization (at rest, and as it is turned and "
           "stretched now), stretches (the three principal ones), stress (Cauchy's), "
           "volume_ratio, energy_density.").by_default(), output.fields);
}

// Keys of `output.fluid`.
template <class Io>
void keys(Io& io, FluidOutput& output) {
    io(quantity("every", "s", "Time between files.").above(0), output.every_s);
    io(key("fields",
           "Fields that are written. pressure is gauge pressure; obstacle is 1 inside "
           "obstacles.")
           .by_default(), output.fields);
}

// Keys of `output`.
template <class Io>
void keys(Io& io, Output& output) {
    io(key("structure", "Fields of the bodies, in structure.pvd."), output.structure);
    io(key("fluid", "Fields of the fluid, in fluid.pvd."), output.fluid);
}

// Keys of `checkpoint`.
template <class Io>
void keys(Io& io, Checkpoint& checkpoint) {
    io(quantity("every", "s", "Time between two states. The two newest are kept.").above(0),
       checkpoint.every_s);
    io(key("on_divergence", "What magfsi run does when the run diverges: end, or go back to "
           "the last state kept and on from there with half of every step (the "
           "lattice-Boltzmann fluid, and bodies alone or in the serial scheme).").by_default(),
       checkpoint.on_divergence);
    io(key("max_retries", "Largest number of retries in a run.").at_least(1).at_most(8).by_default(),
       checkpoint.max_retries);
}

// Keys of `accuracy`.
template <class Io>
void keys(Io& io, Accuracy& accuracy) {
    io(quantity("error", "",
           "Largest error of the probes in parts of the largest value of their course, "
           "such as 3 %.").above(0).at_most(0.5), accuracy.error);
    io(key("probes",
           "Columns of probes.csv to which the tolerance applies. Without them, those of "
           "the bodies' motion, or without bodies all.").optional(), accuracy.probes);
    io(key("norm", "Number of a probe's course whose error is meant.").by_default(), accuracy.norm);
    io(quantity("budget", "s", "Time that the runs which find the setting may take.")
           .above(0).by_default(),
       accuracy.budget_s);
}

// Keys at the top level of the scene file.
template <class Io>
void keys(Io& io, Scene& scene) {
    io(key("name", "Name of the scene, which names the run folder, runs/NAME.").by_default(),
       scene.name);
    io(key("time", "Length of the run and its step."), scene.time);
    io(key("bodies", "Soft magnetic bodies by name.").optional(), scene.bodies);
    io(key("magnetic_field",
           "Applied field: a law of time for all of space, sources that vary in space, or "
           "both."),
       scene.magnetic_field);
    io(key("dipoles",
           "Forces of magnetised bodies on each other: each element is a dipole. Every "
           "pair counts in every step (docs/lab/effects.md)."),
       scene.dipoles);
    io(key("control",
           "Program that sees probes and sets the magnetic field as the run goes on."),
       scene.control);
    io(key("gravity", "Weight of the bodies; in a fluid, less their buoyancy."), scene.gravity);
    io(key("damping", "Drag on every node of the bodies."), scene.damping);
    io(key("platform", "Plane that bodies cannot pass and may leave freely."), scene.platform);
    io(key("contact",
           "Contact between the surfaces of bodies, and of a body with itself; in a "
           "fluid also with the sides of its box that are not periodic, and with its "
           "obstacles."),
       scene.contact);
    io(key("fluid", "Viscous fluid in a box with its lowest corner at the origin."),
       scene.fluid);
    io(key("coupling", "Options of how bodies and fluid meet. All keys have defaults."),
       scene.coupling);
    io(key("probes", "Time series in probes.csv."), scene.probes);
    io(key("output", "Fields for ParaView.").optional(), scene.output);
    io(key("report",
           "If on, report.html, a page with all of the run, is written when ./magfsi run "
           "has ended.")
           .by_default(), scene.report);
    io(key("checkpoint",
           "States that are kept, so that the run can go on from there (--restart)."),
       scene.checkpoint);
    io(key("accuracy",
           "Tolerance within which magfsi run takes the cheapest spacing, step, mesh and "
           "substeps in place of the scene's (magfsi cost)."), scene.accuracy);
}

MAGFSI_KEYS_OF(Scene)
// clang-format on

// Angles are written in degrees, as users do.
std::string yaml_text(const nlohmann::ordered_json& value, const std::string& unit) {
    if (value.is_array()) {
        std::string list;
        for (const auto& item : value)
            list += (list.empty() ? "[" : ", ") + yaml_text(item, unit);
        return list + "]";
    }
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_number_float()) return value.dump();
    const bool angle = unit == "rad";
    std::string text = fmt::format(
        "{}", angle ? value.get<double>() * 180 / std::numbers::pi : value.get<double>());
    const std::size_t zero = text.find("e-0");  // 1e-06 becomes 1e-6
    if (zero != std::string::npos) text.erase(zero + 2, 1);
    return unit.empty() ? text : fmt::format("{} {}", text, angle ? "deg" : unit);
}

const Field& scene_fields() {
    static const Field fields = [] {
        Field whole = key("", "A scene: what is there, and for how long.");
        Scene scene;
        Describer describer(whole);
        keys(describer, scene);
        return whole;
    }();
    return fields;
}

}  // namespace magfsi::scene

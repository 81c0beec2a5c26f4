#include "adapters/scene/fields.h"

// The nesting below is that of the file.
// clang-format off

namespace magfsi::scene {

const Field& scene_fields() {
    static const Field scene = group("", "A scene: what is there, and for how long.", {
        text("name", "Name of the scene, in the summary and the log.").or_default("scene"),
        group("time", "Length of the run and its step.", {
            quantity("end", "s", "End of the run; it starts at 0.").above(0),
            quantity("step", "s", "Coupled step; without it, from the fluid's lattice "
                     "speed, or without a fluid from the bodies' stable step.")
                .above(0).optional(),
            group("equilibrium", "No motion: time is the parameter of a path of loads, and "
                  "each probe row an equilibrium on it.", {
                choice<EquilibriumMethod>("method", "newton: Newton's method on the sparse "
                                          "tangent; dynamics: damped motion in LAMMPS, also "
                                          "with contact.").or_default("newton"),
                number("tolerance", "Largest nodal force over the largest nodal load.")
                    .above(0).at_most(0.01).or_default("1e-6"),
            }).optional(),
        }),
        group("accuracy", "In place of fluid.spacing and of a block's elements: magfsi run "
              "and explain choose them by the studies of docs/accuracy.", {
            quantity("error", "%", "The coarsest that keeps the studied error below this.")
                .above(0).at_most(50).alternative(),
            quantity("time", "s", "The finest that is predicted to take no longer.").above(0)
                .alternative(),
        }).optional(),
        bodies_fields().optional(),
        magnetic_field_fields().optional(),
        group("gravity", "Weight of the bodies; in a fluid, less their buoyancy.", {
            quantity("acceleration", "m/s2", "Strength.").at_least(0),
            number("direction", "Where it pulls; any length.").vector(3)
                .or_default("[0, 0, -1]"),
        }).optional(),
        group("damping", "Drag on every node of the bodies.", {
            quantity("rate", "1/s", "Force = -rate * mass * velocity.").at_least(0),
        }).optional(),
        group("platform", "Plane that bodies cannot pass and may leave freely.", {
            quantity("point", "m", "A point of it.").vector(3)
                .or_default("[0 m, 0 m, 0 m]"),
            number("normal", "Towards the bodies; any length.").vector(3)
                .or_default("[0, 0, 1]"),
            quantity("stiffness", "Pa/m", "Pressure over penetration; without it, so "
                     "that bodies sink in by far less than their thickness.")
                .above(0).optional(),
            number("friction", "Coulomb's coefficient; without it, none.").above(0)
                .at_most(10).optional(),
        }).optional(),
        group("contact", "Between the surfaces of bodies, and of a body with itself.", {
            quantity("distance", "m", "Where surfaces of nodes begin to repel; without it, "
                     "the thickness of the thinnest body.").above(0).optional(),
            quantity("stiffness", "Pa/m", "Pressure over approach; without it, from the "
                     "bodies.").above(0).optional(),
        }).optional(),
        fluid_fields().optional(),
        coupling_fields().optional(),
        probes_fields().optional(),
        output_fields().optional(),
        group("checkpoint", "Keeps the state, so that the run can go on from there "
              "(--restart).", {
            quantity("every", "s", "Time between states; the two newest are kept.").above(0),
            choice<OnDivergence>("on_divergence", "What magfsi run does when the run diverges: "
                                 "end, or go back to the last state kept and on from there "
                                 "with half of every step (the lattice-Boltzmann fluid, and "
                                 "bodies alone or in the serial scheme).").or_default("stop"),
            integer("max_retries", "At most, in a run.").at_least(1).at_most(8).or_default("3"),
        }).optional(),
    });
    return scene;
}

Field magnetic_field_fields() {
    const auto magnitude = [] {
        return quantity("magnitude", "T", "Flux density; a negative one points backwards.");
    };
    return group("magnetic_field", "Uniform applied field over time.", {
        plane("plane", "Plane of the field; angles run from its first axis to its second.")
            .or_default("xz"),
        group("constant", "Held still.", {
            magnitude(),
            quantity("direction", "rad", "Angle in the plane."),
        }).alternative(),
        group("table", "Linear between rows; before the first and after the last, held.", {
            quantity("time", "s", "Times of the rows, ascending.").list(),
            quantity("magnitude", "T", "One a row; the sign flips the field.").list(),
            quantity("direction", "rad", "Angle in the plane: one for all, or one a row.")
                .one_or_list(),
            boolean("repeat", "Start again after the last row.").or_default("false"),
        }).alternative(),
        group("rotation", "Turns at constant speed.", {
            magnitude(),
            quantity("start", "rad", "Angle at time 0.").or_default("0 deg"),
            quantity("frequency", "1/s", "Turns a second; negative turns backwards."),
        }).alternative(),
        group("gradient", "Adds a field that is linear in space and constant in time.", {
            quantity("matrix", "T/m", "Rows of dB_i / dx_j; symmetric and traceless.")
                .rows(3, 3, 3),
            quantity("origin", "m", "Where it adds nothing.").vector(3)
                .or_default("[0 m, 0 m, 0 m]"),
        }).optional(),
    });
}

Field iteration_fields() {
    return group("iteration", "Of the implicit scheme: how a step is repeated.", {
        choice<AccelerationMethod>("acceleration", "How the next guess is made.")
            .or_default("iqn_ils"),
        number("velocity_tolerance", "The step has converged when the fluid answers to the "
               "guess of its velocities at the markers with the same velocities, up to this "
               "part of their root mean square.").above(0).at_most(0.1).or_default("1e-4"),
        integer("max_iterations", "Iterations in a step.").at_least(2).at_most(1000).or_default("20"),
        choice<OnNoConvergence>("on_no_convergence", "What a step does that has not converged then: "
                            "end the run, or go on and be counted.").or_default("stop"),
        choice<InitialGuess>("initial_guess", "constant: the velocities of the step's start; "
                           "linear: they go on to change as in the step before.")
            .or_default("linear"),
        number("relaxation", "Part of the residual that is added to the guess; aitken and "
               "iqn_ils begin with it.").above(0).at_most(1).or_default("0.5"),
        integer("max_used_iterations", "Of iqn_ils: pairs of answers that it may build on.")
            .at_least(1).at_most(200).or_default("40"),
        integer("reused_steps", "Of iqn_ils: coupled steps before this one whose pairs are "
                "kept.").at_least(0).at_most(100).or_default("8"),
        choice<ColumnFilter>("filter", "Of iqn_ils: a pair goes when what is new in it is "
                             "below filter_limit of all pairs (qr1), or of itself (qr2).")
            .or_default("qr2"),
        number("filter_limit", "Of iqn_ils.").above(0).at_most(0.9).or_default("1e-2"),
    });
}

Field coupling_fields() {
    return group("coupling", "How bodies and fluid meet; all keys have defaults.", {
        choice<Scheme>("scheme", "serial: structure and fluid take turns; parallel: both "
                       "work at once, and the fluid feels the bodies one step late; "
                       "implicit: they repeat each step until both agree on its end.")
            .or_default("serial"),
        choice<SampledVelocity>("sampled_velocity", "What bodies feel of the fluid in their "
                                "substeps. frozen: its velocity at the step's start, or "
                                "the mean of two samples (parallel, implicit); linear: a "
                                "straight line through the velocities at the step's two "
                                "ends, in the serial scheme through the last two. "
                                "Without it: linear if implicit, else frozen.").optional(),
        iteration_fields().optional(),
        integer("substeps", "Structure steps in a coupled step; without it, from the "
                "bodies' stable step.").at_least(1).at_most(100000).optional(),
        quantity("timeout", "s", "Longest wait for the partner before the run is given up.")
            .above(0).or_default("60 s"),
        group("immersed_boundary", "Direct forcing between markers and fluid, eq. (13).", {
            choice<Kernel>("kernel", "Regularised delta function.").or_default("3-point"),
            choice<Markers>("markers", "Where markers sit: midway between the large faces "
                            "of a sheet, below both of them, or through the volume; without "
                            "it, below both faces of sheets and through other bodies.")
                .optional(),
            number("marker_spacing", "Distance of markers, in fluid spacings; beyond about "
                   "1 the surface leaks.").above(0).at_most(1.5).or_default("0.5"),
            number("retraction", "Depth of markers below the surface, in fluid spacings: "
                   "the kernel smears them beyond it.")
                .at_least(0).at_most(1).or_default("0.4"),
            number("rim_retraction", "The same at the rim of a sheet.").at_least(0)
                .at_most(2).or_default("0.9"),
            number("strength", "beta of eq. (13) as a fraction of 2 rho dV / dt; 1 is "
                   "direct forcing.").above(0).at_most(4).or_default("1.0"),
            integer("iterations", "Of the forcing in a coupled step (multi-direct forcing): "
                    "each after the first takes of what is left of the slip; 1 is direct "
                    "forcing, beyond 2 sheets may oscillate.").at_least(1).at_most(4).or_default("1"),
        }).optional(),
    });
}

}  // namespace magfsi::scene

// SPDX-License-Identifier: GPL-2.0-or-later
// The keys of `coupling`, stored in coupler/options.h.
#include "adapters/scene/keys.h"

// The layout below follows the nesting of the scene file.
// clang-format off

namespace magfsi::scene {

// Keys of `coupling.iteration`, options of the implicit scheme (Degroote, Bathe, Vierendeels 2009;
// Haelterman et al. 2016).
template <class Io>
void keys(Io& io, Iteration& iteration) {
    io(key("acceleration", "Method that makes the next guess.").by_default(),
       iteration.acceleration);
    io(key("velocity_tolerance", "The step has converged when the fluid responds to the "
           "guess of its velocities at the markers with the same velocities, up to this part "
           "of their root mean square.").above(0).at_most(0.1).by_default(),
       iteration.velocity_tolerance);
    io(key("max_iterations", "Largest number of iterations in a step.")
           .at_least(2).at_most(1000).by_default(),
       iteration.max_iterations);
    io(key("on_no_convergence",
           "What happens after max_iterations: stop ends the run, continue goes on with "
           "the next step and counts this one.").by_default(),
       iteration.on_no_convergence);
    io(key("initial_guess",
           "First guess of a step. constant: the velocities at the step's start; linear: "
           "extrapolated from the step before.").by_default(),
       iteration.initial_guess);
    io(key("relaxation", "Part of the residual that is added to the guess at first: in the "
           "first iteration of aitken, and in iqn_ils as long as it has no column.").above(0).at_most(1).by_default(),
       iteration.relaxation);
    io(key("max_used_iterations",
           "Largest number of columns in the least-squares model of iqn_ils.")
           .at_least(1).at_most(200).by_default(),
       iteration.max_used_iterations);
    io(key("reused_steps",
           "Number of earlier coupled steps whose iterations iqn_ils uses.")
           .at_least(0).at_most(100).by_default(),
       iteration.reused_steps);
    io(key("filter_limit", "Part of a column that must be independent of the newer ones: iqn_ils "
           "drops the column if less is.").above(0).at_most(0.9).by_default(),
       iteration.filter_limit);
}

// Keys of `coupling.immersed_boundary`.
template <class Io>
void keys(Io& io, ImmersedBoundary& boundary) {
    io(key("forcing", "How a marker's slip becomes a force: penalty is eq. (13) with the fluid "
           "of its own volume; no_slip makes the fluid that passes the body move with it, with "
           "markers about one spacing apart. Without it: no_slip with solver lbm and 2-point "
           "or 3-point kernels; penalty in others, and where a key is given that belongs to "
           "the penalty. With solver openfoam the step is repeated (scheme: implicit) until "
           "the fluid moves with the body."),
       boundary.forcing);
    io(key("kernel", "Regularised delta function.").by_default(), boundary.kernel);
    io(key("strength",
           "Coefficient beta of eq. (13) as a fraction of 2 rho dV / dt. With 1 it is "
           "direct forcing.")
           .above(0).at_most(4).by_default(),
       boundary.strength);
}

// Keys of `coupling` itself.
template <class Io>
void keys(Io& io, Coupling& coupling) {
    io(key("scheme", "serial: structure and fluid take turns; implicit: they repeat each step "
           "until it has converged. Without it: serial, but implicit where bodies of less than "
           "half of the fluid's density have contact, and with forcing no_slip in OpenFOAM.").optional(),
       coupling.scheme);
    io(key("structure",
           "Origin of the bodies. bodies: those of the scene; own: a program of yours, "
           "which run --structure names.").by_default(),
       coupling.structure);
    io(key("sampled_velocity", "The fluid's velocity that bodies feel in their substeps. "
           "frozen: that at the step's start, if implicit the mean of those at its two ends; "
           "linear: a straight line through the velocities at the step's two ends, in the "
           "serial scheme through the last two. Without it: linear if implicit, else frozen."),
       coupling.sampled_velocity);
    io(key("iteration", "Options of the implicit scheme: how a step is repeated."),
       coupling.iteration);
    io(key("substeps",
           "Number of structure steps in a coupled step. Without it, it follows from the "
           "bodies' stable step.").at_least(1).at_most(100000),
       coupling.substeps);
    io(quantity("timeout", "s", "Longest wait for the partner before the run is given up; "
                "without it, one that lives is waited for.").above(0),
       coupling.timeout_s);
    io(key("overlap",
           "What happens where a body overlaps with itself, another one, an obstacle or "
           "a side of the box. stop ends the run, after a warning where surfaces come "
           "within half a cell; allow does not look.").by_default(),
       coupling.overlap);
    io(key("immersed_boundary", "Direct forcing between markers and fluid, eq. (13).")
           .optional(),
       coupling.immersed_boundary);
}

MAGFSI_KEYS_OF(Coupling)

}  // namespace magfsi::scene

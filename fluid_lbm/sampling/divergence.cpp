// SPDX-License-Identifier: GPL-2.0-or-later
// Report of a diverged cell: its place, its state and the likely cause.
#include <cmath>
#include <sstream>

#include "fluid_lbm/state.h"

namespace magfsi::fluid {

namespace {

// Change of speed in one step above which a force is named as the cause: a quarter of the
// speed limit, which the force in a resolved flow does not reach.
constexpr double hard_push = lattice_speed_limit / 4;

// Relaxation time below which collisions that keep ghost modes damp them by less than a
// tenth per step.
constexpr double low_relaxation_time = 0.51;

// The first cause that applies.
DivergenceCause likely_cause(const Divergence& d) {
    // The order matters: a hard force acts directly; a value that is not finite is
    // certain; a low relaxation time amplifies speeds that were moderate before.
    if (!std::isfinite(d.lattice_force) || !(d.lattice_force <= hard_push)) {
        return DivergenceCause::force;
    }
    if (!std::isfinite(d.density) || !std::isfinite(d.lattice_speed)) {
        return DivergenceCause::not_finite;
    }
    return d.relaxation_time < low_relaxation_time ? DivergenceCause::relaxation_time
                                                   : DivergenceCause::speed;
}

// Relaxation time of the cell. Where the viscosity depends on the rate of shear, that of
// its speed across one cell, which is of the order of the largest on the grid.
double local_relaxation_time(const FluidConfig& config, double lattice_speed) {
    if (!config.rheology || !std::isfinite(lattice_speed)) return relaxation_time(config);
    const double rate_1_s = lattice_speed / config.time_step_s;
    return relaxation_time(
        viscosity_m2_s(*config.rheology, config.viscosity_m2_s, rate_1_s),
        config.time_step_s, config.spacing_m);
}

// What makes a force smaller: a body force above the limit is the cause by itself, the
// other forces are those of immersed bodies, and only the penalty has a strength.
const char* softer(const FluidConfig& config) {
    if (2 * norm(half_body_force(config)) > hard_push)
        return "take a smaller fluid.body_force or a shorter time step";
    return config.holds_no_slip
               ? "take a shorter time step or more coupling.substeps"
               : "take a shorter time step, more coupling.substeps or a smaller "
                 "coupling.immersed_boundary.strength";
}

// What damps more: what the configuration has already, or does not allow, is left out.
std::string more_damping(const FluidConfig& config) {
    const Collision now = choose_collision(config);
    std::string text = "take finer spacing or a higher viscosity";
    if (!config.rheology && !(config.smagorinsky_constant > 0))
        text += ", an eddy viscosity (fluid.smagorinsky)";
    if (now == Collision::bgk || now == Collision::trt)
        text += ", or collision: recursive_regularized";
    return text;
}

// The cause in words, with a remedy that this configuration allows.
std::string cause_and_remedy(const Divergence& d, const FluidConfig& config) {
    std::ostringstream text;
    text.precision(3);
    switch (d.cause) {
        case DivergenceCause::force:
            text << "the force changes its speed by " << d.lattice_force
                 << " cells in one step: " << softer(config);
            break;
        case DivergenceCause::not_finite:
            text << "a value was not finite when it entered: check the initial flow, the "
                    "boundaries and the forces";
            break;
        case DivergenceCause::relaxation_time:
            text << "relaxation time " << d.relaxation_time
                 << (config.rheology ? ", with the viscosity of this speed across a cell,"
                                     : "")
                 << " damps little: " << more_damping(config);
            break;
        case DivergenceCause::speed:
            text << "Mach number " << std::sqrt(3.0) * d.lattice_speed
                 << " is too high for the lattice: take a shorter time step";
            break;
    }
    return text.str();
}

}  // namespace

std::optional<Divergence> Fluid::diverged() const {
    const State& s = *state_;
    if (!s.invalid) return {};
    const InvalidCell& cell = *s.invalid;
    const auto& first = s.owned().lo;
    Divergence d;
    d.cell = {first[0] + cell.x, first[1] + cell.y, first[2] + cell.z};
    for (int a = 0; a < 3; ++a) d.position_m[a] = (d.cell[a] + 0.5) * s.config.spacing_m;
    d.lattice_speed = cell.speed;
    d.density = cell.density;
    d.lattice_force = cell.force;
    d.relaxation_time = local_relaxation_time(s.config, cell.speed);
    d.step = s.invalid_step;
    d.cause = likely_cause(d);
    d.remedy = cause_and_remedy(d, s.config);
    return d;
}

std::string to_string(const Divergence& d) {
    std::ostringstream text;
    text.precision(4);
    text << "the fluid diverged after step " << d.step;
    if (d.level) text << " of level " << *d.level << " of the refined grid";
    text << " in cell (" << d.cell[0] << ", " << d.cell[1] << ", " << d.cell[2]
         << ") at (" << d.position_m[0] << ", " << d.position_m[1] << ", "
         << d.position_m[2] << ") m: speed " << d.lattice_speed
         << " cells a step, of which the lattice allows " << lattice_speed_limit
         << ", density " << d.density << " of that at rest; " << d.remedy;
    return text.str();
}

}  // namespace magfsi::fluid

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

// The cause in words, with a remedy.
std::string advice(const Divergence& d) {
    std::ostringstream text;
    text.precision(3);
    switch (d.cause) {
        case DivergenceCause::force:
            text << "the force changes its speed by " << d.lattice_force
                 << " cells in one step: use a softer coupling, more substeps or a "
                    "shorter time step";
            break;
        case DivergenceCause::not_finite:
            text << "a value was not finite when it entered: check the initial flow, the "
                    "boundaries and the forces";
            break;
        case DivergenceCause::relaxation_time:
            text << "relaxation time " << d.relaxation_time
                 << " damps little: use the recursive_regularized collision, an eddy "
                    "viscosity, finer spacing or a higher viscosity";
            break;
        case DivergenceCause::speed:
            text << "Mach number " << std::sqrt(3.0) * d.lattice_speed
                 << " is too high for the lattice: use a shorter time step";
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
    d.relaxation_time = relaxation_time(s.config);
    d.step = s.invalid_step;
    d.cause = likely_cause(d);
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
         << ", density " << d.density << " of that at rest; " << advice(d);
    return text.str();
}

}  // namespace magfsi::fluid

// SPDX-License-Identifier: GPL-2.0-or-later
// Bulk viscosity of the lattice, and how long sound lives in a box.
//
// A body that starts suddenly makes sound, which a closed box keeps: with the viscosity
// of water it lives for seconds. The rate at which the trace of the stress relaxes is
// free (d'Humieres et al. 2002; Dellar, Phys. Rev. E 64, 031203, 2001): a flow that is
// free of divergence has no trace, so that this rate damps sound and leaves shear alone.
//
// Bulk viscosity. Let n be the second moment of the populations beyond its equilibrium,
// rho u u + rho / 3, before the collision (lattice units, c^2 = 1/3 the speed of sound
// squared). The trace of the second moment obeys
//   d/dt (rho u^2 + rho) + div(5/3 rho u) = - tr n / tau_b,
// 5/3 from the third moment of the equilibrium; with d rho / dt = - div(rho u), to first
// order in the velocity, tr n = - 2/3 rho tau_b div u. The rest of n is, as ever,
// - 2/3 rho tau S', S' the rate of strain without its trace. A step transports n less
// half of what the collision takes off it, which makes the stress
//   2/3 (tau - 1/2) rho S' + 2/9 (tau_b - 1/2) rho (div u) I,
//   nu = (tau - 1/2) / 3,   nu_b = 2/9 (tau_b - 1/2).
// A single rate has nu_b = 2/3 nu.
//
// Sound. A wave exp(i k x + s t) in a fluid at rest solves
//   s^2 + k^2 c^2 + k^2 s [4/3 nu + nu_b / (1 + s t_b)] = 0,   t_b = (tau_b - 1/2) steps:
// the trace needs the time t_b to follow, nu_b = 2/3 c^2 t_b. Its amplitude decays as
//   exp(-k^2/2 [4/3 nu + nu_b / (1 + (c k t_b)^2)] t),
// to second order in nu k / c, which for c k t_b << 1 is the viscous
// exp(-k^2/2 (4/3 nu + nu_b) t). Short waves, c k t_b >> 1, run at sqrt(5/3) c and decay
// as exp(-t / (5 t_b)).
//
// Most useful value. The slowest wave of a box between walls L apart has k = pi / L. Its
// decay is fastest at c k t_b = 1; with half of that, nu_b = c / (3 k), it is 4/5 as
// fast, short waves decay twice as fast, and the density follows the pressure with half
// the delay, nu_b / c^2. Then all sound decays to 1/e within 2.4 crossings L / c. The
// pressure that bodies and walls feel has no delay: it is the sum of density and trace
// that keeps the flow free of divergence.
//
// Stability. The rate 1 / tau_b may have any value in (0, 2) in a fluid at rest. In a
// uniform flow the 19 eigenvalues of a step were computed for 450 waves along three
// directions: with recursive_regularized, relaxation times from 0.5015 and speeds up to
// 0.15 all stay within 1 for every rate from 0.005 on; trt and recursive_mrt are stable
// at a speed of 0.1 from 0.52 on, as without. fitted::least_trace_rate keeps a distance.
#pragma once

#include "base/fitted/constants.h"

namespace magfsi::fluid {

// Relaxation time tau_b of the trace, in steps.
constexpr double trace_relaxation_time(double bulk_m2_s, double time_step_s,
                                       double spacing_m) {
    return 4.5 * bulk_m2_s * time_step_s / (spacing_m * spacing_m) + 0.5;
}

// Largest bulk viscosity that is stable on a grid.
constexpr double largest_bulk_viscosity_m2_s(double time_step_s, double spacing_m) {
    return (1 / fitted::least_trace_rate - 0.5) / 4.5 * spacing_m * spacing_m /
           time_step_s;
}

// Bulk viscosity that damps sound best whose slowest wave has the wave number k [1/m].
constexpr double useful_bulk_viscosity_m2_s(double sound_m_s, double wave_number_1_m) {
    return sound_m_s / (3 * wave_number_1_m);
}

// Rate [1/s] at which the amplitude of a standing wave decays. wave_number_1_m: k.
constexpr double sound_decay_1_s(double viscosity_m2_s, double bulk_m2_s,
                                 double sound_m_s, double wave_number_1_m) {
    const double ck = sound_m_s * wave_number_1_m;
    const double lag = 1.5 * bulk_m2_s / (sound_m_s * sound_m_s) * ck;  // c k t_b
    return wave_number_1_m * wave_number_1_m / 2 *
           (4.0 / 3 * viscosity_m2_s + bulk_m2_s / (1 + lag * lag));
}

}  // namespace magfsi::fluid

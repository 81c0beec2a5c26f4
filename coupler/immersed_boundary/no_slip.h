// SPDX-License-Identifier: GPL-2.0-or-later
// Forcing no_slip: the force that makes the fluid which passes the body move with it.
//
// In Guo's scheme mass moves with q = U + F dt / (2 rho), where U is the velocity before
// the force acts and rho the density of the cell. (With the density at rest instead, a
// pressure that is held inside a body moves mass by half of the force times the density's
// relative deviation: where the pressure is low it falls without end, as in a ball held
// at a lattice speed of 0.08 at Re 10.) Markers overlap, so that forces F = 2 rho dV / dt
// (V - U) bring q only part of the way. The row sum r of the marker system is what unit
// slip everywhere would give back at the marker,
//   r = interpolate(spread(dV)),
// and F = 2 rho dV / (r dt) (V - U) makes q = V where the slip is uniform. Where it is
// not, a memory p of the slip removes the rest over some steps:
//   F = s 2 rho dV / (r dt) (V - U + p),   p <- p + gain (mean V - q) - leak (r f - g),
// with f = F dt / (2 rho dV) the change by the marker's own force and g = q - U the
// change by all forces together. An even force has g = r f; it is held without slip, as a
// pressure is. A force that the fluid does not feel, g = 0, decays by the leak. Where
// markers fill a volume the fluid there follows nothing else: with s = 1 its difference
// to the body would change sign in every step and not decay; with s = 3/4 this difference
// and p together decay to 0.4 of themselves in a step.
//
// The leak is larger in the core of thick sheets. Three velocities per marker and a
// volume that is kept in each cell are more conditions there than the fluid has
// velocities: where they contradict each other, as where a sheet bends, pressure and p
// grow against each other.
//
// Markers must stand about a cell apart, and in one layer where the body is thin: closer
// ones make the marker system nearly singular, and the memory drifts in its null modes.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "base/fitted/constants.h"
#include "coupler/immersed_boundary/direct_forcing.h"

namespace magfsi::coupler {

// The fluid's answer for each marker besides its velocity: the row sum at the new
// position, and q [m/s] at the old one in the step that has been done.
struct NoSlipAnswer {
    std::vector<double> row_sum;
    std::vector<Vec3> passed;

    // Sizes the arrays; values of markers that were there before remain.
    void make_room(std::size_t markers) {
        row_sum.resize(markers);
        passed.resize(markers);
    }
};

// The quantities that gain and leak depend on, all on the grid at the bodies: the fluid's
// viscosity, the largest speed that the run should resolve (0 if not known), spacing and
// coupled step.
struct SlipScale {
    double viscosity_m2_s = 0;
    double speed_m_s = 0;
    double spacing_m = 0;
    double coupled_step_s = 0;
};

// Gain and leak of the memory per coupled step, and the leak in the core of thick sheets.
struct SlipRates {
    double gain, leak, core_leak;
};

// Gain and leak for a fluid and a step. The gain is 1/4; it falls with the viscosity nu
// dt / h^2 beyond 0.1, which is a relaxation time of 0.8.
//
// Under steady forces the slip that remains is leak / gain (r f - g). There f is
// proportional to the step, whereas the velocity that the force F of a single marker can
// hold does not depend on it: F / (rho h (nu + c u h)), from viscosity and from the flow
// past it. Leak over gain is made proportional to their ratio, so that the same forces
// leak away at any step:
//   leak / gain = 0.008 / (nu dt / h^2 + 2 u dt / h).
// With a constant leak of 0.02 the flow past held balls fell by 1.5 % with every halving
// of the step, as if the balls were 0.1 h larger. The factor 2 makes the leak 0.02 for
// sheets at the usual speed of 0.05 h per step. A larger speed does not lower leak / gain
// below 0.008 / max(0.1, nu dt / h^2). The leak is at most the gain, at which the memory
// holds nothing more.
//
// In the core of sheets the leak is four times as large.
inline SlipRates slip_rates(const SlipScale& scale) {
    using namespace fitted;
    const double per_step = scale.coupled_step_s / scale.spacing_m;
    const double speed =
        scale.speed_m_s > 0 ? scale.speed_m_s * per_step : usual_lattice_speed;
    const double viscous = scale.viscosity_m2_s * per_step / scale.spacing_m;
    const double ruling = std::max(fully_gains_until, viscous);
    const double gain = most_gain * fully_gains_until / ruling;
    const double of_gain = std::clamp(leak_over_gain / (viscous + leak_per_speed * speed),
                                      leak_over_gain / ruling, 1.0);
    return {gain, of_gain * gain, std::min(core_leak * of_gain, 1.0) * gain};
}

// The memory p of the slip at this rank's markers [m/s].
class SlipMemory {
  public:
    SlipMemory(std::span<const Marker> markers, const SlipRates& rates)
        : memory_(markers.size()), gain_(rates.gain) {
        for (const Marker& m : markers)
            leak_.push_back(m.core ? rates.core_leak : rates.leak);
    }

    // Adds a coupled step. mean_velocity: the markers' in the step; passed: q; uneven: r
    // f - g, all [m/s].
    void add(std::span<const Vec3> mean_velocity, std::span<const Vec3> passed,
             std::span<const Vec3> uneven) {
        for (std::size_t m = 0; m < memory_.size(); ++m)
            memory_[m] += gain_ * (mean_velocity[m] - passed[m]) - leak_[m] * uneven[m];
    }

    // U - p, which takes the place of U in the force [m/s].
    std::vector<Vec3> felt(std::span<const Vec3> fluid_velocity) const {
        std::vector<Vec3> all(fluid_velocity.begin(), fluid_velocity.end());
        for (std::size_t m = 0; m < all.size(); ++m) all[m] -= memory_[m];
        return all;
    }

    std::span<Vec3> values() { return memory_; }  // p, for checkpoints

  private:
    std::vector<Vec3> memory_;
    double gain_;
    std::vector<double> leak_;
};

}  // namespace magfsi::coupler

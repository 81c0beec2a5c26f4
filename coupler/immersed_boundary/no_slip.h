// SPDX-License-Identifier: GPL-2.0-or-later
// Forcing no_slip: the force after which the fluid that passes the body has its velocity.
//
// In Guo's scheme mass moves with q = U + F dt / (2 rho), U the velocity before the
// force and rho the density of the cell. (With the density of rest a pressure that is
// held inside a body moves mass by half of the force times the density's share: where it
// is low it falls without end, as in a ball held at a lattice speed of 0.08 at Re 10.)
// Markers overlap, so that a force F = 2 rho dV / dt (V - U) of each brings q only
// part of the way. With the row sum r of the marker system, what unit slip everywhere
// would give back at the marker,
//   r = interpolate(spread(dV)),
// F = 2 rho dV / (r dt) (V - U) makes q = V where the slip is uniform. What is left where
// it is not, a memory p of it removes over some steps:
//   F = s 2 rho dV / (r dt) (V - U + p),   p <- p + gain (mean V - q) - leak (r f - g),
// f = F dt / (2 rho dV), and g = q - U what these forces together do at the marker. An
// even force has g = r f: what it holds, such as a pressure, is held without slip. A
// force of which the fluid feels nothing, g = 0, is let go. Where markers fill a volume,
// the fluid there follows nothing else: with s = 1 its difference to the body changes
// sign in every step and does not decay, with 3/4 the pair of it and p decays to 0.4 in a
// step.
//
// In the core of thick sheets more is let go. There three velocities a marker and a
// volume that is kept in each cell are more conditions than the fluid has velocities:
// where they contradict each other, as where a sheet bends, pressure and p grow against
// each other.
//
// Markers must stand about a cell apart, in one layer where the body is thin: closer ones
// make the marker system nearly singular, and the memory drifts in its null modes.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "coupler/immersed_boundary/direct_forcing.h"

namespace magfsi::coupler {

// What the fluid says of each marker besides its velocity: the row sum at its new
// position, and q [m/s] at the old one in the step that has been done.
struct NoSlipAnswer {
    std::vector<double> row_sum;
    std::vector<Vec3> passed;

    void make_room(std::size_t markers) {
        row_sum.resize(markers);
        passed.resize(markers);
    }
};

// Markers that stand alone, at a rim or beside an obstacle, have small row sums; a force
// beyond this multiple of their own fluid would need too many substeps.
constexpr double least_row_sum = 0.25;

constexpr double no_slip_strength = 0.75;  // s

// What gain and leak depend on: the fluid's viscosity and the largest speed that the run
// should resolve (0: not known), on the grid at the bodies.
struct SlipScale {
    double viscosity_m2_s = 0;
    double speed_m_s = 0;
    double spacing_m = 0;
    double coupled_step_s = 0;
};

struct SlipRates {
    double gain, leak, core_leak;  // parts a step
};

// The gain is 1/4, and falls with the viscosity nu dt / h^2 beyond 0.1, a relaxation time
// of 0.8: with 1/4 a ball of 9 spacings that settles diverges at 1.19, with 1/2 one of 6
// spacings from 1.16 on.
//
// Steady forces leave the slip leak / gain (r f - g), where f falls with the step while
// the velocity that a force F of one marker alone holds up does not:
// F / (rho h (nu + c u h)) from viscosity and from the flow past it. So that the same
// forces are let go at any step, leak over gain is their ratio,
//   leak / gain = 0.008 / (nu dt / h^2 + 2 u dt / h).
// With a constant leak of 0.02 the flow past held balls fell by 1.5 % with every halving
// of the step, towards balls 0.1 h larger than theirs. The factor 2 makes the leak 0.02
// for sheets at the usual speed of 0.05 h a step. The speed alone makes it no less, and
// where it is as large as the gain the memory holds nothing more.
//
// In the core of sheets the leak is four times as large: a strip seven layers thick that
// diverged (2-point kernel) has a fourth of p and runs. In the middle of balls it would
// take 1 % off their drag.
inline SlipRates slip_rates(const SlipScale& scale) {
    constexpr double most_gain = 0.25, fully_gains_until = 0.1;
    constexpr double usual_speed = 0.05;  // h a step
    const double per_step = scale.coupled_step_s / scale.spacing_m;
    const double speed = scale.speed_m_s > 0 ? scale.speed_m_s * per_step : usual_speed;
    const double viscous = scale.viscosity_m2_s * per_step / scale.spacing_m;
    const double ruling = std::max(fully_gains_until, viscous);
    const double gain = most_gain * fully_gains_until / ruling;
    const double of_gain = std::clamp(0.008 / (viscous + 2 * speed), 0.008 / ruling, 1.0);
    return {gain, of_gain * gain, std::min(4 * of_gain, 1.0) * gain};
}

class SlipMemory {
  public:
    SlipMemory(std::span<const Marker> markers, const SlipRates& rates)
        : memory_(markers.size()), gain_(rates.gain) {
        for (const Marker& m : markers)
            leak_.push_back(m.core ? rates.core_leak : rates.leak);
    }

    // After a step: the markers' mean velocities, what passed, and r f - g [m/s].
    void add(std::span<const Vec3> mean_velocity, std::span<const Vec3> passed,
             std::span<const Vec3> uneven) {
        for (std::size_t m = 0; m < memory_.size(); ++m) {
            for (std::size_t d = 0; d < 3; ++d)
                memory_[m][d] += gain_ * (mean_velocity[m][d] - passed[m][d]) -
                                 leak_[m] * uneven[m][d];
        }
    }

    // U - p: what the marker feels for the fluid's velocity.
    std::vector<Vec3> felt(std::span<const Vec3> fluid_velocity) const {
        std::vector<Vec3> all(fluid_velocity.begin(), fluid_velocity.end());
        for (std::size_t m = 0; m < all.size(); ++m) {
            for (std::size_t d = 0; d < 3; ++d) all[m][d] -= memory_[m][d];
        }
        return all;
    }

    std::span<Vec3> values() { return memory_; }  // for checkpoints

  private:
    std::vector<Vec3> memory_;
    double gain_;
    std::vector<double> leak_;
};

}  // namespace magfsi::coupler

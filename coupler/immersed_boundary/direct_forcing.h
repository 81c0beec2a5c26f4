// SPDX-License-Identifier: GPL-2.0-or-later
// The force between markers and the fluid around them, by direct forcing.
//
// Eq. (13): F = -kappa (V - U), with V the marker's present velocity and U the fluid's
// velocity sampled at the start of the coupled step. kappa = strength * 2 rho dV / dt: at
// strength 1 the fluid, given 2 rho / dt of the slip through Guo's forcing, is brought to
// the marker's velocity in one step.
//
// The force is evaluated anew in every substep of the structure. Held over the substeps
// it would sample sheet modes above half the fluid's step rate aliased and pump them.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "coupler/immersed_boundary/grid.h"
#include "coupler/options.h"

namespace magfsi::coupler {

// How a marker follows the fluid's acceleration (EnclosedFluid).
struct EnclosedFollow {
    double part = 0.1;  // of a change that it takes on in a coupled step
    bool without_lag = false;
};

// Lagrangian markers: material points of the body, carried by its elements through their
// shape functions, so that the fluid's grid and the body's mesh can be refined alone. As
// one structure rank sees it: eight nodes by local index, their weights (which add up to
// one), the volume of fluid that it moves, that of the fluid inside the body whose
// inertia is its force (EnclosedFluid), and that of the fluid beyond the body which its
// layer carries along (LayerInertia) [m3]; enclosed_follow: for EnclosedFluid, if its own
// takes on less; core: deep inside a sheet (no_slip.h).
struct Marker {
    std::array<int, 8> node{};
    std::array<double, 8> weight{};
    double volume_m3 = 0;
    double displaced_m3 = 0;
    double beyond_m3 = 0;
    EnclosedFollow enclosed_follow{.part = 0};
    bool core = false;
    int body = 0;
};

// Value of a nodal field (three numbers a node) at a marker.
inline Vec3 at_marker(const Marker& marker, const double* nodal) {
    Vec3 value{};
    for (std::size_t a = 0; a < 8; ++a) {
        const double* v = nodal + 3 * static_cast<std::ptrdiff_t>(marker.node[a]);
        for (std::size_t d = 0; d < 3; ++d) value[d] += marker.weight[a] * v[d];
    }
    return value;
}

// Adds a marker's force to its nodes: the transpose of at_marker.
inline void to_nodes(const Marker& marker, const Vec3& force, double* nodal) {
    for (std::size_t a = 0; a < 8; ++a) {
        double* f = nodal + 3 * static_cast<std::ptrdiff_t>(marker.node[a]);
        for (std::size_t d = 0; d < 3; ++d) f[d] += marker.weight[a] * force[d];
    }
}

struct EnclosedFluidScale {
    double fluid_density_kg_m3 = 0;
    double coupled_step_s = 0;
    Vec3 gravity_m_s2{};
    EnclosedFollow follow{};
};

// Of a body's markers in the serial scheme; density_ratio: of the body and the fluid, as
// far as its nodes may lack mass. Without lag sheets of a tenth of the fluid's density
// gain energy from 0.48 on with the 3-point kernel, from 0.2 with the 2-point one, and a
// ball of 1.1 vibrates sooner (docs/coupling_measurements.md, enclosed fluid).
constexpr EnclosedFollow enclosed_follow_of(double density_ratio, Kernel kernel) {
    if (density_ratio >= 0.5) return {.part = 0.3};
    const double most = kernel == Kernel::two_point ? 0.15 : 0.3;
    return {std::clamp(3 * density_ratio, EnclosedFollow{}.part, most), true};
}

// The fluid that fills the body's own volume on the fluid's grid, as far as the body's
// nodes do not lack its mass already. It is fictitious: its inertia is taken away again,
// with the sampled velocity U for its motion, and its weight is the buoyancy (Uhlmann
// 2005; Kempe, Froehlich 2012):
//   F = rho_f dV (A - g),  A following dU/dt over three to ten coupled steps: its running
// mean M or, with no lag behind what changes slowly, 2 M - N, N the running mean of M.
//
// Light bodies stay stable: body and fluid are tied by the immersed boundary within the
// step, so an error of A accelerates the body's mass, the fluid inside and the added mass
// together, and comes back smaller by rho_f / (rho_s + rho_f (1 + C_added)). But the
// fluid's pressure, which is what C_added stands for, needs some steps to travel through
// the body; followed at once, A diverged below a density ratio of 0.4, at a fifth of the
// rate below 0.05. At a tenth a sheet of 0.01 times the fluid's density runs. But what
// follows a time T late works as if it drove the body: rho_f dV A (dU/dt - A) = rho_f dV
// T (dA/dt)^2 and more. A sheet of a tenth of the fluid's density got 8 % of the field's
// work so, 5 % with three steps. So markers follow as fast as their body's density bears,
// those of light bodies without lag, in the serial scheme (enclosed_follow_of). All this
// is so for U from before the step; in a step that is repeated until U is that of its own
// end, A may follow at once.
class EnclosedFluid {
  public:
    EnclosedFluid(std::span<const Marker> markers, const EnclosedFluidScale& scale);

    // The fluid's velocity at every marker before the first coupled step [m/s], in which
    // it is taken to move steadily; then for each coming step.
    void start(std::span<const Vec3> fluid_velocity);
    void begin_step(std::span<const Vec3> fluid_velocity);

    // On every marker, constant over the coupled step [N].
    std::span<const Vec3> force() const { return force_; }

    // What the next step needs of those before: for checkpoints.
    std::span<Vec3> last_velocity() { return last_velocity_; }
    std::span<Vec3> mean() { return mean_; }
    std::span<Vec3> mean_of_mean() { return mean_of_mean_; }

  private:
    template <bool Weighs>  // in gravity
    void follow(std::span<const Vec3> fluid_velocity);

    EnclosedFluidScale scale_;
    struct Following {
        double weight;  // of dU/dt in its mean
        double twice;   // 1: A = 2 M - N; 0: A = M
    };
    std::vector<double> mass_kg_;
    std::vector<Following> following_;
    std::vector<Vec3> last_velocity_;
    std::vector<Vec3> mean_, mean_of_mean_;  // of dU/dt [m/s2]
    std::vector<Vec3> force_;
};

struct PenaltyScale {
    double strength = 1;
    double fluid_density_kg_m3 = 0;
    double coupled_step_s = 0;
    EnclosedFollow enclosed_follow{};

    // Of fluid, that a marker of this volume brings to its velocity in a coupled step.
    double moved_mass_kg(double volume_m3) const {
        return strength * 2 * fluid_density_kg_m3 * volume_m3;
    }
    double drag_coefficient_kg_s(double volume_m3) const {
        return moved_mass_kg(volume_m3) / coupled_step_s;
    }
};

class PenaltyForce {
  public:
    PenaltyForce(std::vector<Marker> markers, const PenaltyScale& scale,
                 const Vec3& gravity_m_s2);

    const std::vector<Marker>& markers() const { return markers_; }

    // The fluid's velocity at every marker for the coming coupled step [m/s]; clears the
    // impulses. owed: what the fluid was given besides, which the body pays by a constant
    // force over the step [N s]; empty: nothing.
    void begin_step(std::span<const Vec3> fluid_velocity,
                    std::span<const Vec3> owed = {});

    // After begin_step: U is not held over the coupled step but goes linearly from start
    // to end; each substep has that of its middle.
    void let_change(std::span<const Vec3> start, std::span<const Vec3> end);

    // The coefficients over the row sums of the marker system (no_slip.h).
    void divide_by(std::span<const double> row_sum);

    // After begin_step: U is held at another value, but for the enclosed fluid's sake.
    void hold(std::span<const Vec3> fluid_velocity);

    // One substep: adds the forces, with those of the enclosed fluid, to the nodes
    // (nodal_force[3 * node + d], [N]) and the impulse of duration_s to the markers'
    // sums.
    void apply(const double* nodal_velocity, double* nodal_force, double duration_s);

    std::span<const Vec3> fluid_velocity() const { return fluid_velocity_; }

    // What the markers gave to the fluid since begin_step [N s].
    std::span<const Vec3> impulse() const { return impulse_; }

    // On every marker over the coupled step [N]: of the enclosed fluid, less what is
    // paid.
    std::span<const Vec3> constant_force() const {
        return paying_.empty() ? enclosed_.force() : std::span<const Vec3>(paying_);
    }

    EnclosedFluid& enclosed() { return enclosed_; }
    const EnclosedFluid& enclosed() const { return enclosed_; }

  private:
    void follow(double duration_s);

    std::vector<Marker> markers_;
    std::vector<double> own_kappa_, kappa_;  // of its own volume; of the force
    EnclosedFluid enclosed_;
    double coupled_step_s_;
    double elapsed_s_ = 0;  // of the coupled step
    std::vector<Vec3> fluid_velocity_;
    std::vector<Vec3> start_, change_;  // of U over the step; empty where it is held
    std::vector<Vec3> impulse_;
    std::vector<Vec3> paying_;  // filled only where something is owed
};

// Iterated (multi-direct) forcing (Luo et al. 2007; Wang, Fan, Luo 2008): once the
// impulses of a coupled step are spread, the fluid at a marker still slips, for what
// neighbours give overlaps and what a thin body gives is smeared. Each iteration takes
// the slip that is left and gives the fluid the impulse that would remove it, or the part
// that a strength below 1 asks for,
//   min(strength, 1) 2 rho dV (W - U'),
// W the marker's mean velocity over the step, U' the fluid's with half of the step's
// forces so far, F dt / (2 rho): the physical velocity of Guo's scheme.
//
// The structure has moved on by then: it feels what these impulses took over its next
// step, as a constant force. A force that is held is stable only where the drag of eq.
// (13), evaluated in every substep, exceeds it (whole impulses after a weak drag fed the
// sheet: 2 iterations at strength 0.25, 3 at 0.5); with three and four at strength 1
// sheets begin to oscillate, five diverge.
class IteratedForcing {
  public:
    IteratedForcing(std::span<const Marker> markers, const PenaltyScale& scale);

    void begin_step();  // forgets the impulses of the step before

    // One iteration: the impulses [N s] that remove the slip which is left. Positions at
    // the ends of the step [m]; fluid_velocity: U' at `before_m` [m/s].
    std::span<const Vec3> correct(std::span<const Vec3> before_m,
                                  std::span<const Vec3> now_m,
                                  std::span<const Vec3> fluid_velocity);

    // Of all iterations since begin_step, what each marker gave besides the drag [N s].
    std::span<Vec3> impulse() { return impulse_; }
    std::span<const Vec3> impulse() const { return impulse_; }
    // To the impulses of the drag [N s]: then what each marker gave in all.
    void add_to(std::span<Vec3> of_drag) const;

  private:
    double coupled_step_s_;
    std::vector<double> moved_mass_kg_;  // min(strength, 1) 2 rho dV
    std::vector<Vec3> last_, impulse_;
};

}  // namespace magfsi::coupler

// SPDX-License-Identifier: GPL-2.0-or-later
// The force between markers and the fluid around them, by direct forcing.
//
// Eq. (13): F = -kappa (V - U), with V the marker's present velocity and U the fluid's
// velocity sampled at the start of the coupled step. kappa = strength * 2 rho dV / dt: at
// strength 1 the fluid, given 2 rho / dt of the slip through Guo's forcing, is brought to
// the marker's velocity in one step.
//
// The force is evaluated anew in every substep of the structure. A force held over the
// substeps would sample sheet modes above half the fluid's step rate aliased, and pump
// them.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "base/fitted/constants.h"
#include "base/isa/instruction_set.h"
#include "coupler/immersed_boundary/grid.h"
#include "coupler/immersed_boundary/marker_kernel.h"
#include "coupler/options.h"

namespace magfsi::coupler {

// The way in which the enclosed fluid's acceleration A follows dU/dt (EnclosedFluid).
struct EnclosedFollow {
    double part = fitted::enclosed_part;  // share of a change taken on per coupled step
    bool without_lag = false;             // A = 2 M - N instead of M
};

// A Lagrangian marker: a material point of the body that its element carries through the
// shape functions, so that the fluid's grid and the body's mesh can be refined
// independently. Nodes are those of one structure rank.
struct Marker {
    std::array<int, 8> node{};       // local indices of the element's nodes
    std::array<double, 8> weight{};  // shape functions there; they add up to 1
    double volume_m3 = 0;            // fluid that the marker moves [m3]
    // Fluid inside the body [m3] whose inertia is taken away by a force (EnclosedFluid).
    double displaced_m3 = 0;
    // Fluid outside the body [m3] that the marker's layer carries along (LayerInertia).
    double beyond_m3 = 0;
    // Used instead of EnclosedFluidScale::follow if its part is at least as large.
    EnclosedFollow enclosed_follow{.part = 0};
    bool core = false;  // true deep inside a thick sheet (no_slip.h)
    int body = 0;       // number of the body in the scene
};

// Value at a marker of a nodal field with three numbers per node.
inline Vec3 at_marker(const Marker& marker, const double* nodal) {
    Vec3 value{};
    for (std::size_t a = 0; a < 8; ++a) {
        const double* v = nodal + 3 * static_cast<std::ptrdiff_t>(marker.node[a]);
        value += marker.weight[a] * vector_at(v);
    }
    return value;
}

// Adds a marker's force [N] to the forces of its nodes: the transpose of at_marker.
inline void to_nodes(const Marker& marker, const Vec3& force, double* nodal) {
    for (std::size_t a = 0; a < 8; ++a) {
        double* f = nodal + 3 * static_cast<std::ptrdiff_t>(marker.node[a]);
        add_to(f, marker.weight[a] * force);
    }
}

// The markers as the loop of every substep takes them (marker_kernel.h).
class PackedMarkers {
  public:
    PackedMarkers(std::span<const Marker> markers, InstructionSet set);
    PackedMarkers(const PackedMarkers&) = delete;  // runs_ points to rows_
    PackedMarkers& operator=(const PackedMarkers&) = delete;

    void substep(const MarkerValues& values, const double* nodal_velocity,
                 double* nodal_force, double duration_s);

  private:
    MarkerKernel kernel_;
    std::vector<int> nodes_;
    std::vector<NodeRow> rows_;
    std::vector<double> weights_;
    std::vector<MarkerRun> runs_;
    std::vector<RunBlock> blocks_;
};

// Quantities that EnclosedFluid needs; `follow` is the default for all markers.
struct EnclosedFluidScale {
    double fluid_density_kg_m3 = 0;
    double coupled_step_s = 0;
    Vec3 gravity_m_s2{};
    EnclosedFollow follow{};
};

// The way in which a body's markers follow in the serial scheme. density_ratio: density
// of the body over that of the fluid, 0 if its nodes keep their whole mass. The limits
// are measured (docs/lab/coupling_measurements.md, enclosed fluid).
constexpr EnclosedFollow enclosed_follow_of(double density_ratio, Kernel kernel) {
    using namespace fitted;
    if (density_ratio >= dense_from_ratio) return {.part = enclosed_part_of_dense};
    const double most =
        kernel == Kernel::two_point ? enclosed_most_two_point : enclosed_most;
    return {std::clamp(enclosed_part_per_ratio * density_ratio, enclosed_part, most),
            true};
}

// The fluid that fills the body's own volume on the fluid's grid, as far as its mass was
// not taken off the nodes. It is fictitious: its inertia is taken away again, with the
// sampled velocity U for its motion, and its weight is the buoyancy (Uhlmann 2005; Kempe,
// Froehlich 2012):
//   F = rho_f dV (A - g).
// A follows dU/dt over three to ten coupled steps: it is the running mean M of dU/dt or,
// to follow slow changes without lag, 2 M - N with N the running mean of M.
//
// Stability. The immersed boundary ties body and fluid within the step, so an error of A
// accelerates the body's mass, the fluid inside and the added mass together and comes
// back smaller by rho_f / (rho_s + rho_f (1 + C_added)). But the fluid's pressure, which
// C_added stands for, needs some steps to travel through the body: light bodies run only
// if A follows slowly (fitted::enclosed_part).
//
// Energy. An A that lags by a time T works as if it drove the body: rho_f dV A
// (dU/dt - A) = rho_f dV T (dA/dt)^2 and more. A sheet of a tenth of the fluid's density
// got 8 % of the field's work in this way, 5 % with three steps. In the serial scheme
// markers therefore follow as fast as the body's density allows, those of light bodies
// without lag (enclosed_follow_of). All this holds for U from before the step; in a step
// that is repeated until U is that of its own end A may follow at once.
class EnclosedFluid {
  public:
    // markers: those of this rank; displaced_m3 and enclosed_follow are used.
    EnclosedFluid(std::span<const Marker> markers, const EnclosedFluidScale& scale);

    // start() takes the fluid's velocities at all markers before the first coupled step
    // [m/s]; the acceleration is 0 then. begin_step() takes them at the start of each
    // step and computes the forces for it.
    void start(std::span<const Vec3> fluid_velocity);
    void begin_step(std::span<const Vec3> fluid_velocity);

    // Force on every marker, constant over the coupled step [N].
    std::span<const Vec3> force() const { return force_; }

    // State for checkpoints: the last sample U [m/s], and the running means M and N of
    // dU/dt [m/s2].
    std::span<Vec3> last_velocity() { return last_velocity_; }
    std::span<Vec3> mean() { return mean_; }
    std::span<Vec3> mean_of_mean() { return mean_of_mean_; }

  private:
    // Weighs: gravity is present.
    template <bool Weighs>
    void follow(std::span<const Vec3> fluid_velocity);

    EnclosedFluidScale scale_;
    // Weights of one marker.
    struct Following {
        double weight;  // weight of dU/dt in M
        double twice;   // 1: A = 2 M - N; 0: A = M
    };
    std::vector<double> mass_kg_;
    std::vector<Following> following_;
    std::vector<Vec3> last_velocity_;
    std::vector<Vec3> mean_, mean_of_mean_;  // M and N [m/s2]
    std::vector<Vec3> force_;
};

// Quantities that the coefficient kappa of eq. (13) is made from. strength:
// dimensionless; 1 is direct forcing.
struct PenaltyScale {
    double strength = 1;
    double fluid_density_kg_m3 = 0;
    double coupled_step_s = 0;
    EnclosedFollow enclosed_follow{};

    // The coefficient kappa of eq. (13) [kg/s] for a marker of this volume. Guo's forcing
    // acts with half the force at once, hence the factor 2.
    double drag_coefficient_kg_s(double volume_m3) const {
        return strength * 2 * fluid_density_kg_m3 * volume_m3 / coupled_step_s;
    }
};

// The force of eq. (13) on this rank's markers, with that of the enclosed fluid, and the
// impulses that the fluid gets in return.
class PenaltyForce {
  public:
    // gravity_m_s2: zero if the scene has none.
    PenaltyForce(std::vector<Marker> markers, const PenaltyScale& scale,
                 const Vec3& gravity_m_s2, InstructionSet set = choose_instruction_set());
    virtual ~PenaltyForce() = default;

    const std::vector<Marker>& markers() const { return markers_; }

    // Starts a coupled step with the fluid's velocity at every marker [m/s] and clears
    // the impulses.
    virtual void begin_step(std::span<const Vec3> fluid_velocity);

    // Lets U change linearly over the coupled step from start to end; each substep takes
    // the value at its middle. To be called after begin_step.
    virtual void let_change(std::span<const Vec3> start, std::span<const Vec3> end);

    // Holds U at another value than begin_step was given, which then counts for the
    // enclosed fluid only. To be called after begin_step.
    virtual void hold(std::span<const Vec3> fluid_velocity);

    // One substep of duration_s [s]: adds the forces, those of the enclosed fluid
    // included, to the nodes (nodal_force[3 * node + d], [N]) and the impulses to the
    // markers' sums. nodal_velocity: present velocities [m/s], in the same order.
    void apply(const double* nodal_velocity, double* nodal_force, double duration_s);

    // U as the last substep used it [m/s].
    std::span<const Vec3> fluid_velocity() const {
        return std::span(fluid_velocity_).first(markers_.size());
    }

    // Impulses that the markers gave to the fluid since begin_step [N s].
    std::span<const Vec3> impulse() const { return impulse_; }

    EnclosedFluid& enclosed() { return enclosed_; }
    const EnclosedFluid& enclosed() const { return enclosed_; }

  protected:
    std::vector<double> kappa_;  // coefficient of each marker [kg/s]

  private:
    // Sets U to its value at the middle of the coming substep.
    void follow(double duration_s);

    std::vector<Marker> markers_;
    PackedMarkers packed_;
    EnclosedFluid enclosed_;
    double coupled_step_s_;
    double elapsed_s_ = 0;  // time since the start of the step
    // U, and the enclosed fluid's forces in this step; one more of each for the kernel.
    std::vector<Vec3> fluid_velocity_, enclosed_force_;
    std::vector<Vec3> start_, change_;  // U at the start, and its change; else empty
    std::vector<Vec3> impulse_;
};

}  // namespace magfsi::coupler

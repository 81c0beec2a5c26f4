// SPDX-License-Identifier: GPL-2.0-or-later
// The structure's half of a coupled step, whatever solves it: markers, the force within
// its substeps, exchange, audits. The order of its tasks is in schemes.cpp.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "coupler/exchange/exchange.h"
#include "coupler/immersed_boundary/balance.h"
#include "coupler/immersed_boundary/direct_forcing.h"
#include "coupler/immersed_boundary/layer_inertia.h"
#include "coupler/immersed_boundary/slip.h"
#include "coupler/participants/session.h"
#include "coupler/scheme/fixed_point.h"
#include "coupler/scheme/structure_solver.h"
#include "coupler/step/task_list.h"

namespace magfsi::coupler {

// Names of tasks of the structure, in every scheme.
inline constexpr const char* advance_structure = "advance structure";
inline constexpr const char* check_finite = "check finite";

// The markers of this rank and what is measured at them, made where the meshes are known.
struct BodyMarkers {
    std::vector<Marker> markers;
    std::vector<int> placed_index;  // of each marker its number among those of all ranks,
    std::size_t placed = 0;         // so many, in the order of their placement
    std::vector<MarkerArea> areas;
    std::size_t bodies = 0;
    std::vector<std::vector<std::size_t>> parts;  // of bodies: the markers in each
    Vec3 gravity_m_s2{};
    // Where probes ask for forces: of each marker the mass of the fluid inside the body
    // that came off the nodes.
    bool measures_force = false;
    std::vector<double> off_nodes_kg;
    bool carries_layers = false;  // markers of any rank have a volume beyond their body
    bool measures_work = false;   // for the energy audit
    SlipRates slip_rates{};       // without slip (no_slip.h)
    std::int64_t steps_between_slip_samples = 1;
};

class StructureCoupling {
  public:
    // Attaches the fluid's force to the solver, which outlives this.
    StructureCoupling(Session& session, StructureSolver& solver, Grid grid,
                      BodyMarkers markers);

    // The coupled step up to its count.
    void add_tasks(TaskList& tasks);

    // Velocities for the first step; after a checkpoint's arrays are in their places.
    void begin();

    // Of the structure so far, repeated ones, too.
    std::int64_t advances() const { return advances_; }

    // What this rank's markers carry from step to step, kept in checkpoints under its
    // name; each has three numbers per marker.
    struct MarkerArray {
        std::string name;
        std::span<double> values;
    };
    std::vector<MarkerArray> carried();
    // After they are back: the last coupled step was this part of what it was (a retry),
    // and the fluid's velocity then that much closer to the present one.
    void shorten_last_step(double part);
    // Numbers that are the same on all ranks; with them, after a restart, a fresh object
    // makes room for what is carried. Empty but in the implicit scheme.
    std::vector<double> carried_numbers() const;
    void make_room(std::span<const double> numbers);
    std::span<const int> placed_index() const { return markers_.placed_index; }
    std::size_t placed() const { return markers_.placed; }
    const Grid& grid() const { return grid_; }

    // What the markers of this rank sent to the fluid last and what it answered.
    struct Exchanged {
        std::span<const Vec3> position_m, impulse, velocity;
        std::span<const double> volume_m3;  // in forcing no_slip, as the next
        const NoSlipAnswer* no_slip = nullptr;
    };
    Exchanged exchanged() const;

    // Sum over the ranks of the force on each body in the last step [N], and on each of
    // the parts. Collective.
    std::vector<Vec3> force_on_bodies();
    std::vector<Vec3> force_on_parts();
    // Likewise of the torque on each body about the origin of space [N m].
    std::vector<Vec3> torque_on_bodies();

    // Null unless the run measures them.
    BalanceRecord* balance() const { return balance_.get(); }
    const MarkerWork* work() const { return work_.get(); }
    // Null but in the implicit scheme.
    const output::IterationSummary* iterations() const;
    SlipReport slip() const;  // collective

  private:
    void add_serial(TaskList& tasks);
    void add_parallel(TaskList& tasks);
    void add_implicit(TaskList& tasks);
    void add_advance(TaskList& tasks);

    // At the start of a step: the fluid's velocity over it is the one sampled last, held;
    // or goes in a straight line through the last two; or is their mean, in which a
    // response of the fluid that alternates from step to step cancels.
    void hold_velocity();
    void extrapolate_velocity();
    void take_mean_velocity();
    bool extrapolates() const;

    void send_impulses();  // given in the step, where and where the markers are now
    void iterate_forcing();
    void audit();
    void receive_velocities();
    void measure_slip();

    // Of the implicit scheme.
    void keep_state();
    void guess_velocity();
    void check_convergence();
    void accept_answer();

    std::span<const double> volumes_m3() const;  // none but in forcing no_slip
    void receive(const Occasion& when, std::span<Vec3> velocity);
    // The velocity of the fluid that markers feel.
    void hold(std::span<const Vec3> fluid_velocity);
    void let_change(std::span<const Vec3> start, std::span<const Vec3> end);
    void take_answer(std::span<const Vec3> felt);  // U of the step
    std::vector<Vec3> mean_velocity() const;
    // To the fluid in the step [N s].
    std::span<const Vec3> given() const {
        return layer_ ? layer_->given() : force_.impulse();
    }

    void begin_force(std::span<const Vec3> fluid_velocity,
                     std::span<const Vec3> owed = {});
    std::vector<Vec3> marker_positions() const;
    Vec3 force_on(std::size_t marker) const;
    int iteration() const { return fixed_point_ ? fixed_point_->iteration() : 0; }

    // Of forcing no_slip, from step to step.
    struct NoSlip {
        NoSlip(std::span<const Marker> markers, const SlipRates& rates);
        std::vector<double> volume_m3;
        NoSlipAnswer answer;
        SlipMemory memory;
    };

    Session& session_;
    StructureSolver& solver_;
    Grid grid_;
    const Coupling& options_;
    BodyMarkers markers_;  // those of the force are its own
    PenaltyForce force_;
    std::unique_ptr<IteratedForcing> iterated_;
    std::unique_ptr<NoSlip> no_slip_;      // null in other forcings
    std::unique_ptr<LayerInertia> layer_;  // null unless a sheet has one layer of markers
    StructureExchange exchange_;
    SlipRecord slip_;
    std::unique_ptr<BalanceRecord> balance_;
    std::unique_ptr<MarkerWork> work_;
    std::int64_t advances_ = 0;

    std::vector<Vec3> before_m_, now_m_, fluid_velocity_;
    // A step before fluid_velocity_; empty where the scheme uses one sample only.
    std::vector<Vec3> last_velocity_;
    std::vector<Vec3> under_way_;       // parallel: impulses, filled for checkpoints
    std::vector<Vec3> start_velocity_;  // of the markers, where forces are measured

    // Of the implicit scheme; kept: at the start of the step.
    std::unique_ptr<FixedPoint> fixed_point_;
    struct Kept {
        std::optional<EnclosedFluid> enclosed;
        std::optional<LayerInertia> layer;
        std::optional<MarkerWork> work;
        std::vector<Vec3> markers_m;
    } kept_;
    std::vector<Vec3> answer_;
    bool again_ = false;  // the step is repeated
};

}  // namespace magfsi::coupler

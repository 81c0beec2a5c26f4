// SPDX-License-Identifier: GPL-2.0-or-later
// The structure's half of a coupled step, whatever solver it has: markers, the force
// within its substeps, exchange and audits. schemes.cpp has the order of the tasks.
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

// Names of the structure's tasks that every scheme has.
inline constexpr const char* advance_structure = "advance structure";
inline constexpr const char* check_finite = "check finite";

// The markers of this rank and the quantities that are measured at them, made where the
// bodies' meshes are known.
struct BodyMarkers {
    std::vector<Marker> markers;
    // Number of each marker in the order of placement, counted over all ranks, and the
    // number of all of them.
    std::vector<int> placed_index;
    std::size_t placed = 0;
    std::vector<MarkerArea> areas;  // surface pieces of this rank's markers
    std::size_t bodies = 0;         // number of bodies in the scene
    // For each part of a body that a probe asks for, the indices of this rank's markers
    // in it.
    std::vector<std::vector<std::size_t>> parts;
    Vec3 gravity_m_s2{};
    // Measurement of forces, if probes ask for them: for each marker the mass [kg] of the
    // fluid inside the body that was taken off the nodes. Empty if not measured.
    bool measures_force = false;
    std::vector<double> off_nodes_kg;
    // True if a marker on any rank stands for a layer of fluid outside its body.
    bool carries_layers = false;
    bool measures_work = false;  // work is measured for the energy audit
    SlipRates slip_rates{};      // for forcing no_slip (no_slip.h)
    std::int64_t steps_between_slip_samples = 1;
};

// The markers of a structure rank and their part in the coupled step. All calls are made
// by every rank of the structure.
class StructureCoupling {
  public:
    // Attaches the fluid's force to the solver. session and solver must outlive this
    // object. grid: that of the fluid, from its description.
    StructureCoupling(Session& session, StructureSolver& solver, const Grid& grid,
                      BodyMarkers markers);

    // Adds the tasks of a coupled step up to its count.
    void add_tasks(TaskList& tasks);

    // Exchanges the velocities for the first step. After a restart the arrays of the
    // checkpoint must be in their places.
    void begin();

    // Number of times that the structure has advanced, in repeated steps included.
    std::int64_t advances() const { return advances_; }

    // An array that this rank's markers carry from step to step, under its name in
    // checkpoints, with three numbers per marker.
    struct MarkerArray {
        std::string name;
        std::span<double> values;
    };
    std::vector<MarkerArray> carried();
    // Adapts the carried arrays after a restart with a smaller step (a retry): `part` is
    // the new step over the old one, and velocities of one step ago are moved towards the
    // present ones accordingly.
    void shorten_last_step(double part);
    // State that is the same on all ranks. After a restart make_room() gets it on a fresh
    // object and sizes the carried arrays. Empty except in the implicit scheme.
    std::vector<double> carried_numbers() const;
    void make_room(std::span<const double> numbers);
    // BodyMarkers::placed_index and placed, for gathering the arrays by placement.
    std::span<const int> placed_index() const { return markers_.placed_index; }
    std::size_t placed() const { return markers_.placed; }

    // Force of the fluid on each body, and on each part, in the last step [N], the same
    // on all ranks. Collective. Requires BodyMarkers::measures_force.
    std::vector<Vec3> force_on_bodies();
    std::vector<Vec3> force_on_parts();
    // Torque of the same forces on each body about the origin of space [N m]. Collective.
    std::vector<Vec3> torque_on_bodies();

    // Records of the audits; null unless the run makes them.
    BalanceRecord* balance() const { return balance_.get(); }
    const MarkerWork* work() const { return work_.get(); }
    // Statistics of the iterations; null except in the implicit scheme.
    const output::IterationSummary* iterations() const;
    SlipReport slip() const;  // over all ranks; collective

  private:
    void add_serial(TaskList& tasks);
    void add_implicit(TaskList& tasks);
    void add_advance(TaskList& tasks);

    // Starts the force of a step with the line through the last two samples of the
    // fluid's velocity.
    void extrapolate_velocity();
    bool extrapolates() const;

    // Sends the impulses of the step with the markers' positions at its start and its
    // end.
    void send_impulses();
    void audit();
    void receive_velocities();
    void measure_slip();

    // Tasks of the implicit scheme.
    void keep_state();
    void guess_velocity();
    void check_convergence();
    void accept_answer();

    std::span<const double> volumes_m3() const;  // filled in forcing no_slip only
    void receive(const Occasion& when, std::span<Vec3> velocity);
    // Set the fluid's velocity U that markers feel; with forcing no_slip it is U - p.
    void hold(std::span<const Vec3> fluid_velocity);
    void let_change(std::span<const Vec3> start, std::span<const Vec3> end);
    // Updates the no_slip memory after a step. felt: the fluid's velocity U in the step.
    void take_answer(std::span<const Vec3> felt);
    // Mean velocity of the markers in the last step [m/s].
    std::vector<Vec3> mean_velocity() const;
    // Impulses that the fluid is given in the step [N s].
    std::span<const Vec3> given() const {
        return layer_ ? layer_->given() : force_.impulse();
    }

    // Starts the force of a step, with the fluid's velocity held.
    void begin_force(std::span<const Vec3> fluid_velocity);
    std::vector<Vec3> marker_positions() const;
    Vec3 force_on(std::size_t marker) const;
    int iteration() const { return fixed_point_ ? fixed_point_->iteration() : 0; }

    // State of forcing no_slip from step to step.
    struct NoSlip {
        NoSlip(std::span<const Marker> markers, const SlipRates& rates);
        std::vector<double> volume_m3;
        NoSlipAnswer answer;
        SlipMemory memory;
    };

    Session& session_;
    StructureSolver& solver_;
    const Coupling& options_;
    // `markers` and `areas` have been moved into force_ and slip_.
    BodyMarkers markers_;
    PenaltyForce force_;
    std::unique_ptr<NoSlip> no_slip_;  // set in forcing no_slip only
    // Set if a sheet on any rank has one layer of markers.
    std::unique_ptr<LayerInertia> layer_;
    StructureExchange exchange_;
    SlipRecord slip_;
    std::unique_ptr<BalanceRecord> balance_;
    std::unique_ptr<MarkerWork> work_;
    std::int64_t advances_ = 0;

    // Positions of the markers at the start and the end of the last step [m], and the
    // fluid's velocity at the latter [m/s].
    std::vector<Vec3> before_m_, now_m_, fluid_velocity_;
    // fluid_velocity_ one step before; empty if the scheme uses one sample only.
    std::vector<Vec3> last_velocity_;
    // Velocities of the markers at the start of the step, if forces are measured.
    std::vector<Vec3> start_velocity_;

    // State of the implicit scheme; kept_ is that at the start of the step.
    std::unique_ptr<FixedPoint> fixed_point_;
    struct Kept {
        std::optional<EnclosedFluid> enclosed;
        std::optional<LayerInertia> layer;
        std::optional<MarkerWork> work;
        std::vector<Vec3> markers_m;
    } kept_;
    std::vector<Vec3> answer_;  // the fluid's answer to the last guess
    bool again_ = false;        // the step is repeated
};

}  // namespace magfsi::coupler

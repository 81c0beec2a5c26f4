// SPDX-License-Identifier: GPL-2.0-or-later
// The structure's half of a coupled step, whatever solver it has: markers, exchange and
// audits around a forcing (forcing.h). schemes.cpp has the order of the tasks.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "coupler/exchange/exchange.h"
#include "coupler/immersed_boundary/balance.h"
#include "coupler/output/summary.h"
#include "coupler/participants/session.h"
#include "coupler/scheme/forcing.h"
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

// The markers of a structure rank and their part in the coupled step; each scheme is a
// class of its own (schemes.cpp). All calls are made by every rank of the structure.
class StructureCoupling {
  public:
    // Attaches the fluid's force to the solver. session and solver must outlive this
    // object. grid: that of the fluid, from its description.
    StructureCoupling(Session& session, StructureSolver& solver, const Grid& grid,
                      BodyMarkers markers);
    virtual ~StructureCoupling() = default;
    StructureCoupling(const StructureCoupling&) = delete;
    StructureCoupling& operator=(const StructureCoupling&) = delete;

    // Adds the tasks of a coupled step up to its count.
    virtual void add_tasks(TaskList& tasks) = 0;

    // Exchanges the velocities for the first step. After a restart the arrays of the
    // checkpoint must be in their places.
    void begin();

    // Number of times that the structure has advanced, in repeated steps included.
    std::int64_t advances() const { return advances_; }

    // The arrays of a checkpoint. The overrides add those of the scheme.
    virtual std::vector<MarkerArray> carried();
    // Adapts the carried arrays after a restart with a smaller step (a retry): `part` is
    // the new step over the old one, and velocities of one step ago are moved towards the
    // present ones accordingly.
    void shorten_last_step(double part);
    // State that is the same on all ranks. After a restart make_room() gets it on a fresh
    // object and sizes the carried arrays. Empty except in the implicit scheme.
    virtual std::vector<double> carried_numbers() const { return {}; }
    virtual void make_room(std::span<const double> /*numbers*/) {}
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
    virtual const output::IterationSummary* iterations() const { return nullptr; }
    SlipReport slip() const;  // over all ranks; collective

  protected:
    // Exchange that the next messages belong to.
    virtual Occasion occasion() const { return session_.clock().step(); }

    bool extrapolates() const {
        return options_.sampled_velocity == SampledVelocity::linear;
    }

    // The tasks from the structure's advance to its message, the audit of the interface,
    // and the end of the step from the forcing's view of the fluid's answer to the count.
    void add_advance(TaskList& tasks);
    void add_audit(TaskList& tasks);
    void add_end(TaskList& tasks);

    void receive(std::vector<Vec3>& velocity) {
        exchange_.receive(occasion(), velocity, force_->answer());
    }

    Session& session_;
    StructureSolver& solver_;
    const Coupling& options_;
    MarkerStep step_;
    std::unique_ptr<PenaltyForcing> force_;  // of either forcing

  private:
    void make_force();
    void attach_force();
    void note_velocities();
    std::vector<Vec3> marker_positions() const;
    Vec3 force_on(std::size_t marker) const;

    // `markers` and `areas` have been moved into force_ and slip_.
    BodyMarkers markers_;
    SlipRecord slip_;
    StructureExchange exchange_;
    std::unique_ptr<BalanceRecord> balance_;
    std::unique_ptr<MarkerWork> work_;
    std::int64_t advances_ = 0;
    // Velocities of the markers at the start of the step, if forces are measured.
    std::vector<Vec3> start_velocity_;
};

// The structure's half in the scheme of the session's plan.
std::unique_ptr<StructureCoupling> make_structure_coupling(Session& session,
                                                           StructureSolver& solver,
                                                           const Grid& grid,
                                                           BodyMarkers markers);

}  // namespace magfsi::coupler

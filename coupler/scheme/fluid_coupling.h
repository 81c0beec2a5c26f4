// SPDX-License-Identifier: GPL-2.0-or-later
// The fluid's half of a coupled step, whatever solver it has: exchange, spreading,
// sampling and audit. schemes.cpp has the order of the tasks. A fluid participant with a
// partner makes one and adds its own checks and outputs after these tasks.
#pragma once

#include <memory>
#include <optional>

#include "coupler/exchange/exchange.h"
#include "coupler/immersed_boundary/fluid_side.h"
#include "coupler/participants/session.h"
#include "coupler/step/task_list.h"

namespace magfsi::coupler {

// Name of the task in which the fluid advances, in every scheme.
inline constexpr const char* advance_fluid = "advance fluid";

// All calls are collective over the fluid's ranks.
class FluidCoupling {
  public:
    // Sends the description of the fluid's grid to the structure. session and fluid must
    // outlive this object.
    FluidCoupling(Session& session, GridFluid& fluid);

    // Adds the tasks of a coupled step up to its count: after them the clock and the
    // fluid stand at t(n+1).
    void add_tasks(TaskList& tasks);

    // Answers the structure's first exchange with the velocities at the first positions;
    // called before the first step.
    void begin();

    // Number of times that the fluid has advanced, in repeated steps included.
    std::int64_t advances() const { return advances_; }

    // Sums of the audit, null unless the run audits the interface.
    BalanceRecord* balance() const { return balance_.get(); }

  private:
    void add_serial(TaskList& tasks);
    void add_implicit(TaskList& tasks);

    void receive_markers();
    // Takes over the boxes of a grid that may have moved.
    void take_place();
    void spread_impulses();
    // Enters what this rank's cells received in the step.
    void audit(const InterfaceBalance& received) { balance_->add(received); }
    void advance();
    void sample_velocities();
    void send_velocities();

    // Tasks of the implicit scheme.
    void begin_iterations();
    void check_convergence();

    Session& session_;
    GridFluid& fluid_;
    const Coupling& options_;
    FluidExchange exchange_;
    FluidSide boundary_;
    std::unique_ptr<BalanceRecord> balance_;
    Occasion when_ = -1;                  // exchange that batch_ belongs to
    const MarkerBatch* batch_ = nullptr;  // markers received last
    std::span<const Vec3> sampled_;       // velocities at batch_->now_m
    std::optional<NoSlipAnswer> answer_;  // set for forcing no_slip only
    std::int64_t advances_ = 0;

    // State of the implicit scheme.
    int iteration_ = 0;
    bool again_ = false;  // the step is repeated
    // Velocities of the cells at t(n) [m/s], for the audit only.
    std::vector<double> felt_;
};

}  // namespace magfsi::coupler

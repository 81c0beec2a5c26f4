// SPDX-License-Identifier: GPL-2.0-or-later
// The fluid's half of a coupled step, whatever solves it: exchange, spreading and
// sampling, audit. The order of its tasks is in schemes.cpp. A fluid participant makes
// one when it has a partner, and adds its own checks and outputs behind these tasks.
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

class FluidCoupling {
  public:
    // Sends the description of the fluid's grid to the structure; both outlive this.
    FluidCoupling(Session& session, GridFluid& fluid);

    // The coupled step up to its count: after these tasks the clock stands at t(n+1), and
    // so does the fluid.
    void add_tasks(TaskList& tasks);

    // Before the first step: the velocities at the first positions.
    void begin();

    // Of the fluid so far, repeated ones, too.
    std::int64_t advances() const { return advances_; }

    // Null unless the run audits the interface.
    BalanceRecord* balance() const { return balance_.get(); }

  private:
    void add_serial(TaskList& tasks);
    void add_parallel(TaskList& tasks);
    void add_implicit(TaskList& tasks);

    void receive_markers();
    void take_place();  // of a grid that may have moved
    void spread_impulses();
    void iterate_forcing();
    void audit(const InterfaceBalance& received) { balance_->add(received); }
    void advance();
    void sample_velocities();
    void sample_forced_velocities();
    void send_velocities();

    // Of the implicit scheme.
    void begin_iterations();
    void check_convergence();

    Session& session_;
    GridFluid& fluid_;
    const Coupling& options_;
    FluidExchange exchange_;
    FluidSide boundary_;
    std::unique_ptr<BalanceRecord> balance_;
    Occasion when_ = -1;  // of batch_
    const MarkerBatch* batch_ = nullptr;
    std::span<const Vec3> sampled_;       // velocities at batch_->now_m
    std::optional<NoSlipAnswer> answer_;  // of forcing no_slip
    std::int64_t advances_ = 0;

    // Of the implicit scheme.
    int iteration_ = 0;
    bool again_ = false;        // the step is repeated
    std::vector<double> felt_;  // the cells' velocities at t(n); only for the audit
};

}  // namespace magfsi::coupler

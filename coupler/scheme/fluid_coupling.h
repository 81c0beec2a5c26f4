// SPDX-License-Identifier: GPL-2.0-or-later
// The fluid's half of a coupled step, whatever solver it has: exchange, spreading,
// sampling and audit. schemes.cpp has the order of the tasks. A fluid participant with a
// partner makes one and adds its own checks and outputs after these tasks.
#pragma once

#include <memory>

#include "coupler/exchange/exchange.h"
#include "coupler/immersed_boundary/fluid_side.h"
#include "coupler/participants/session.h"
#include "coupler/step/task_list.h"

namespace magfsi::coupler {

// Name of the task in which the fluid advances, in every scheme.
inline constexpr const char* advance_fluid = "advance fluid";

// Each scheme is a class of its own (schemes.cpp). All calls are collective over the
// fluid's ranks.
class FluidCoupling {
  public:
    // Sends the description of the fluid's grid to the structure. session and fluid must
    // outlive this object.
    FluidCoupling(Session& session, GridFluid& fluid);
    virtual ~FluidCoupling() = default;
    FluidCoupling(const FluidCoupling&) = delete;
    FluidCoupling& operator=(const FluidCoupling&) = delete;

    // Adds the tasks of a coupled step up to its count: after them the clock and the
    // fluid stand at t(n+1).
    virtual void add_tasks(TaskList& tasks) = 0;

    // Answers the structure's first exchange with the velocities at the first positions;
    // called before the first step.
    void begin();

    // Number of times that the fluid has advanced, in repeated steps included.
    std::int64_t advances() const { return advances_; }

    // Sums of the audit, null unless the run audits the interface.
    BalanceRecord* balance() const { return balance_.get(); }

  protected:
    void receive(const Occasion& when, bool stays = false);
    // Takes over the boxes of a grid that may have moved; true if they are others.
    bool take_place();
    void advance();
    void sample_velocities();
    void send_velocities();

    Session& session_;
    GridFluid& fluid_;
    std::unique_ptr<FluidSide> boundary_;  // of either forcing
    const MarkerBatch* batch_ = nullptr;   // markers received last

  private:
    FluidExchange exchange_;
    std::unique_ptr<BalanceRecord> balance_;
    Occasion when_ = -1;             // exchange that batch_ belongs to
    std::span<const Vec3> sampled_;  // velocities at batch_->now_m
    std::int64_t advances_ = 0;
};

// The fluid's half in the scheme of the session's plan.
std::unique_ptr<FluidCoupling> make_fluid_coupling(Session& session, GridFluid& fluid);

}  // namespace magfsi::coupler

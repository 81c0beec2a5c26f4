// The fluid's half of a coupled step, whatever the fluid: exchange, immersed boundary,
// audit, and the order of its tasks in the scene's scheme. A fluid participant makes one
// when it has a partner, and adds its own checks and outputs behind these tasks.
#pragma once

#include <functional>
#include <memory>

#include "coupler/exchange/exchange.h"
#include "coupler/immersed_boundary/spreading.h"
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

    // Null unless the scene asks for it.
    BalanceRecord* balance() const { return balance_.get(); }

  private:
    void add_turn(TaskList& tasks);
    void add_meeting(TaskList& tasks);
    void add_repeated_turn(TaskList& tasks);
    void add_advance(TaskList& tasks);
    void add_count(TaskList& tasks);
    void add_reception(TaskList& tasks);
    void add_sampling(TaskList& tasks);
    void add_iterations(TaskList& tasks);
    void add_audit(TaskList& tasks, std::function<InterfaceBalance()> received);
    void iterate_forcing();
    std::span<const Vec3> sample_forced(std::span<const Vec3> points_m);
    void keep_state();
    void check_convergence();

    Session& session_;
    GridFluid& fluid_;
    FluidExchange exchange_;
    FluidSide immersed_boundary_;
    std::unique_ptr<BalanceRecord> balance_;
    const MarkerBatch* batch_ = nullptr;
    std::span<const Vec3> sampled_;  // velocities at batch_->now_m
    std::int64_t advances_ = 0;
    // Of the implicit scheme:
    int iteration_ = 0;
    bool again_ = false;
    std::vector<double> felt_;  // the cells' velocities at t(n); only for the audit
};

}  // namespace magfsi::coupler

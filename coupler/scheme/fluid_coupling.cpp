// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/scheme/fluid_coupling.h"

#include "coupler/participants/handshake.h"
#include "coupler/participants/waiting.h"
#include "coupler/scheme/fixed_point.h"

namespace magfsi::coupler {

FluidCoupling::FluidCoupling(Session& session, GridFluid& fluid)
    : session_(session),
      fluid_(fluid),
      options_(*session.plan().coupling),
      exchange_(session.world(), session.timeout_s(),
                options_.immersed_boundary.forcing.value(),
                fluid.grid().follows ? &fluid : nullptr),
      boundary_(fluid, fluid.grid().owned_by_rank[session.world().rank()],
                options_.immersed_boundary.kernel, session.clock().step_s(),
                options_.immersed_boundary.forcing.value()) {
    if (options_.immersed_boundary.forcing == Forcing::no_slip) answer_.emplace();
    if (session.plan().interface_balance) balance_ = std::make_unique<BalanceRecord>();
    swap_text(session.world(), to_text(fluid.grid()), no_timeout_s,
              "description of the grid");
}

void FluidCoupling::begin() {
    batch_ = &exchange_.receive(when_, session_.restart() != nullptr);
    take_place();
    sample_velocities();
    send_velocities();
}

void FluidCoupling::receive_markers() {
    when_ = {session_.clock().step(), iteration_};
    batch_ = &exchange_.receive(when_);
    take_place();
    if (options_.scheme == Scheme::implicit && iteration_ == 0) fluid_.keep();
}

void FluidCoupling::take_place() {
    if (!fluid_.grid().follows) return;
    const std::size_t rank = session_.world().rank();
    const bool moved = boundary_.own(fluid_.grid().owned_by_rank[rank]);
    // After a move the cells of felt_ are others: their velocities are sampled again.
    if (!moved || felt_.empty()) return;
    boundary_.sample(batch_->before_m);
    felt_ = boundary_.sampled_cells();
}

void FluidCoupling::spread_impulses() {
    boundary_.spread(batch_->before_m, batch_->impulse);
    if (!answer_) return;
    answer_->make_room(batch_->now_m.size());
    boundary_.add_passed(session_.plan().fluid_density_kg_m3,
                         session_.plan().fluid_body_force_n_m3, *answer_);
}

void FluidCoupling::advance() {
    fluid_.advance();
    boundary_.fluid_has_changed();
    ++advances_;
}

void FluidCoupling::sample_velocities() {
    sampled_ = boundary_.sample(batch_->now_m);
    if (!answer_) return;
    answer_->make_room(sampled_.size());  // q is zero before the first step
    boundary_.add_row_sums(batch_->volume_m3, *answer_);
}

void FluidCoupling::send_velocities() {
    exchange_.send(when_, sampled_, answer_ ? &*answer_ : nullptr);
}

void FluidCoupling::begin_iterations() {
    iteration_ = 0;
    if (balance_) felt_ = boundary_.sampled_cells();
}

void FluidCoupling::check_convergence() {
    again_ = step_is_repeated(session_.world(), when_, session_.timeout_s());
    if (!again_) return;
    fluid_.go_back();
    boundary_.fluid_has_changed();
    ++iteration_;
}

}  // namespace magfsi::coupler

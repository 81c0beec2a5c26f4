// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/scheme/fluid_coupling.h"

#include "coupler/participants/handshake.h"
#include "coupler/participants/waiting.h"

namespace magfsi::coupler {

namespace {

std::unique_ptr<FluidSide> make_side(const Session& session, GridFluid& fluid) {
    const RunPlan& plan = session.plan();
    const ImmersedBoundary& options = plan.coupling->immersed_boundary;
    const auto& owned = fluid.grid().owned_by_rank[session.world().rank()];
    const double step_s = session.clock().step_s();
    if (options.forcing == Forcing::penalty)
        return std::make_unique<FluidSide>(fluid, owned, options.kernel, step_s);
    return std::make_unique<NoSlipFluidSide>(fluid, owned, options.kernel, step_s,
                                             plan.fluid_density_kg_m3,
                                             plan.fluid_body_force_n_m3);
}

}  // namespace

FluidCoupling::FluidCoupling(Session& session, GridFluid& fluid)
    : session_(session),
      fluid_(fluid),
      boundary_(make_side(session, fluid)),
      exchange_(session.world(), session.timeout_s(),
                session.plan().coupling->immersed_boundary.forcing.value(),
                fluid.grid().follows ? &fluid : nullptr) {
    if (session.plan().interface_balance) balance_ = std::make_unique<BalanceRecord>();
    swap_text(session.world(), to_text(fluid.grid()), no_timeout_s,
              "description of the grid");
}

void FluidCoupling::begin() {
    receive(-1, session_.restart() != nullptr);
    take_place();
    sample_velocities();
    send_velocities();
}

void FluidCoupling::receive(const Occasion& when, bool stays) {
    when_ = when;
    batch_ = &exchange_.receive(when, stays);
}

bool FluidCoupling::take_place() {
    const Grid& grid = fluid_.grid();
    return grid.follows && boundary_->own(grid.owned_by_rank[session_.world().rank()]);
}

void FluidCoupling::advance() {
    fluid_.advance();
    boundary_->fluid_has_changed();
    ++advances_;
}

void FluidCoupling::sample_velocities() {
    sampled_ = boundary_->sample(batch_->now_m, batch_->volume_m3);
}

void FluidCoupling::send_velocities() {
    exchange_.send(when_, sampled_, boundary_->answer());
}

}  // namespace magfsi::coupler

#include "coupler/scheme/fluid_coupling.h"

#include "coupler/immersed_boundary/grid.h"
#include "coupler/participants/world.h"
#include "coupler/scheme/fixed_point.h"

namespace magfsi::coupler {

namespace {

const Coupling& coupling_of(const Session& session) {
    return *session.plan().coupling;
}

bool at_once(const Session& session) {
    return coupling_of(session).scheme == Scheme::parallel;
}

}  // namespace

FluidCoupling::FluidCoupling(Session& session, GridFluid& fluid)
    : session_(session),
      fluid_(fluid),
      exchange_(session.world(), session.timeout_s()),
      immersed_boundary_(
          fluid,
          fluid.grid().owned_by_rank[static_cast<std::size_t>(session.world().rank())],
          coupling_of(session).immersed_boundary.kernel, session.clock().step_s()) {
    if (session.plan().interface_balance) balance_ = std::make_unique<BalanceRecord>();
    swap_text(session.world(), to_text(fluid.grid()), startup_timeout_s,
              "description of the grid");
}

void FluidCoupling::add_tasks(TaskList& tasks) {
    switch (coupling_of(session_).scheme) {
        case Scheme::serial:
            return add_turn(tasks);
        case Scheme::parallel:
            return add_meeting(tasks);
        case Scheme::implicit:
            return add_repeated_turn(tasks);
    }
}

// Serial: the impulses of the structure's step act in the same step of the fluid.
void FluidCoupling::add_turn(TaskList& tasks) {
    add_reception(tasks);
    add_iterations(tasks);
    add_audit(tasks, [this] { return immersed_boundary_.received(); });
    add_advance(tasks);
    add_count(tasks);
    add_sampling(tasks);
    tasks.add_coupling("send velocities",
                       [this] { exchange_.send(session_.clock().step() - 1, sampled_); });
}

// Parallel: both do step n at once, then meet. The impulses of the structure's step act
// in the fluid's coming step; the U that the structure gets has half of their effect.
void FluidCoupling::add_meeting(TaskList& tasks) {
    add_advance(tasks);
    add_reception(tasks);
    add_audit(tasks, [this] {
        return immersed_boundary_.received(immersed_boundary_.sampled_cells());
    });
    tasks.add_immersed_boundary("sample velocities",
                                [this] { sampled_ = sample_forced(batch_->now_m); });
    tasks.add_coupling("send velocities", [this] {
        exchange_.send(session_.clock().step(), sampled_);
        exchange_.finish_sending();
    });
    add_count(tasks);
}

// Implicit: as serial, from the same state again until the structure is content.
void FluidCoupling::add_repeated_turn(TaskList& tasks) {
    tasks.add("keep state", [this] { keep_state(); });
    const std::size_t first = tasks.size();
    add_reception(tasks);
    add_advance(tasks);
    add_sampling(tasks);
    tasks.add_coupling("send velocities", [this] {
        exchange_.send({session_.clock().step(), iteration_}, sampled_);
    });
    tasks.add_coupling("wait for convergence check", [this] { check_convergence(); });
    tasks.repeat_from(first, [this] { return again_; });
    add_audit(tasks, [this] { return immersed_boundary_.received(felt_); });
    add_count(tasks);
}

void FluidCoupling::keep_state() {
    fluid_.keep();
    iteration_ = 0;
    if (balance_) felt_ = immersed_boundary_.sampled_cells();
}

void FluidCoupling::check_convergence() {
    again_ = step_is_repeated(session_.world(), {session_.clock().step(), iteration_},
                              session_.timeout_s());
    if (!again_) return;
    fluid_.go_back();
    ++iteration_;
}

void FluidCoupling::add_advance(TaskList& tasks) {
    tasks.add(advance_fluid, [this] {
        fluid_.advance();
        ++advances_;
    });
}

void FluidCoupling::add_count(TaskList& tasks) {
    tasks.add("count step", [this] { session_.complete_step(); });
}

void FluidCoupling::add_reception(TaskList& tasks) {
    tasks.add_coupling("wait for structure", [this] {
        batch_ = &exchange_.receive({session_.clock().step(), iteration_});
    });
    tasks.add_immersed_boundary("spread impulses", [this] {
        immersed_boundary_.spread(batch_->before_m, batch_->impulse);
    });
}

void FluidCoupling::add_sampling(TaskList& tasks) {
    tasks.add_immersed_boundary("sample velocities", [this] {
        sampled_ = immersed_boundary_.sample(batch_->now_m);
    });
}

void FluidCoupling::add_audit(TaskList& tasks,
                              std::function<InterfaceBalance()> received) {
    if (!balance_) return;
    tasks.add_coupling("audit interface", [this, received = std::move(received)] {
        balance_->add(received());
    });
}

std::span<const Vec3> FluidCoupling::sample_forced(std::span<const Vec3> points_m) {
    return immersed_boundary_.sample_forced(points_m,
                                            session_.plan().fluid_density_kg_m3);
}

void FluidCoupling::add_iterations(TaskList& tasks) {
    if (coupling_of(session_).immersed_boundary.iterations > 1)
        tasks.add_coupling("iterate forcing", [this] { iterate_forcing(); });
}

// The structure, to which the shares of all fluid ranks add up, answers the slip that is
// left with the impulses that remove it.
void FluidCoupling::iterate_forcing() {
    const std::int64_t step = session_.clock().step();
    const int iterations = coupling_of(session_).immersed_boundary.iterations;
    for (int i = 1; i < iterations; ++i) {
        exchange_.send({step, i}, sample_forced(batch_->before_m));
        batch_ = &exchange_.receive({step, i});
        immersed_boundary_.spread(batch_->before_m, batch_->impulse, true);
    }
}

void FluidCoupling::begin() {
    batch_ = &exchange_.receive(-1);
    if (!at_once(session_) || !session_.restart()) {
        exchange_.send(-1, immersed_boundary_.sample(batch_->now_m));
        return;
    }
    // The impulses of the step before the checkpoint are still to act.
    immersed_boundary_.spread(batch_->before_m, batch_->impulse);
    exchange_.send(-1, sample_forced(batch_->now_m));
}

}  // namespace magfsi::coupler

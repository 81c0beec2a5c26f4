// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/checkpoint/checkpoints.h"

#include <fmt/format.h>

#include <memory>

#include "coupler/participants/waiting.h"
#include "coupler/participants/world.h"

namespace magfsi::coupler {

namespace {

constexpr int stop_tag = 74;

}  // namespace

StopAgreement::StopAgreement(const World& world, double timeout_s)
    : world_(world), timeout_s_(timeout_s) {}

bool StopAgreement::reached(std::int64_t step, bool last) {
    const bool follows = world_.coupled() && world_.self() == Role::fluid;
    return follows ? receive_decision() : decide(step, last);
}

bool StopAgreement::decide(std::int64_t step, bool last) {
    if (stopping_) return true;
    int asked = stop_requested() != 0 ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &asked, 1, MPI_INT, MPI_MAX, world_.local());
    stopping_ = asked != 0;
    // The fluid receives one message per step except after its last one, for which none
    // is sent.
    if (world_.root() && world_.coupled() && !last) {
        wait_all({&sending_, 1}, timeout_s_, "receiver of the message to continue");
        note_ = {step, asked};
        world_.send(note_.data(), 2, MPI_INT64_T, 0, stop_tag, &sending_);
    }
    return false;
}

// The first step has no message: the decision of step n - 1 arrives in step n.
bool StopAgreement::receive_decision() {
    std::int64_t stop = 0;
    if (world_.root() && begun_) {
        world_.receive_from_root(note_.data(), 2, MPI_INT64_T, stop_tag, timeout_s_,
                                 "message of the structure to continue");
        stop = note_[1];
    }
    begun_ = true;
    MPI_Bcast(&stop, 1, MPI_INT64_T, 0, world_.local());
    return stop != 0;
}

Checkpoints::Checkpoints(Session& session, Save save)
    : session_(session),
      save_(std::move(save)),
      every_(session.clock().every(session.plan().checkpoint->every_s)),
      stop_(session.world(), session.timeout_s()) {
    postpone_stop();
}

void Checkpoints::end_step() {
    const Clock& clock = session_.clock();
    const bool stop = stop_.reached(clock.step(), clock.done());
    if (stop || clock.step() % every_ == 0) write();
    if (stop && !clock.done())
        session_.stop(fmt::format("told to end; checkpoint of step {}", clock.step()));
}

void Checkpoints::write() {
    const World& world = session_.world();
    const std::int64_t step = session_.clock().step();
    std::unique_ptr<StateWriter> file;
    if (world.root()) {
        file = std::make_unique<StateWriter>(
            checkpoint_file(session_.out(), step, world.self()),
            StateHeader{session_.plan().state_hash, step, session_.clock().step_s()});
    }
    save_(file.get());
    if (file) file->commit();
    // The partner may still be writing its file, so that the checkpoint of this step
    // counts as incomplete and older ones stay.
    finish();
}

void Checkpoints::finish() {
    if (session_.world().leads())
        prune_checkpoints(session_.out(), session_.plan().roles);
}

}  // namespace magfsi::coupler

#include "coupler/checkpoint/checkpoints.h"

#include <fmt/format.h>

#include <memory>

#include "coupler/checkpoint/checkpoint_files.h"
#include "coupler/participants/wait.h"

namespace magfsi::coupler {

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
            StateHeader{session_.plan().state_hash, step,
                        session_.clock().step_s()});
    }
    save_(file.get());
    if (file) file->commit();
    // The partner may still be writing its half: it does not count yet.
    finish();
}

void Checkpoints::finish() {
    if (session_.world().leads())
        prune_checkpoints(session_.out(), session_.plan().roles);
}

}  // namespace magfsi::coupler

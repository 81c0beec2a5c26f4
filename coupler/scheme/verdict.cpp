#include "coupler/scheme/verdict.h"

#include <fmt/format.h>

#include <exception>

#include "coupler/participants/errors.h"
#include "coupler/participants/wait.h"

namespace magfsi::coupler {

namespace {

constexpr int verdict_tag = 75;

}  // namespace

VerdictSender::VerdictSender(const World& world, double timeout_s)
    : world_(world), timeout_s_(timeout_s) {}

VerdictSender::~VerdictSender() {
    if (std::uncaught_exceptions() > 0) return;
    try {
        wait_all({&sending_, 1}, timeout_s_, "receiver of the last verdict");
    } catch (const std::exception&) {
        // The fluid waits for it no more; it has said why.
    }
}

void VerdictSender::send(const Occasion& when, bool again) {
    if (!world_.root()) return;
    wait_all({&sending_, 1}, timeout_s_, "receiver of the verdict");
    note_ = {when.step, when.iteration, again ? 1 : 0};
    MPI_Isend(note_.data(), 3, MPI_INT64_T, 0, verdict_tag, world_.partner(), &sending_);
}

bool receive_verdict(const World& world, const Occasion& when, double timeout_s) {
    std::array<std::int64_t, 3> note{};
    if (world.root()) {
        MPI_Request request;
        MPI_Irecv(note.data(), 3, MPI_INT64_T, 0, verdict_tag, world.partner(), &request);
        wait_all(
            {&request, 1}, timeout_s,
            fmt::format("verdict on iteration {} of step {}", when.iteration, when.step));
    }
    MPI_Bcast(note.data(), 3, MPI_INT64_T, 0, world.local());
    if (note[0] == when.step && note[1] == when.iteration) return note[2] != 0;
    throw PartnerLost(fmt::format(
        "the two sides are out of step: a verdict on step {}, iteration {}, expected "
        "step {}, iteration {}",
        note[0], note[1], when.step, when.iteration));
}

}  // namespace magfsi::coupler

#include "coupler/checkpoint/stop_agreement.h"

#include "coupler/participants/wait.h"

namespace magfsi::coupler {

namespace {

constexpr int stop_tag = 74;

}  // namespace

StopAgreement::StopAgreement(const World& world, double timeout_s)
    : world_(world), timeout_s_(timeout_s) {}

bool StopAgreement::reached(std::int64_t step, bool last) {
    const bool follows = world_.coupled() && world_.self() == Role::fluid;
    return follows ? told_to_the_fluid() : decided_by_the_structure(step, last);
}

bool StopAgreement::decided_by_the_structure(std::int64_t step, bool last) {
    if (stopping_) return true;
    int asked = stop_requested() != 0 ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &asked, 1, MPI_INT, MPI_MAX, world_.local());
    stopping_ = asked != 0;
    // The fluid asks once a step, and not for what comes after its last.
    if (world_.root() && world_.coupled() && !last) {
        wait_all({&sending_, 1}, timeout_s_, "receiver of the word to go on");
        note_ = {step, asked};
        MPI_Isend(note_.data(), 2, MPI_INT64_T, 0, stop_tag, world_.partner(), &sending_);
    }
    return false;
}

bool StopAgreement::told_to_the_fluid() {
    std::int64_t stop = 0;
    if (world_.root() && begun_) {
        MPI_Request request;
        MPI_Irecv(note_.data(), 2, MPI_INT64_T, 0, stop_tag, world_.partner(), &request);
        wait_all({&request, 1}, timeout_s_, "word of the structure to go on");
        stop = note_[1];
    }
    begun_ = true;
    MPI_Bcast(&stop, 1, MPI_INT64_T, 0, world_.local());
    return stop != 0;
}

}  // namespace magfsi::coupler

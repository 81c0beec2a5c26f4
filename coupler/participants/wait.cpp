#include "coupler/participants/wait.h"

#include <fmt/format.h>
#include <sched.h>

#include <chrono>
#include <csignal>
#include <optional>
#include <thread>

#include "coupler/participants/errors.h"

namespace magfsi::coupler {

namespace {

using Clock = std::chrono::steady_clock;

// A fluid step takes milliseconds: a look every 50 us costs little of it, and a short
// spin first keeps the latency of small scenes down.
constexpr auto spin_time = std::chrono::microseconds(100);
constexpr auto nap = std::chrono::microseconds(50);

// Of mpirun's one second between SIGTERM and SIGKILL.
constexpr auto patience_after_sigterm = std::chrono::milliseconds(300);

volatile std::sig_atomic_t stop_signal = 0;
bool postponed = false;

extern "C" void remember_signal(int number) {
    stop_signal = number;
}

// How long ago this wait saw the signal.
bool may_wait_on(Clock::duration since) {
    if (!postponed) return false;
    return stop_signal == SIGUSR1 || since < patience_after_sigterm;
}

}  // namespace

void catch_stop_signals() {
    struct sigaction action {};
    action.sa_handler = &remember_signal;
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGUSR1, &action, nullptr);
}

int stop_requested() {
    return stop_signal;
}

void postpone_stop() {
    postponed = true;
}

bool stop_postponed() {
    return postponed;
}

void wait_all(std::span<MPI_Request> requests, double timeout_s,
              const std::string& what) {
    const auto start = Clock::now();
    std::optional<Clock::time_point> told;
    while (true) {
        int done = 0;
        MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done,
                    MPI_STATUSES_IGNORE);
        if (done != 0) return;
        const auto waited = Clock::now() - start;
        if (stop_requested() != 0 && !told) told = Clock::now();
        if (told && !may_wait_on(Clock::now() - *told)) {
            throw Stopped(fmt::format("told to end by signal {} while waiting for {}",
                                      stop_requested(), what));
        }
        if (std::chrono::duration<double>(waited).count() > timeout_s) {
            throw PartnerLost(fmt::format(
                "no {} within {:g} s: the partner hangs or is much slower than expected "
                "(coupling.timeout sets the limit)",
                what, timeout_s));
        }
        if (waited < spin_time)
            sched_yield();
        else
            std::this_thread::sleep_for(nap);
    }
}

}  // namespace magfsi::coupler

#include "coupler/participants/wait.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <optional>
#include <thread>

#include "coupler/participants/errors.h"

namespace magfsi::coupler {

namespace {

using Clock = std::chrono::steady_clock;

// A short spin keeps the latency of small scenes down. A nap of a sixty-fourth of what
// was waited already adds at most that share to a wait, and a partner that works for long
// on the same core is disturbed seldom.
constexpr auto spin_time = std::chrono::microseconds(100);
constexpr auto shortest_nap = std::chrono::nanoseconds(5000);
constexpr auto longest_nap = std::chrono::nanoseconds(200000);
constexpr int naps_a_wait = 64;

double seconds_waited = 0;

struct WaitingTime {
    Clock::time_point start = Clock::now();
    ~WaitingTime() {
        seconds_waited += std::chrono::duration<double>(Clock::now() - start).count();
    }
};

// Without it the kernel lengthens every nap by 50 us, to wake up several sleepers at
// once.
void sleep_exactly() {
    static const int done = prctl(PR_SET_TIMERSLACK, 1000UL, 0, 0, 0);  // ns
    (void)done;
}

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

template <typename Done>
void wait_until(Done done, double timeout_s, const std::string& what) {
    const WaitingTime waiting;
    std::optional<Clock::time_point> told;
    while (!done()) {
        const auto waited = Clock::now() - waiting.start;
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
        if (waited < spin_time) {
            sched_yield();
            continue;
        }
        sleep_exactly();
        std::this_thread::sleep_for(std::clamp<std::chrono::nanoseconds>(
            waited / naps_a_wait, shortest_nap, longest_nap));
    }
}

}  // namespace

void catch_stop_signals() {
    struct sigaction action {};
    action.sa_handler = &remember_signal;
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGUSR1, &action, nullptr);
    // A file beyond its size limit is then a failed write, which names the file.
    std::signal(SIGXFSZ, SIG_IGN);
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
    wait_until(
        [&] {
            int done = 0;
            MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done,
                        MPI_STATUSES_IGNORE);
            return done != 0;
        },
        timeout_s, what);
}

void wait_for_messages(MPI_Comm comm, std::span<const int> ranks, int tag,
                       double timeout_s, const std::string& what) {
    std::size_t arrived = 0;
    wait_until(
        [&] {
            for (; arrived < ranks.size(); ++arrived) {
                int there = 0;
                MPI_Iprobe(ranks[arrived], tag, comm, &there, MPI_STATUS_IGNORE);
                if (there == 0) return false;
            }
            return true;
        },
        timeout_s, what);
}

double waited_s() {
    return seconds_waited;
}

}  // namespace magfsi::coupler

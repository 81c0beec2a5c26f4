// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/participants/waiting.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <ctime>
#include <map>
#include <optional>
#include <thread>
#include <utility>

#include "coupler/participants/errors.h"

namespace magfsi::coupler {

namespace {

// State of this process, set by set_awaited and tell_of_long_waits.
Awaited awaited;
std::function<void(const std::string&)> tell;

using SteadyClock = std::chrono::steady_clock;

// A short spin keeps the latency of small scenes low; it is shorter still if the last
// wait of the same kind was long. A nap of 1/64 of the time waited so far lengthens a
// wait by at most that share, and seldom disturbs a partner that works for long on the
// same core.
constexpr auto spin_time = std::chrono::microseconds(100);
constexpr auto shortest_nap = std::chrono::nanoseconds(10000);
constexpr auto longest_nap = std::chrono::nanoseconds(200000);
constexpr int naps_a_wait = 64;
// Longest sleep between two looks at a partner that notifies this process of its
// messages.
constexpr auto longest_sleep = std::chrono::milliseconds(20);

// Durations of the last waits, by the message's tag, 0 for others.
std::map<int, SteadyClock::duration> last_waits;

double seconds_waited = 0;

// Measures a wait, and chooses the length of its spin from the last wait of the same tag.
struct WaitingTime {
    explicit WaitingTime(int tag) : last(last_waits[tag]) {}
    SteadyClock::duration& last;
    SteadyClock::time_point start = SteadyClock::now();
    SteadyClock::duration spin = last > spin_time ? spin_time / 8 : spin_time;
    ~WaitingTime() {
        last = SteadyClock::now() - start;
        seconds_waited += std::chrono::duration<double>(last).count();
    }
};

// Sets the slack of this thread's timers to 1 us: by default the kernel lengthens every
// nap by 50 us, to wake up several sleepers at once.
void sleep_exactly() {
    static const int done = prctl(PR_SET_TIMERSLACK, 1000UL, 0, 0, 0);  // ns
    (void)done;
}

// The sleep between two checks of a wait.
class Sleep {
  public:
    // notifier: that of this process, if the senders of the awaited messages notify it,
    // else null.
    explicit Sleep(const Notifier* notifier) : notifier_(notifier) { sleep_exactly(); }
    void after(SteadyClock::duration waited) {
        using std::chrono::nanoseconds;
        if (!notifier_) {
            std::this_thread::sleep_for(
                std::clamp<nanoseconds>(waited / naps_a_wait, shortest_nap, longest_nap));
            return;
        }
        // The message may need another moment after its notification, or the notification
        // was for another wait: short sleeps follow.
        nanoseconds longest = longest_sleep;
        if (notified_after_ >= nanoseconds(0))
            longest = std::clamp<nanoseconds>((waited - notified_after_) / 2,
                                              shortest_nap, longest_sleep);
        if (notifier_->wait(longest)) notified_after_ = waited;
    }

  private:
    const Notifier* notifier_;
    // Time of the last notification, since the start of the wait; negative if there was
    // none.
    SteadyClock::duration notified_after_{-1};
};

// Time within which a wait must end after SIGTERM, a part of the second that mpirun
// leaves before SIGKILL.
constexpr auto patience_after_sigterm = std::chrono::milliseconds(300);

volatile std::sig_atomic_t stop_signal = 0;
bool postponed = false;

extern "C" void remember_signal(int number) {
    stop_signal = number;
}

// True if a wait may go on after a signal that it saw `since` ago.
bool may_wait_on(SteadyClock::duration since) {
    if (!postponed) return false;
    return stop_signal == SIGUSR1 || since < patience_after_sigterm;
}

// The bookkeeping of a long wait: the time limit, checks once a second that the partner
// is still there, and a message each minute.
class LongWait {
  public:
    LongWait(double timeout_s, const std::string& what, const std::string& whom)
        : timeout_s_(timeout_s), what_(what), whom_(whom) {}

    void look(SteadyClock::time_point now) {
        // Time in which this process did not run either is nobody's delay: the whole job
        // was suspended, or the machine slept. A step between two looks counts as one
        // second at most.
        constexpr std::chrono::duration<double> longest_between_looks(1);
        own_s_ +=
            std::min<std::chrono::duration<double>>(now - last_, longest_between_looks)
                .count();
        last_ = now;
        if (own_s_ > timeout_s_) {
            throw TimedOut(
                fmt::format("no {} within {:g} s: the partner hangs or is much slower "
                            "than expected (coupling.timeout sets the limit)",
                            what_, timeout_s_));
        }
        if (own_s_ < next_look_s_) return;
        next_look_s_ = own_s_ + 1;
        look_at_partner();
    }

  private:
    void look_at_partner() {
        std::string about;
        for (const Awaited::Process& one : awaited.processes) {
            const Life life = life_of(one.id);
            if (life == Life::stopped)
                about = fmt::format("; its process {} is stopped", one.id.pid);
            if (life == Life::gone) {
                lost(one);
                return;
            }
        }
        gone_s_.reset();
        if (own_s_ < next_word_s_) return;
        next_word_s_ += 60;
        if (!tell) return;
        const std::tm start = fmt::localtime(start_);
        tell(fmt::format("waiting for the {} since {:%H:%M:%S} ({:.0f} s): {}{}", whom_,
                         start, std::difftime(std::time(nullptr), start_), what_, about));
    }

    // mpirun notices a dead process, too, and names the cause; this error is for jobs in
    // which it does not.
    void lost(const Awaited::Process& one) {
        constexpr double patience_with_mpirun_s = 4;
        if (!gone_s_) gone_s_ = own_s_;
        if (own_s_ - *gone_s_ < patience_with_mpirun_s) return;
        throw PartnerLost(fmt::format("no {}: process {} of the {} is gone", what_,
                                      one.id.pid, one.name));
    }

    double timeout_s_;
    const std::string& what_;
    const std::string& whom_;
    std::time_t start_ = std::time(nullptr);
    SteadyClock::time_point last_ = SteadyClock::now();
    double own_s_ = 0, next_look_s_ = 1, next_word_s_ = 60;
    // Time at which a process of the partner was first found to be gone.
    std::optional<double> gone_s_;
};

// Waits until done() returns true. tag: selects the kind of wait whose last duration sets
// the spin; notifier: see Sleep.
template <typename Done>
void wait_until(Done done, double timeout_s, const std::string& what,
                const std::string& whom = awaited.partner, int tag = 0,
                const Notifier* notifier = nullptr) {
    const WaitingTime waiting(tag);
    Sleep sleep(notifier);
    std::optional<SteadyClock::time_point> told;
    std::optional<LongWait> wait;
    while (!done()) {
        const auto now = SteadyClock::now();
        const auto waited = now - waiting.start;
        if (stop_requested() != 0 && !told) told = now;
        if (told && !may_wait_on(now - *told)) {
            throw Stopped(fmt::format("told to end by signal {} while waiting for {}",
                                      stop_requested(), what));
        }
        if (waited < waiting.spin) {
            sched_yield();
            continue;
        }
        if (!wait) wait.emplace(timeout_s, what, whom);
        wait->look(now);
        sleep.after(waited);
    }
}

}  // namespace

void set_awaited(Awaited of_this_process) {
    awaited = std::move(of_this_process);
}

void catch_stop_signals() {
    struct sigaction action {};
    action.sa_handler = &remember_signal;
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGUSR1, &action, nullptr);
    // Writing beyond the limit of a file's size then fails, and the error names the file.
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
            MPI_Testall(requests.size(), requests.data(), &done, MPI_STATUSES_IGNORE);
            return done != 0;
        },
        timeout_s, what);
}

void wait_for_messages(MPI_Comm comm, std::span<const int> ranks, int tag,
                       double timeout_s, const std::string& what,
                       const std::string& whom) {
    std::size_t arrived = 0;
    wait_until(
        [&] {
            for (; arrived < ranks.size(); ++arrived) {
                int there = 0;
                // Open MPI handles incoming messages only after it has answered a probe,
                // so that a second probe may find what the first one missed.
                for (int twice = 0; twice < 2 && there == 0; ++twice)
                    MPI_Iprobe(ranks[arrived], tag, comm, &there, MPI_STATUS_IGNORE);
                if (there == 0) return false;
            }
            return true;
        },
        timeout_s, what, whom.empty() ? awaited.partner : whom, tag,
        whom.empty() ? awaited.notifier : nullptr);
}

void tell_of_long_waits(std::function<void(const std::string&)> teller) {
    tell = std::move(teller);
}

double waited_s() {
    return seconds_waited;
}

}  // namespace magfsi::coupler

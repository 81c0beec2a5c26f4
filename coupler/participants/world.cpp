#include "coupler/participants/world.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <optional>
#include <thread>
#include <vector>

#include "coupler/participants/errors.h"

namespace magfsi::coupler {

namespace {

constexpr int intercommunicator_tag = 71;

// The world rank of the first process of each role, or -1.
int first_rank(const std::vector<int>& roles, Role role) {
    const auto at = std::find(roles.begin(), roles.end(), static_cast<int>(role));
    return at == roles.end() ? -1 : static_cast<int>(at - roles.begin());
}

}  // namespace

std::string to_string(Role role) {
    return role == Role::structure ? "structure" : "fluid";
}

World::World(Role self, bool partner_expected) : self_(self) {
    int world_rank = 0;
    int world_size = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &world_rank);
    MPI_Comm_size(MPI_COMM_WORLD, &world_size);
    MPI_Comm_split(MPI_COMM_WORLD, static_cast<int>(self), world_rank, &local_);
    MPI_Comm_rank(local_, &rank_);
    MPI_Comm_size(local_, &size_);

    const int mine = static_cast<int>(self);
    std::vector<int> roles(static_cast<std::size_t>(world_size));
    MPI_Allgather(&mine, 1, MPI_INT, roles.data(), 1, MPI_INT, MPI_COMM_WORLD);
    const int partner = first_rank(roles, other());
    if (partner < 0 && partner_expected) {
        throw PartnerLost(
            fmt::format("{0} was started without its partner: the scene couples "
                        "structure and fluid, and no {1} process is in this MPI job; "
                        "start both in one mpirun (mpirun -n 1 magfsi-structure SCENE : "
                        "-n 1 magfsi-fluid-lbm SCENE) or use ./magfsi run SCENE",
                        to_string(self_), to_string(other())));
    }
    if (partner >= 0 && !partner_expected) {
        throw PartnerLost(fmt::format(
            "a {1} process was started beside the {0}, but the {0}'s scene has no {1}: "
            "start only magfsi's {0}, or give both sides the same scene",
            to_string(self_), to_string(other())));
    }
    if (partner >= 0) {
        MPI_Intercomm_create(local_, 0, MPI_COMM_WORLD, partner, intercommunicator_tag,
                             &partner_);
        MPI_Comm_remote_size(partner_, &partner_size_);
    }
}

World::~World() {
    if (partner_ != MPI_COMM_NULL) MPI_Comm_free(&partner_);
    if (local_ != MPI_COMM_NULL) MPI_Comm_free(&local_);
}

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
            throw PartnerLost(
                fmt::format("no {} within {:g} s: the partner hangs or is much slower "
                            "than expected (coupling.timeout sets the limit)",
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

namespace {

constexpr int swap_tag = 72;
constexpr int numbers_tag = 73;

template <class Number>
void compare(const World& world, const char* item, Number mine, Number theirs,
             const char* format = "{}") {
    if (mine == theirs) return;
    throw PartnerLost(
        fmt::format("{} and {} disagree on the {}: {} here, {} there; start both with "
                    "the same scene file and the same --set options, from the same build",
                    to_string(world.self()), to_string(world.other()), item,
                    fmt::format(fmt::runtime(format), mine),
                    fmt::format(fmt::runtime(format), theirs)));
}

}  // namespace

void swap_with_partner(const World& world, const void* send, int send_bytes,
                       void* receive, int receive_bytes, double timeout_s,
                       const char* what) {
    if (world.root()) {
        std::array<MPI_Request, 2> requests;
        MPI_Irecv(receive, receive_bytes, MPI_BYTE, 0, swap_tag, world.partner(),
                  &requests[0]);
        MPI_Isend(send, send_bytes, MPI_BYTE, 0, swap_tag, world.partner(), &requests[1]);
        wait_all(requests, timeout_s,
                 fmt::format("{} of the {}", what, to_string(world.other())));
    }
    MPI_Bcast(receive, receive_bytes, MPI_BYTE, 0, world.local());
}

void shake_hands(const World& world, const Agreement& mine, double timeout_s) {
    Agreement theirs;
    swap_with_partner(world, &mine, sizeof mine, &theirs, sizeof theirs, timeout_s,
                      "handshake");
    compare(world, "protocol version", mine.protocol, theirs.protocol);
    compare(world, "scene (hash)", mine.scene_hash, theirs.scene_hash, "{:016x}");
    compare(world, "number of coupled steps", mine.steps, theirs.steps);
    compare(world, "coupled step in picoseconds", mine.step_ps, theirs.step_ps);
    compare(world, "step of the checkpoint to go on from", mine.first_step,
            theirs.first_step);
}

std::string swap_text(const World& world, const std::string& mine, double timeout_s,
                      const char* what) {
    const auto my_size = static_cast<std::int64_t>(mine.size());
    std::int64_t size = 0;
    swap_with_partner(world, &my_size, sizeof my_size, &size, sizeof size, timeout_s,
                      what);
    std::string theirs(static_cast<std::size_t>(size), ' ');
    swap_with_partner(world, mine.data(), static_cast<int>(mine.size()), theirs.data(),
                      static_cast<int>(size), timeout_s, what);
    return theirs;
}

void send_numbers(const World& world, std::int64_t step, std::span<const double> numbers,
                  double timeout_s) {
    std::vector<double> message{static_cast<double>(step)};
    message.insert(message.end(), numbers.begin(), numbers.end());
    MPI_Request request;
    MPI_Isend(message.data(), static_cast<int>(message.size()), MPI_DOUBLE, 0,
              numbers_tag, world.partner(), &request);
    wait_all({&request, 1}, timeout_s,
             fmt::format("receiver of the probes of step {}", step));
}

void receive_numbers(const World& world, std::int64_t step, std::span<double> numbers,
                     double timeout_s) {
    std::vector<double> message(numbers.size() + 1);
    MPI_Request request;
    MPI_Irecv(message.data(), static_cast<int>(message.size()), MPI_DOUBLE, 0,
              numbers_tag, world.partner(), &request);
    wait_all({&request, 1}, timeout_s, fmt::format("fluid probes of step {}", step));
    if (static_cast<std::int64_t>(message[0]) != step) {
        throw PartnerLost(
            fmt::format("fluid probes of step {} came at step {}", message[0], step));
    }
    std::copy(message.begin() + 1, message.end(), numbers.begin());
}

}  // namespace magfsi::coupler

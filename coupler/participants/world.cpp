// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/participants/world.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <map>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "coupler/participants/errors.h"
#include "coupler/participants/processes.h"

namespace magfsi::coupler {

namespace {

constexpr int intercommunicator_tag = 71, controller_tag = 75;

// A process of the job, as all of them learn of it.
struct Member {
    std::int64_t role = 0;
    std::uint64_t scene_hash = 0;
    std::array<char, 32> program{};
    ProcessId process;
};

std::vector<Member> members_of_world(Role self, std::uint64_t scene_hash) {
    Member mine{static_cast<int>(self), scene_hash, {}, this_process()};
    const std::string_view name = program_invocation_short_name;
    name.copy(mine.program.data(), mine.program.size() - 1);
    int world_size = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &world_size);
    std::vector<Member> all(static_cast<std::size_t>(world_size));
    MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE,
                  MPI_COMM_WORLD);
    return all;
}

void check_own_side(Role self, const Member& mine, const std::vector<Member>& all) {
    for (const Member& other : all) {
        if (other.role != mine.role) continue;
        if (other.program != mine.program)
            throw PartnerLost(fmt::format(
                "{} and {} are both in this MPI job as the {}; start one of them",
                mine.program.data(), other.program.data(), to_string(self)));
        if (other.scene_hash != mine.scene_hash)
            throw PartnerLost(fmt::format(
                "the processes of the {} disagree on the scene (hash): {:016x} here, "
                "{:016x} there; start all with the same scene file and --set options",
                to_string(self), mine.scene_hash, other.scene_hash));
    }
}

// The world rank of the first process of each role, or -1.
int first_rank(const std::vector<Member>& all, Role role) {
    const auto at = std::ranges::find(all, static_cast<int>(role), &Member::role);
    return at == all.end() ? -1 : static_cast<int>(at - all.begin());
}

// Whom this process waits for, for the waits, which are free functions.
struct Awaited {
    ProcessId process;
    std::string name;
};
std::vector<Awaited> awaited;
std::string partner_name = "partner";
// Of this process, if all of the partner's ring it.
const Bell* partners_bell = nullptr;
std::function<void(const std::string&)> tell;

}  // namespace

std::string to_string(Role role) {
    if (role == Role::control) return "controller";
    return role == Role::structure ? "structure" : "fluid";
}

World::World(Role self, bool partner_expected, std::uint64_t scene_hash,
             bool controller_expected)
    : self_(self), bell_(this_process()) {
    const std::vector<Member> all = members_of_world(self, scene_hash);
    joined();
    int world_rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &world_rank);
    check_own_side(self, all[static_cast<std::size_t>(world_rank)], all);
    MPI_Comm_split(MPI_COMM_WORLD, static_cast<int>(self), world_rank, &local_);
    MPI_Comm_rank(local_, &rank_);
    MPI_Comm_size(local_, &size_);
    join_partner(first_rank(all, other()), partner_expected);
    // A controller is the structure's: the fluid knows nothing of it.
    const int controller = first_rank(all, Role::control);
    if (self == Role::structure) join_controller(controller, controller_expected);
    if (controller_ != MPI_COMM_NULL)
        controller_process_ = all[static_cast<std::size_t>(controller)].process;
    partner_name = to_string(other());
    awaited.clear();
    std::vector<ProcessId> partner;
    for (const Member& member : all) {
        const auto role = static_cast<Role>(member.role);
        if (role == other()) partner.push_back(member.process);
        if (role == other() || (role == Role::control && self == Role::structure))
            awaited.push_back({member.process, to_string(role)});
    }
    if (coupled()) try_bells(partner);
}

// Both sides' sockets are there since the first exchange.
void World::try_bells(const std::vector<ProcessId>& partner) {
    int rung = 1, heard = 0;
    for (const ProcessId& process : partner)
        rung = bell_.ring(process) && rung != 0 ? 1 : 0;
    MPI_Allreduce(&rung, &heard, 1, MPI_INT, MPI_MIN, partner_);  // of the partner's
    if (rung != 0) partner_processes_ = partner;
    if (heard != 0) partners_bell = &bell_;
}

void World::send(const void* data, int count, MPI_Datatype type, int rank, int tag,
                 MPI_Request* request) const {
    MPI_Isend(data, count, type, rank, tag, partner_, request);
    if (!partner_processes_.empty())
        bell_.ring(partner_processes_[static_cast<std::size_t>(rank)]);
}

void World::join_partner(int first, bool expected) {
    if (first < 0 && expected) {
        throw PartnerLost(
            fmt::format("{0} was started without its partner: the scene couples "
                        "structure and fluid, and no {1} process is in this MPI job; "
                        "start both in one mpirun (mpirun -n 1 magfsi-structure SCENE : "
                        "-n 1 magfsi-fluid-lbm SCENE) or use ./magfsi run SCENE",
                        to_string(self_), to_string(other())));
    }
    if (first >= 0 && !expected) {
        throw PartnerLost(fmt::format(
            "a {1} process was started beside the {0}, but the {0}'s scene has no {1}: "
            "start only magfsi's {0}, or give both sides the same scene",
            to_string(self_), to_string(other())));
    }
    if (first < 0) return;
    MPI_Intercomm_create(local_, 0, MPI_COMM_WORLD, first, intercommunicator_tag,
                         &partner_);
    MPI_Comm_remote_size(partner_, &partner_size_);
}

void World::join_controller(int first, bool expected) {
    if ((first >= 0) != expected) {
        throw PartnerLost(
            expected
                ? "the structure was started without its controller: start python3 -m "
                  "magfsi.controller in the same mpirun, or use ./magfsi run SCENE"
                : "a controller was started beside the structure, whose scene has no "
                  "control: start only the structure and its partner");
    }
    if (first < 0) return;
    MPI_Intercomm_create(local_, 0, MPI_COMM_WORLD, first, controller_tag, &controller_);
}

World::~World() {
    awaited.clear();
    partners_bell = nullptr;
    for (MPI_Comm* comm : {&partner_, &controller_, &local_})
        if (*comm != MPI_COMM_NULL) MPI_Comm_free(comm);
}

namespace {

using SteadyClock = std::chrono::steady_clock;

// A short spin keeps the latency of small scenes down; where the same wait was long, it
// is shorter still. A nap of a sixty-fourth of what was waited already adds at most that
// share to a wait, and a partner that works for long on the same core is disturbed
// seldom.
constexpr auto spin_time = std::chrono::microseconds(100);
constexpr auto shortest_nap = std::chrono::nanoseconds(10000);
constexpr auto longest_nap = std::chrono::nanoseconds(200000);
constexpr int naps_a_wait = 64;
// Between looks at a partner that rings when it has sent something.
constexpr auto longest_sleep = std::chrono::milliseconds(20);

std::map<int, SteadyClock::duration> last_waits;  // by the message's tag, 0 for others

double seconds_waited = 0;

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

// Without it the kernel lengthens every nap by 50 us, to wake up several sleepers at
// once.
void sleep_exactly() {
    static const int done = prctl(PR_SET_TIMERSLACK, 1000UL, 0, 0, 0);  // ns
    (void)done;
}

// Between two checks.
class Sleep {
  public:
    // bell: of whoever sends what is waited for; null where nobody rings.
    explicit Sleep(const Bell* bell) : bell_(bell) { sleep_exactly(); }
    void after(SteadyClock::duration waited) {
        using std::chrono::nanoseconds;
        if (!bell_) {
            std::this_thread::sleep_for(
                std::clamp<nanoseconds>(waited / naps_a_wait, shortest_nap, longest_nap));
            return;
        }
        // What was announced may need another moment, or it was for another wait.
        nanoseconds longest = longest_sleep;
        if (rang_after_ >= nanoseconds(0))
            longest = std::clamp<nanoseconds>((waited - rang_after_) / 2, shortest_nap,
                                              longest_sleep);
        if (bell_->wait(longest)) rang_after_ = waited;
    }

  private:
    const Bell* bell_;
    SteadyClock::duration rang_after_{-1};  // the start of the wait; below 0: not yet
};

// Of mpirun's one second between SIGTERM and SIGKILL.
constexpr auto patience_after_sigterm = std::chrono::milliseconds(300);

volatile std::sig_atomic_t stop_signal = 0;
bool postponed = false;

extern "C" void remember_signal(int number) {
    stop_signal = number;
}

// How long ago this wait saw the signal.
bool may_wait_on(SteadyClock::duration since) {
    if (!postponed) return false;
    return stop_signal == SIGUSR1 || since < patience_after_sigterm;
}

// A wait that lasts: whether the partner is still there, and a word about it each minute.
class LongWait {
  public:
    LongWait(double timeout_s, const std::string& what, const std::string& whom)
        : timeout_s_(timeout_s), what_(what), whom_(whom) {}

    void look(SteadyClock::time_point now) {
        // Time in which this process did not run either is nobody's delay: the whole job
        // was suspended, or the machine slept.
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
        for (const Awaited& one : awaited) {
            const Life life = life_of(one.process);
            if (life == Life::stopped)
                about = fmt::format("; its process {} is stopped", one.process.pid);
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

    // mpirun notices too and names the cause; this is for a job that has none.
    void lost(const Awaited& one) {
        constexpr double patience_with_mpirun_s = 4;
        if (!gone_s_) gone_s_ = own_s_;
        if (own_s_ - *gone_s_ < patience_with_mpirun_s) return;
        throw PartnerLost(fmt::format("no {}: process {} of the {} is gone", what_,
                                      one.process.pid, one.name));
    }

    double timeout_s_;
    const std::string& what_;
    const std::string& whom_;
    std::time_t start_ = std::time(nullptr);
    SteadyClock::time_point last_ = SteadyClock::now();
    double own_s_ = 0, next_look_s_ = 1, next_word_s_ = 60;
    std::optional<double> gone_s_;
};

template <typename Done>
void wait_until(Done done, double timeout_s, const std::string& what,
                const std::string& whom = partner_name, int tag = 0,
                const Bell* bell = nullptr) {
    const WaitingTime waiting(tag);
    Sleep sleep(bell);
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
                       double timeout_s, const std::string& what,
                       const std::string& whom) {
    std::size_t arrived = 0;
    wait_until(
        [&] {
            for (; arrived < ranks.size(); ++arrived) {
                int there = 0;
                // Open MPI looks for what has come only after it has answered.
                for (int twice = 0; twice < 2 && there == 0; ++twice)
                    MPI_Iprobe(ranks[arrived], tag, comm, &there, MPI_STATUS_IGNORE);
                if (there == 0) return false;
            }
            return true;
        },
        timeout_s, what, whom.empty() ? partner_name : whom, tag,
        whom.empty() ? partners_bell : nullptr);
}

void receive_from_root(const World& world, void* data, int count, MPI_Datatype type,
                       int tag, double timeout_s, const std::string& what) {
    constexpr std::array root{0};
    wait_for_messages(world.partner(), root, tag, timeout_s, what);
    MPI_Request request;
    MPI_Irecv(data, count, type, 0, tag, world.partner(), &request);
    wait_all({&request, 1}, timeout_s, what);
}

void tell_of_long_waits(std::function<void(const std::string&)> teller) {
    tell = std::move(teller);
}

double waited_s() {
    return seconds_waited;
}

}  // namespace magfsi::coupler

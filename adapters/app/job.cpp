// SPDX-License-Identifier: GPL-2.0-or-later
// Start and supervision of mpirun: signals are passed on to it, its error output is
// filtered, and a hung mpirun is killed.
#include "adapters/app/job.h"
#include "adapters/app/mpirun_guard.h"
#include "adapters/run_scene.h"
#include "adapters/scene/fault.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>

namespace magfsi::launch {

namespace {

// True if any of the texts occurs in any of the lines.
bool has_any(std::span<const std::string> lines, std::span<const char* const> texts) {
    return std::ranges::any_of(lines, [&](const std::string& line) {
        return std::ranges::any_of(texts, [&](const char* text) {
            return line.find(text) != std::string::npos;
        });
    });
}

// Banners of Open MPI that say in other words what magfsi says itself.
constexpr const char* known_banners[] = {"MPI_ABORT was invoked",
                                         "Primary job  terminated normally",
                                         "mpirun noticed that process",
                                         "mpirun detected that one",
                                         "mpirun has exited due to process rank",
                                         "prterun noticed that process",
                                         "prterun detected that one",
                                         "prterun has exited due to process rank"};
// Lines of Open MPI ("[host:pid] ...") about these banners and about a read of shared
// memory that a killed partner had offered, and libevent's "[warn] ..." about a closed
// socket. They are dropped.
constexpr const char* known_lines[] = {"more process has sent help message",
                                       "more processes have sent help message",
                                       "Set MCA parameter \"orte_base_help_aggregate\"",
                                       "ORTE_ERROR_LOG",
                                       "Read -1, expected",
                                       "btl_tcp_proc",
                                       "Epoll MOD("};

volatile pid_t child = 0;
volatile std::sig_atomic_t stop_signal = 0;
volatile std::sig_atomic_t seconds_to_end = 0;  // 0: no limit
volatile std::sig_atomic_t seconds_asked = 0;

// Signal handler. mpirun kills its processes one second after SIGTERM, too early for a
// summary on a busy machine; SIGUSR1 is passed on to every process without a limit. It is
// repeated every second by SIGALRM, since mpirun has no processes to pass it on to while
// it starts. SIGTERM follows when the time is over (processes that hang or are suspended
// do not answer) and when the user asks twice.
extern "C" void pass_on(int signal) {
    const bool again = signal == SIGALRM;
    const bool twice = !again && stop_signal != 0;
    if (again)
        seconds_asked = seconds_asked + 1;
    else
        stop_signal = signal;
    const bool late = seconds_to_end > 0 && seconds_asked >= seconds_to_end;
    if (child <= 0) return;
    kill(child, twice || late ? SIGTERM : SIGUSR1);
    if (!twice && !late) alarm(1);
}

// Messages of magfsi that have been shown; each is shown once, however many ranks print
// it.
std::set<std::string> shown;

void show(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
        if (line.starts_with("magfsi") && !shown.insert(line).second) continue;
        // Participants that mpirun ends after another one was lost print this line; the
        // cause is named once at the end of the job.
        if (stop_signal == 0 && line.find("told to end by signal") != std::string::npos)
            continue;
        std::fprintf(stderr, "%s\n", scene::printable(line).c_str());
    }
}

struct LostProcess {
    int world_rank = -1;
    int signal = 0;
};

// Filter of mpirun's error output, line by line. Known banners, framed by lines of
// dashes, are hidden; what they say about a killed process is stored.
class MpirunMessages {
  public:
    void take(std::string line) {
        // Open MPI 5 ends its messages with a NUL character or, now and then, with an
        // empty line.
        const bool had_nul = std::erase(line, '\0') > 0;
        if (line.empty() && (had_nul || !in_banner_)) return;
        if (line.size() > 40 && line.find_first_not_of('-') == std::string::npos) {
            if (in_banner_)
                close_banner();
            else
                in_banner_ = true;
        } else if (line.starts_with("mpirun: Forwarding signal") ||
                   line.starts_with("prterun: Forwarding signal") ||
                   // Open MPI 5, of networks of a machine that it does not need; the
                   // lines of two processes may be mixed.
                   line.starts_with("Unable to find reachable pairing") ||
                   // hwloc, in a container without /sys.
                   line.starts_with("hwloc/") ||
                   (line.starts_with('[') && has_any({&line, 1}, known_lines))) {
            return;
        } else if (in_banner_) {
            banner_.push_back(line);
        } else {
            show({line});
        }
    }
    // Ends the present banner; must be called at the end of the stream, too.
    void close_banner() {
        in_banner_ = false;
        look_for_lost_process();
        if (!has_any(banner_, known_banners)) show(banner_);
        banner_.clear();
    }
    const std::optional<LostProcess>& lost() const { return lost_; }

  private:
    // The sentence may be broken into lines anywhere.
    void look_for_lost_process() {
        const std::string text = fmt::format("{}", fmt::join(banner_, " "));
        const char* at = std::strstr(text.c_str(), "process rank ");
        const char* end = std::strstr(text.c_str(), "exited on signal ");
        LostProcess lost;
        if (at && end && std::sscanf(at, "process rank %d", &lost.world_rank) == 1 &&
            std::sscanf(end, "exited on signal %d", &lost.signal) == 1)
            lost_ = lost;
    }

    bool in_banner_ = false;
    std::vector<std::string> banner_;
    std::optional<LostProcess> lost_;
};

std::string name_of(const std::vector<Program>& programs, int world_rank) {
    for (const Program& p : programs) {
        if (world_rank < p.ranks) return fmt::format("{} rank {}", p.role, world_rank);
        world_rank -= p.ranks;
    }
    return "a process";
}

// Turns the forked child into mpirun; never returns. `signals` is the signal mask to
// restore, `session` the folder for mpirun's own files or "".
[[noreturn]] void become(const std::vector<std::string>& command,
                         const std::string& session, int error_pipe, pid_t launcher,
                         const sigset_t& signals) {
    // mpirun gets SIGTERM when the launcher dies, and passes it on to all processes of
    // the job.
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != launcher) _exit(1);
    sigprocmask(SIG_SETMASK, &signals, nullptr);
    if (!session.empty()) setenv(session_variable(), session.c_str(), 1);
    dup2(error_pipe, STDERR_FILENO);
    std::vector<char*> words;
    for (const std::string& word : command)
        words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    execvp(words[0], words.data());
    std::fprintf(stderr, "magfsi: cannot start %s: %s\n", words[0], std::strerror(errno));
    _exit(127);
}

}  // namespace

// A closing terminal (SIGHUP) asks for an end, too, unless nohup has made the process
// ignore it.
void pass_on_signals() {
    struct sigaction action {
    }, before{};
    action.sa_handler = &pass_on;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGALRM, &action, nullptr);
    if (sigaction(SIGHUP, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
        sigaction(SIGHUP, &action, nullptr);
}

namespace {

// Reads mpirun's error output until mpirun ends. Returns true if mpirun hung and was
// killed.
bool filter_errors(int pipe, MpirunMessages& messages) {
    std::string pending;
    char buffer[4096];
    HungMpirun hung;
    bool ended = false;
    while (true) {
        pollfd waiting{pipe, POLLIN, 0};
        const int ready = poll(&waiting, 1, 1000);
        if (ready == 0 && !ended && hung.now(child)) ended = kill(child, SIGKILL) == 0;
        if (ready <= 0) continue;  // silence, or a signal came
        const ssize_t got = read(pipe, buffer, sizeof buffer);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        pending.append(buffer, static_cast<std::size_t>(got));
        std::size_t end;
        while ((end = pending.find('\n')) != std::string::npos) {
            messages.take(pending.substr(0, end));
            pending.erase(0, end + 1);
        }
    }
    if (!pending.empty()) messages.take(pending);
    messages.close_banner();
    return ended;
}

}  // namespace

void need_stack() {
    constexpr rlim_t least = 1 << 20, wanted = 8 << 20;
    struct rlimit stack {};
    if (getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= wanted) return;
    stack.rlim_cur = std::min(stack.rlim_max, wanted);
    if (stack.rlim_cur >= least && setrlimit(RLIMIT_STACK, &stack) == 0) return;
    throw std::runtime_error(fmt::format(
        "the limit of the stack is {} kB, at least {} kB are needed: ulimit -s "
        "{}",
        stack.rlim_max / 1024, least / 1024, wanted / 1024));
}

JobEnd run_job(const std::vector<Program>& programs, OnStop on_stop) {
    seconds_to_end = on_stop == OnStop::checkpoint ? 0 : 5;
    shown.clear();
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) no_room("make a pipe", "ulimit -n");
    // Not in the child: the look-up of a user without HOME waits there for ever where
    // another thread was looking up the host's name when it was forked.
    set_mpirun_environment();
    const auto command = mpirun_command(programs);
    const std::string session = session_folder();
    const pid_t launcher = getpid();
    // Signals are blocked until `child` is set, so that the handler has a process to pass
    // them on to.
    sigset_t all, before;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before);
    pass_on_signals();
    child = fork();
    if (child == 0) become(command, session, ends[1], launcher, before);
    close(ends[1]);
    if (child > 0 && stop_signal != 0) alarm(1);  // it came between two attempts
    sigprocmask(SIG_SETMASK, &before, nullptr);
    if (child < 0) no_room("start mpirun", "ulimit -u");
    const MpirunGuard guard(child, session);

    MpirunMessages messages;
    const bool hung = filter_errors(ends[0], messages);
    close(ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    alarm(0);
    child = 0;
    JobEnd end;
    end.stopped = stop_signal != 0;
    end.told = !shown.empty();
    if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
    const auto killed_by = [](const std::string& who, int signal) {
        return fmt::format("{} was killed by signal {} ({})", who, signal,
                           strsignal(signal));
    };
    if (hung) {
        // The exit code is lost with the killed mpirun: messages or the summary of the
        // participants tell the outcome.
        end.exit_code = end.told ? 1 : 0;
    } else if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        end.exit_code = 128 + signal;
        end.crashed = signal == SIGSEGV || signal == SIGBUS || signal == SIGABRT;
        // An mpirun that has just been started has no handler of SIGUSR1 yet and dies of
        // the request.
        const bool of_request = end.stopped && signal == SIGUSR1;
        if (!of_request) end.lost = killed_by("mpirun", signal);
    }
    if (end.lost.empty() && messages.lost() && !end.stopped) {
        end.lost = killed_by(name_of(programs, messages.lost()->world_rank),
                             messages.lost()->signal);
    }
    return end;
}

}  // namespace magfsi::launch

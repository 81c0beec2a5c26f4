#include "adapters/magfsi/mpi_job.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "adapters/magfsi/mpirun_messages.h"

namespace magfsi::launch {

namespace {

volatile pid_t child = 0;
volatile std::sig_atomic_t told_to_end = 0;
volatile std::sig_atomic_t first_word = SIGTERM;

// mpirun kills a second after SIGTERM; SIGUSR1 it hands to every process, and waits.
extern "C" void pass_on(int signal) {
    const int word = told_to_end == 0 ? first_word : SIGTERM;
    told_to_end = signal;
    if (child > 0) kill(child, word);
}

int all_ranks(const std::vector<Program>& programs) {
    int ranks = 0;
    for (const Program& p : programs) ranks += p.ranks;
    return ranks;
}

std::string name_of(const std::vector<Program>& programs, int world_rank) {
    for (const Program& p : programs) {
        if (world_rank < p.ranks) return fmt::format("{} rank {}", p.role, world_rank);
        world_rank -= p.ranks;
    }
    return "a process";
}

[[noreturn]] void become(const std::vector<std::string>& command, int error_pipe) {
    dup2(error_pipe, STDERR_FILENO);
    setenv("OMP_NUM_THREADS", "1", 0);
    // Threads that spin at a barrier take the cores that a partner needs.
    setenv("OMP_WAIT_POLICY", "passive", 0);
    // On processors that came after it, OpenBLAS falls back to kernels without AVX.
    if (__builtin_cpu_supports("avx2")) setenv("OPENBLAS_CORETYPE", "Haswell", 0);
    std::vector<char*> words;
    for (const std::string& word : command)
        words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    execvp(words[0], words.data());
    std::fprintf(stderr, "magfsi: cannot start %s: %s\n", words[0], std::strerror(errno));
    _exit(127);
}

void show(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
        // Survivors that mpirun ends when another process was lost say so; the cause is
        // named once, at the end.
        if (told_to_end == 0 && line.find("told to end by signal") != std::string::npos)
            continue;
        std::fprintf(stderr, "%s\n", line.c_str());
    }
}

void filter_errors(int pipe, MpirunMessages& messages) {
    std::string pending;
    char buffer[4096];
    while (true) {
        const ssize_t got = read(pipe, buffer, sizeof buffer);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        pending.append(buffer, static_cast<std::size_t>(got));
        std::size_t end;
        while ((end = pending.find('\n')) != std::string::npos) {
            show(messages.take(pending.substr(0, end)));
            pending.erase(0, end + 1);
        }
    }
    if (!pending.empty()) show(messages.take(pending));
    show(messages.rest());
}

}  // namespace

int available_cores() {
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
    return CPU_COUNT(&set);
}

std::vector<std::string> mpirun_command(const std::vector<Program>& programs) {
    std::vector<std::string> words{"mpirun"};
    if (geteuid() == 0) words.emplace_back("--allow-run-as-root");
    if (all_ranks(programs) > available_cores()) {
        // A waiting rank must give its core to the partner that it waits for.
        for (const char* word : {"--oversubscribe", "--bind-to", "none", "--mca",
                                 "mpi_yield_when_idle", "1"}) {
            words.emplace_back(word);
        }
    }
    for (const Program& p : programs) {
        if (&p != &programs.front()) words.emplace_back(":");
        words.emplace_back("-n");
        words.push_back(std::to_string(p.ranks));
        words.insert(words.end(), p.command.begin(), p.command.end());
    }
    return words;
}

JobEnd run_job(const std::vector<Program>& programs, OnStop on_stop) {
    first_word = on_stop == OnStop::checkpoint ? SIGUSR1 : SIGTERM;
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("cannot make a pipe");
    const auto command = mpirun_command(programs);
    child = fork();
    if (child < 0) throw std::runtime_error("cannot start a process");
    if (child == 0) become(command, ends[1]);
    close(ends[1]);
    struct sigaction action {};
    action.sa_handler = &pass_on;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);

    MpirunMessages messages;
    filter_errors(ends[0], messages);
    close(ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    JobEnd end;
    end.stopped = told_to_end != 0;
    end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (messages.lost() && !end.stopped) {
        end.lost =
            fmt::format("{} was killed by signal {} ({})",
                        name_of(programs, messages.lost()->world_rank),
                        messages.lost()->signal, strsignal(messages.lost()->signal));
    }
    return end;
}

}  // namespace magfsi::launch

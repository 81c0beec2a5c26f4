// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/participants/processes.h"

#include <fmt/format.h>
#include <mpi.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "coupler/hash.h"
#include "coupler/participants/errors.h"

namespace magfsi::coupler {

namespace {

// Hash of the machine's boot and of the name space of process numbers (containers).
std::uint64_t machine() {
    std::string text;
    std::ifstream("/proc/sys/kernel/random/boot_id") >> text;
    std::array<char, 64> name_space{};
    if (::readlink("/proc/self/ns/pid", name_space.data(), name_space.size() - 1) > 0)
        text += name_space.data();
    return hash_of(text);
}

// The part of /proc/PID/stat that is needed.
struct Status {
    char state = 0;  // a letter; 0: no such process
    std::int64_t started = 0;
};

Status status_of(std::int64_t pid) {
    std::ifstream in(fmt::format("/proc/{}/stat", pid));
    std::string line;
    std::getline(in, line);
    const auto name_end = line.rfind(')');  // the name may contain anything
    if (name_end == std::string::npos) return {};
    std::istringstream fields(line.substr(name_end + 1));
    Status status;
    fields >> status.state;
    std::string skipped;
    for (int field = 4; field < 22; ++field) fields >> skipped;
    fields >> status.started;
    return status;
}

int number_in_environment(const char* name) {
    const char* text = std::getenv(name);
    return text ? std::atoi(text) : 0;
}

}  // namespace

ProcessId this_process() {
    return {::getpid(), status_of(::getpid()).started, machine()};
}

Life life_of(const ProcessId& process) {
    static const std::uint64_t here = machine();
    if (process.machine != here) return Life::far;
    const Status status = status_of(process.pid);
    if (status.started != process.started || status.state == 'Z' || status.state == 'X')
        return Life::gone;
    return status.state == 'T' || status.state == 't' ? Life::stopped : Life::alive;
}

void wake(const ProcessId& process) {
    static const std::uint64_t here = machine();
    if (process.machine == here) ::kill(static_cast<pid_t>(process.pid), SIGUSR2);
}

namespace {

// Beyond some tens of processes on a machine mpirun starts them from threads of its own,
// and the kernel takes the end of such a thread for the parent's death.
bool started_by_main_thread_of(pid_t parent) {
    std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", parent));
    for (pid_t child = 0; children >> child;)
        if (child == ::getpid()) return true;
    return false;
}

}  // namespace

void die_with_mpirun() {
    const bool of_mpirun =
        std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE") || std::getenv("PMIX_RANK");
    const pid_t parent = ::getppid();
    if (of_mpirun && parent == 1) ::_exit(1);  // mpirun is gone already
    if (!of_mpirun || !started_by_main_thread_of(parent)) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() == 1) ::_exit(1);  // mpirun is gone already
}

namespace {

// Times [s] far above what a job takes to start on a busy machine.
constexpr unsigned first_word_s = 30, end_s = 90;
volatile std::sig_atomic_t words = 0;

// Prints a text by write(), which is safe in a signal handler.
template <std::size_t n>
void say(const char (&text)[n]) {
    const ssize_t ignored = ::write(STDERR_FILENO, text, n - 1);
    (void)ignored;
}

// Handler of SIGALRM: the first alarm prints a line, the second ends the process.
extern "C" void nobody_joined(int /*signal*/) {
    if (words == 0) {
        words = 1;
        say("magfsi: still waiting for the other programs of this MPI job to start\n");
        ::alarm(end_s);
        return;
    }
    say("magfsi: the other programs of this MPI job have not joined within 2 min: they "
        "hang, or are none of magfsi's\n");
    ::_exit(exit_partner);
}

}  // namespace

void watch_joining() {
    std::signal(SIGALRM, &nobody_joined);
    ::alarm(first_word_s);
}

void joined() {
    ::alarm(0);
}

namespace {

// The parts of mpirun's command line between colons, one for each program; empty if
// mpirun is not the parent.
std::vector<std::string> contexts_of_job() {
    std::ifstream in(fmt::format("/proc/{}/cmdline", ::getppid()));
    std::vector<std::string> contexts(1);
    bool first = true;
    for (std::string word; std::getline(in, word, '\0'); first = false) {
        const std::string name = std::filesystem::path(word).filename();
        constexpr auto names = std::to_array<std::string_view>(
            {"mpirun", "mpirun.openmpi", "mpiexec", "orterun", "prterun"});
        if (first && std::ranges::find(names, name) == names.end()) return {};
        if (word == ":")
            contexts.emplace_back();
        else
            contexts.back() += word + ' ';
    }
    return contexts;
}

}  // namespace

std::string fault_of_job() {
    const auto contexts = contexts_of_job();
    if (contexts.size() < 2) return "";
    // A colon may have another meaning: the parts count only if Open MPI gives the same
    // number of programs.
    const int programs = number_in_environment("OMPI_NUM_APP_CTX");
    if (programs > 0 && contexts.size() != static_cast<std::size_t>(programs)) return "";
    for (const std::string& program : contexts) {
        const bool ours = std::ranges::any_of(
            std::to_array({"magfsi-structure", "magfsi-equilibrium", "magfsi-fluid-",
                           "magfsi.controller"}),
            [&](const char* name) { return program.find(name) != std::string::npos; });
        if (ours) continue;
        return fmt::format(
            "another program is in this MPI job, and none of magfsi's: {}; allowed are "
            "those of the structure and the fluid (-n N magfsi-structure SCENE : -n M "
            "magfsi-fluid-lbm SCENE); a script that starts one takes its name as an "
            "argument",
            program.substr(0, program.find_last_not_of(' ') + 1));
    }
    return "";
}

std::string fault_of_start() {
    int size = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    // MPICH and its relatives give each process the number of processes in this variable.
    const int started = number_in_environment("PMI_SIZE");
    if (size > 1 || started <= 1) return "";
    return fmt::format(
        "{} processes were started by the mpirun of another MPI, in which each is alone; "
        "these programs are built with Open MPI: take its mpirun (Debian: "
        "mpirun.openmpi), or ./magfsi run SCENE, which finds it",
        started);
}

void let_the_others_connect() {
    if (number_in_environment("OMPI_COMM_WORLD_SIZE") > 1)
        std::this_thread::sleep_for(std::chrono::seconds(2));
}

}  // namespace magfsi::coupler

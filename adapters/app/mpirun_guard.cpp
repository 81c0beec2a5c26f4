// SPDX-License-Identifier: GPL-2.0-or-later
// Detection of a hung mpirun, and the folder that it keeps its files in.
#include "adapters/app/mpirun_guard.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "adapters/app/mpirun.h"
#include "base/files/temporary_folder.h"

namespace magfsi::launch {

namespace fs = std::filesystem;

namespace {

// Seen with jobs of 41 processes in one of twenty ends by SIGTERM.
constexpr int hung_after_s = 10;

// A process that has ended and was not waited for still has its entry, with state Z.
bool lives(const std::string& pid) {
    std::ifstream file("/proc/" + pid + "/stat");
    std::string stat;
    std::getline(file, stat);
    const std::size_t name_end = stat.rfind(") ");
    return name_end != std::string::npos && stat.substr(name_end + 2, 1) != "Z";
}

bool has_living_children(pid_t pid) {
    std::error_code gone;
    const fs::directory_iterator threads(fmt::format("/proc/{}/task", pid), gone);
    return std::ranges::any_of(threads, [](const fs::directory_entry& thread) {
        std::ifstream children(thread.path() / "children");
        std::string child_pid;
        while (children >> child_pid)
            if (lives(child_pid)) return true;
        return false;
    });
}

}  // namespace

void no_room(const char* what, const char* limit) {
    throw std::runtime_error(fmt::format("cannot {}: {}; see {}, and end other programs",
                                         what, std::strerror(errno), limit));
}

const char* session_variable() {
    return find_mpirun().version >= 5 ? "PRTE_MCA_prte_tmpdir_base"
                                      : "OMPI_MCA_orte_tmpdir_base";
}

std::string session_folder() {
    if (has_more_machines()) return "";
    const char* const chosen = std::getenv(session_variable());
    const fs::path above = chosen ? fs::path(chosen) : files::temporary_files();
    fs::create_directories(above);
    return files::make_folder(above, "magfsi-mpi").string();
}

bool HungMpirun::now(pid_t mpirun) {
    const bool busy = has_living_children(mpirun);
    started_ = started_ || busy;
    alone_s_ = started_ && !busy ? alone_s_ + 1 : 0;
    return alone_s_ > hung_after_s;
}

MpirunGuard::MpirunGuard(pid_t mpirun, const std::string& session) {
    if (pipe2(pipe_, O_CLOEXEC) != 0) no_room("make a pipe", "ulimit -n");
    const std::string script = fmt::format(
        "read _; n={1}; while [ $n -gt 0 ] && kill -0 {0}; do "
        "/bin/sleep 1; n=$((n - 1)); done; [ $n -gt 0 ] || kill -9 {0}; "
        "[ -z \"$0\" ] || /bin/rm -rf \"$0\"",
        mpirun, hung_after_s);
    shell_ = fork();
    if (shell_ == 0) wait_as_shell(script, session);
    close(pipe_[0]);
}

MpirunGuard::~MpirunGuard() {
    close(pipe_[1]);
    while (shell_ > 0 && waitpid(shell_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

void MpirunGuard::wait_as_shell(const std::string& script,
                                const std::string& session) const {
    setsid();  // signals to the job's process group pass it by
    const int nothing = open("/dev/null", O_WRONLY);
    dup2(pipe_[0], STDIN_FILENO);
    dup2(nothing, STDOUT_FILENO);
    dup2(nothing, STDERR_FILENO);
    execl("/bin/sh", "sh", "-c", script.c_str(), session.c_str(),
          static_cast<char*>(nullptr));
    _exit(127);
}

}  // namespace magfsi::launch

// SPDX-License-Identifier: GPL-2.0-or-later
// Protection against faults of Open MPI's mpirun: that of 4.1 may hang when its processes
// have ended, and jobs may find the folder of their own files taken.
#pragma once

#include <sys/types.h>

#include <string>

namespace magfsi::launch {

// Throws std::runtime_error: "cannot `what`", with the system's reason. limit: the
// command that shows the limit which was reached.
[[noreturn]] void no_room(const char* what, const char* limit);

// Makes the folder in which one mpirun keeps its own files. Otherwise jobs of Open MPI 4
// share one, and fail when another job removes it at that moment ("A call to mkdir was
// unable to create the desired directory"). The folder of Open MPI 5 is named after the
// process: a job fails where a killed one with the same number has left it
// ("PMIX_ERR_EXISTS"). Returns "", for mpirun's own choice, on several machines. Throws
// std::runtime_error if no folder can be made.
std::string session_folder();

// Name of the environment variable by which mpirun is told the folder.
const char* session_variable();

// Detects a hung mpirun as long as this launcher lives.
class HungMpirun {
  public:
    // Must be called about once a second while mpirun is silent; returns true when all
    // child processes of mpirun have been gone for more than ten calls.
    bool now(pid_t mpirun);

  private:
    bool started_ = false;
    int alone_s_ = 0;
};

// A shell process that waits for the launcher's end (its end of a pipe closes), gives
// mpirun ten seconds, kills it, and removes `session` unless it is "". It works even if
// the launcher itself was killed.
class MpirunGuard {
  public:
    MpirunGuard(pid_t mpirun, const std::string& session);
    MpirunGuard(const MpirunGuard&) = delete;
    MpirunGuard& operator=(const MpirunGuard&) = delete;
    // Must run after waitpid for mpirun, so that the shell finds no mpirun to kill.
    ~MpirunGuard();

  private:
    [[noreturn]] void wait_as_shell(const std::string& script,
                                    const std::string& session) const;

    int pipe_[2] = {-1, -1};
    pid_t shell_ = -1;
};

}  // namespace magfsi::launch

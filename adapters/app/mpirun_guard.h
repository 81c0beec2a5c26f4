// SPDX-License-Identifier: GPL-2.0-or-later
// Protection against two faults of Open MPI 4.1's mpirun: it may hang when its processes
// have ended, and jobs that start and end at the same moment take the folder of their
// own files from each other.
#pragma once

#include <sys/types.h>

#include <string>

namespace magfsi::launch {

// Throws std::runtime_error: "cannot `what`", with the system's reason. limit: the
// command that shows the limit which was reached.
[[noreturn]] void no_room(const char* what, const char* limit);

// Makes the folder in which one mpirun keeps its own files. Two jobs that use the same
// one fail ("A call to mkdir was unable to create the desired directory") when one of
// them removes it while the other looks into it. Returns "" where mpirun's own choice is
// better: with Open MPI 5, which has a folder for each job, and on several machines.
std::string session_folder();

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

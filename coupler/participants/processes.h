// SPDX-License-Identifier: GPL-2.0-or-later
// A process of the job as other processes of its machine see it, and checks of the job's
// start.
#pragma once

#include <cstdint>
#include <string>

namespace magfsi::coupler {

// A process, identified beyond its number. The layout is the same everywhere, since it is
// sent in messages.
struct ProcessId {
    std::int64_t pid = 0;
    std::int64_t started = 0;   // clock ticks since boot; pids are reused
    std::uint64_t machine = 0;  // hash of this boot and of the pid name space
};
// The identity of this process.
ProcessId this_process();

// State of a process. far: it is on another machine, where only the MPI runtime knows its
// state.
enum class Life { far, gone, stopped, alive };
Life life_of(const ProcessId& process);

// Wakes a process of this machine that sleeps between messages, by SIGUSR2. Does nothing
// for a process of another machine, which polls.
void wake(const ProcessId& process);

// Makes the death of mpirun end this process, too, even a stopped one. Must be called
// before anything else.
void die_with_mpirun();

// These calls guard the start of the job: MPI_Init and the first exchange take place
// between them. If the job's other programs do not come, this process prints a line after
// 30 s and ends with exit_partner after 2 min: a program that knows nothing of MPI would
// otherwise keep all others in MPI_Init for ever.
void watch_joining();
void joined();

// Reason why this MPI job cannot be a job of magfsi, as far as the command line of mpirun
// shows; empty if there is none.
std::string fault_of_job();

// Reason why the processes that were started together are not one MPI job; empty if there
// is none. To be called after MPI_Init.
std::string fault_of_start();

// Waits before this process ends without MPI_Init: mpirun of Open MPI 4.1 may hang for
// ever if a process ends while another one is connecting to it.
void let_the_others_connect();

}  // namespace magfsi::coupler

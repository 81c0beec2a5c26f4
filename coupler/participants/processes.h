// SPDX-License-Identifier: GPL-2.0-or-later
// A process of the job as the others on its machine see it: whether it is still there.
#pragma once

#include <cstdint>
#include <string>

namespace magfsi::coupler {

// The same layout everywhere: it travels in messages.
struct ProcessId {
    std::int64_t pid = 0;
    std::int64_t started = 0;   // in clock ticks since boot: numbers are used again
    std::uint64_t machine = 0;  // of this boot, and of the name space of its numbers
};
ProcessId this_process();

// far: on another machine, where only the MPI runtime knows.
enum class Life { far, gone, stopped, alive };
Life life_of(const ProcessId& process);

// To one that sleeps between messages: there is one for it (SIGUSR2). Does nothing to a
// far one, which has to look by itself.
void wake(const ProcessId& process);

// mpirun's death is to end this process too; a stopped one as well. Call it first.
void die_with_mpirun();

// From here to joined(), which MPI_Init and the first exchange are within: a word where
// the job's other programs do not come, and then the end, with exit_partner. A program
// that knows nothing of MPI would keep all others in MPI_Init for ever.
void watch_joining();
void joined();

// Empty, or why this MPI job cannot be one of ours, as far as its start tells.
std::string fault_of_job();

// After MPI_Init: empty, or why the processes that were started together are not one job.
std::string fault_of_start();

// Before an end without MPI_Init: Open MPI 4.1's mpirun may hang for ever where a process
// ends while another one is just connecting to it.
void let_the_others_connect();

}  // namespace magfsi::coupler

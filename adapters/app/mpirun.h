// SPDX-License-Identifier: GPL-2.0-or-later
// The mpirun that starts jobs: that of the MPI library which the programs are linked to.
#pragma once

#include <string>
#include <vector>

namespace magfsi::launch {

// An mpirun of Open MPI.
struct Mpirun {
    std::string program;  // name, looked up through PATH
    int version = 0;      // major version of Open MPI; 0 if unknown
    // Name and version of an mpirun of another MPI that comes first on PATH and is not
    // used; mostly empty.
    std::string passed_over;
};

// Finds the first of `mpirun` and Debian's `mpirun.openmpi` that belongs to Open MPI; the
// result is kept. Throws std::runtime_error with the remedy if all of them belong to
// another MPI.
const Mpirun& find_mpirun();

// True if the environment names a batch system or a host file, so that mpirun may use
// other machines than this one.
bool has_more_machines();

// One program of an MPMD job: its role (for messages), its ranks, and its command line.
struct Program {
    std::string role;  // structure, fluid or controller
    int ranks = 1;
    std::vector<std::string> command;
};

// Command line of mpirun for the programs, with only those options that this machine and
// the number of ranks need.
std::vector<std::string> mpirun_command(const std::vector<Program>& programs);

// Sets environment variables that mpirun and its processes need; those that the user has
// set stay as they are. Changes this process's environment.
void set_mpirun_environment();

}  // namespace magfsi::launch

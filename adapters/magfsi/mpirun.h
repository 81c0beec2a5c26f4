// SPDX-License-Identifier: GPL-2.0-or-later
// The mpirun that starts jobs: that of the MPI library which the programs are linked to.
#pragma once

#include <string>
#include <vector>

namespace magfsi::launch {

struct Mpirun {
    std::string program;  // as found through PATH
    int version = 0;      // Open MPI's first number; 0: it does not say
    // Empty, or which mpirun comes first on PATH and is passed over.
    std::string passed_over;
};

// The first of mpirun and Debian's mpirun.openmpi that belongs to Open MPI. Throws
// std::runtime_error, with the remedy, where all of them belong to another MPI.
const Mpirun& find_mpirun();

// Whether mpirun may use other machines than this one, as the environment says.
bool has_more_machines();

struct Program {
    std::string role;  // for messages
    int ranks = 1;
    std::vector<std::string> command;
};

// mpirun with the options that this machine and this number of ranks need, no others.
std::vector<std::string> mpirun_command(const std::vector<Program>& programs);

// Sets the environment variables that mpirun and its processes need, unless they are set.
void set_mpirun_environment();

}  // namespace magfsi::launch

// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lammps/lammps_exit.h"

#include <mpi.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "coupler/participants/errors.h"

namespace magfsi::lammps {

namespace {

int depth = 0;  // number of InsideLammps objects alive
std::filesystem::path log_file;

// The last line of LAMMPS's log that contains ERROR.
std::string last_error() {
    std::ifstream log(log_file);
    std::string line;
    std::string found = "no reason in " + log_file.string();
    while (std::getline(log, line)) {
        if (line.find("ERROR") != std::string::npos) found = line;
    }
    return found;
}

// Prints the cause of the end to stderr.
void report() {
    std::fprintf(stderr, "magfsi structure: LAMMPS stopped: %s\n", last_error().c_str());
    std::fflush(nullptr);
}

}  // namespace

void watch_lammps_exit(const std::filesystem::path& log) {
    log_file = log;
}

InsideLammps::InsideLammps() {
    ++depth;
}
InsideLammps::~InsideLammps() {
    --depth;
}

}  // namespace magfsi::lammps

// These two replace MPI's functions for the whole program; the originals are
// PMPI_Finalize and PMPI_Abort.
extern "C" int MPI_Finalize() {
    if (magfsi::lammps::depth > 0) {
        magfsi::lammps::report();
        return PMPI_Abort(MPI_COMM_WORLD, magfsi::coupler::exit_error);
    }
    return PMPI_Finalize();
}

extern "C" int MPI_Abort(MPI_Comm comm, int code) {
    if (magfsi::lammps::depth > 0) {
        magfsi::lammps::report();
        return PMPI_Abort(MPI_COMM_WORLD, magfsi::coupler::exit_error);
    }
    return PMPI_Abort(comm, code);
}

// SPDX-License-Identifier: GPL-2.0-or-later
// Handling of errors inside LAMMPS, which end the process: by MPI_Finalize and exit, or
// by MPI_Abort. In a coupled job the former would wait for the partner forever. While
// control is inside LAMMPS, our versions of MPI_Finalize and MPI_Abort (by the MPI
// profiling interface) print the cause and end the whole job.
#pragma once

#include <filesystem>

namespace magfsi::lammps {

// Sets LAMMPS's log file, whose last line with ERROR is printed as the cause.
void watch_lammps_exit(const std::filesystem::path& log);

// Marks, while it lives, that control is inside LAMMPS. May be nested. Not for threads.
struct InsideLammps {
    InsideLammps();
    ~InsideLammps();
    InsideLammps(const InsideLammps&) = delete;
    InsideLammps& operator=(const InsideLammps&) = delete;
};

}  // namespace magfsi::lammps
